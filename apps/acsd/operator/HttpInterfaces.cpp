#include "operator/HttpInterfaces.hpp"

#include "operator/HealthRoutes.hpp"

#include <utility>

namespace ACS::Acsd
{

HttpInterfaces::HttpInterfaces(Dependencies dependencies, const HttpConfig& config, std::unique_ptr<AuditLog> audit)
    : _dependencies(std::move(dependencies)),
      _audit(std::move(audit)),
      _gate(
          _dependencies.clock,
          _dependencies.logger.MakeFor("operator"),
          AccessPolicy(config.control.access),
          *_audit),
      _monitoring(
          _dependencies.executor,
          [this](const Apps::HttpRequest& request) { return _monitoringRoutes.Respond(request); },
          _dependencies.logger.MakeFor("http"),
          {},
          MakeHttpGuard(config.monitoring)),
      _operator(
          _dependencies.executor,
          [this](const Apps::HttpRequest& request) { return _gate.Respond(request); },
          _dependencies.logger.MakeFor("operator"),
          {},
          MakeHttpGuard(config.control.http))
{
}

Apps::HttpRoutes& HttpInterfaces::GetMonitoringRoutes() noexcept
{
    return _monitoringRoutes;
}

Apps::HttpRoutes& HttpInterfaces::GetOperatorRoutes() noexcept
{
    return _gate.GetRoutes();
}

Core::Result<void> HttpInterfaces::Listen(const HttpConfig& config)
{
    Core::Result<void> opened = ListenOn(_monitoring, "http", config.monitoring);
    if (opened)
    {
        opened = UseTLS(config.control.tls);
    }
    if (opened)
    {
        opened = ListenOn(_operator, "operator", config.control.http);
    }
    return opened;
}

void HttpInterfaces::Stop()
{
    _monitoring.Stop();
    _operator.Stop();
}

void HttpInterfaces::Reload(const OperatorConfig& fresh, OperatorConfig& present)
{
    ReloadTokens(fresh, present);
    if (const Core::Result<void> used = UseTLS(present.tls); !used)
    {
        _dependencies.logger.MakeFor("operator")
            .Error("TLS files not read again: the former ones stay in use", {{"reason", Core::Describe(used.error())}});
    }
}

void HttpInterfaces::ReloadTokens(const OperatorConfig& fresh, OperatorConfig& present)
{
    if (fresh.tokensFile != present.tokensFile || fresh.access.tokens == present.access.tokens)
    {
        return;
    }
    present.access.tokens = fresh.access.tokens;
    _gate.SetPolicy(AccessPolicy(present.access));
    _dependencies.logger.MakeFor("operator").Info("tokens reloaded", {{"file", present.tokensFile}});
}

const std::vector<Apps::ReadyAddress>& HttpInterfaces::GetAddresses() const noexcept
{
    return _addresses;
}

std::uint64_t HttpInterfaces::GetLostAudit() const
{
    return _audit->GetLost();
}

Core::Result<void> HttpInterfaces::UseTLS(const Apps::HttpTlsFiles& files)
{
    if (files.certificate.empty())
    {
        return {};
    }
    auto context = Apps::MakeHttpTlsContext(files);
    if (!context)
    {
        return tl::unexpected<Core::Error>(context.error());
    }
    _operator.UseTLS(std::move(*context));
    return {};
}

Core::Result<void> HttpInterfaces::ListenOn(
    Apps::HttpServer& server,
    const std::string& name,
    const HttpListenConfig& config)
{
    const Core::Result<Apps::Endpoint> endpoint = server.Listen(config.listen);
    if (!endpoint)
    {
        return tl::unexpected<Core::Error>(endpoint.error());
    }
    _addresses.push_back({name, *endpoint});
    return {};
}

} // namespace ACS::Acsd
