#include "operator/HealthRoutes.hpp"

#include "operator/OperatorAnswer.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr const char* PLAIN_TEXT = "text/plain; charset=utf-8";

} // namespace

Apps::HttpResponse MakeLiveResponse()
{
    return {OperatorCode::OK, PLAIN_TEXT, "alive\n"};
}

Apps::HttpResponse MakeReadyResponse(const ProgramState& program)
{
    const std::vector<std::string> reasons = ListNotReadyReasons(program);
    std::string body = reasons.empty() ? "ready\n" : fmt::format("{}\n", fmt::join(reasons, "\n"));
    if (program.bConnected.has_value())
    {
        body += fmt::format("isConnected={}\n", *program.bConnected);
    }
    return {reasons.empty() ? OperatorCode::OK : OperatorCode::UNAVAILABLE, PLAIN_TEXT, std::move(body)};
}

void AddHealthRoutes(Apps::HttpRoutes& routes, const std::function<ProgramState()>& getState)
{
    routes.Add("GET", "/livez", [](const auto&, const auto&) { return MakeLiveResponse(); });
    routes.Add("GET", "/readyz", [getState](const auto&, const auto&) { return MakeReadyResponse(getState()); });
}

Apps::HttpGuard MakeHttpGuard(const HttpListenConfig& config)
{
    std::vector<std::string> names = config.hosts;
    names.push_back(config.listen.host);
    return Apps::HttpGuard({std::move(names), false});
}

} // namespace ACS::Acsd
