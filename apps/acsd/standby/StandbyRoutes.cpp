#include "standby/StandbyRoutes.hpp"

#include "operator/AcsdMetrics.hpp"
#include "operator/HealthRoutes.hpp"
#include "operator/OperatorAnswer.hpp"
#include "operator/PageRoutes.hpp"

#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr const char* PLAIN_TEXT = "text/plain; charset=utf-8";

} // namespace

StandbyRoutes::StandbyRoutes(Reasons reasons)
    : _reasons(std::move(reasons))
{
    _metrics.AddGauge(AcsdMetrics::LEADER, AcsdMetrics::LEADER_HELP);
    _metrics.SetGauge(AcsdMetrics::LEADER, {}, 0);
    _monitoringRoutes.Add("GET", "/livez", [](const auto&, const auto&) { return MakeLiveResponse(); });
    _monitoringRoutes.Add("GET", "/readyz", [this](const auto&, const auto&) {
        return Apps::HttpResponse{OperatorCode::UNAVAILABLE, PLAIN_TEXT, _reasons.getReason() + "\n"};
    });
    _monitoringRoutes.Add("GET", "/metrics", [this](const auto&, const auto&) { return _metrics.Respond(); });
    AddPageRoutes(_pageRoutes);
}

HttpAddresses::Handlers StandbyRoutes::MakeHandlers()
{
    return {
        [this](const Apps::HttpRequest& request) { return _monitoringRoutes.Respond(request); },
        [this](const Apps::HttpRequest& request) {
            const bool bOfPage = request.path == "/" || request.path.starts_with("/page/");
            return bOfPage ? _pageRoutes.Respond(request)
                           : MakeOperatorError(OperatorCode::UNAVAILABLE, _reasons.getPublicReason());
        }};
}

} // namespace ACS::Acsd
