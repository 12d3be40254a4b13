#include "standby/StandbyServer.hpp"

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

StandbyServer::StandbyServer(
    HttpInterfaces::Dependencies dependencies,
    const HttpConfig& config,
    std::unique_ptr<AuditLog> audit,
    const Reasons& reasons)
    : _http(std::move(dependencies), config, std::move(audit))
{
    _metrics.AddGauge(AcsdMetrics::LEADER, AcsdMetrics::LEADER_HELP);
    _metrics.SetGauge(AcsdMetrics::LEADER, {}, 0);
    Apps::HttpRoutes& monitoring = _http.GetMonitoringRoutes();
    monitoring.Add("GET", "/livez", [](const auto&, const auto&) { return MakeLiveResponse(); });
    monitoring.Add("GET", "/readyz", [getReason = reasons.getReason](const auto&, const auto&) {
        return Apps::HttpResponse{OperatorCode::UNAVAILABLE, PLAIN_TEXT, getReason() + "\n"};
    });
    monitoring.Add("GET", "/metrics", [this](const auto&, const auto&) { return _metrics.Respond(); });
    AddPageRoutes(_pageRoutes);
    _http.ReplaceGate([this, getReason = reasons.getPublicReason](const Apps::HttpRequest& request) {
        const bool bOfPage = request.path == "/" || request.path.starts_with("/page/");
        return bOfPage ? _pageRoutes.Respond(request) : MakeOperatorError(OperatorCode::UNAVAILABLE, getReason());
    });
}

Core::Result<void> StandbyServer::Listen(const HttpConfig& config)
{
    return _http.Listen(config);
}

void StandbyServer::Stop()
{
    _http.Stop();
}

void StandbyServer::Reload(const OperatorConfig& fresh, OperatorConfig& present)
{
    _http.Reload(fresh, present);
}

const std::vector<Apps::ReadyAddress>& StandbyServer::GetAddresses() const noexcept
{
    return _http.GetAddresses();
}

} // namespace ACS::Acsd
