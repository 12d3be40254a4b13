#include "operator/HttpInterfaces.hpp"

#include "operator/HealthRoutes.hpp"

#include <boost/asio/post.hpp>
#include <boost/system/error_code.hpp>

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
      _keepAlive(_dependencies.executor),
      _events(std::make_shared<EventFeed>(_dependencies.clock, [this] { RequestFlush(); })),
      _monitoring(
          _dependencies.executor,
          [this](const Apps::HttpRequest& request) { return _monitoringRoutes.Respond(request); },
          _dependencies.logger.MakeFor("http"),
          {},
          MakeHttpGuard(config.monitoring)),
      _operator(
          _dependencies.executor,
          [this](const Apps::HttpRequest& request) {
              return _handlerInstead ? _handlerInstead(request) : _gate.Respond(request);
          },
          _dependencies.logger.MakeFor("operator"),
          {},
          MakeHttpGuard(config.control.http))
{
    _gate.GetRoutes().Add("GET", "/v1/events", [this](const Apps::HttpRequest& request, const auto&) {
        return _events->Respond(request);
    });
    _gate.SetLogoutHandler([this] { _events->EndAll(); });
}

Apps::HttpRoutes& HttpInterfaces::GetMonitoringRoutes() noexcept
{
    return _monitoringRoutes;
}

OperatorGate& HttpInterfaces::GetGate() noexcept
{
    return _gate;
}

void HttpInterfaces::ReplaceGate(Apps::HttpServer::Handler handler)
{
    _handlerInstead = std::move(handler);
}

EventFeed& HttpInterfaces::GetEvents() noexcept
{
    return *_events;
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
    if (opened)
    {
        _bListening = true;
        KeepAliveAsync();
    }
    return opened;
}

void HttpInterfaces::Stop()
{
    _bListening = false;
    boost::system::error_code ignored;
    _keepAlive.cancel(ignored);
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

void HttpInterfaces::RequestFlush()
{
    boost::asio::post(_dependencies.executor, [weak = std::weak_ptr<EventFeed>(_events)] {
        if (const std::shared_ptr<EventFeed> events = weak.lock())
        {
            events->Flush();
        }
    });
}

void HttpInterfaces::KeepAliveAsync()
{
    _keepAlive.expires_after(EventFeed::KEEP_ALIVE);
    _keepAlive.async_wait([this, weak = std::weak_ptr<EventFeed>(_events)](const boost::system::error_code& error) {
        // Expired before it was cancelled, the handler may run after the destructor.
        const std::shared_ptr<EventFeed> events = weak.lock();
        if (!error.failed() && events != nullptr && _bListening)
        {
            events->KeepAlive();
            KeepAliveAsync();
        }
    });
}

void HttpInterfaces::ReloadTokens(const OperatorConfig& fresh, OperatorConfig& present)
{
    if (fresh.tokensFile != present.tokensFile || fresh.access.tokens == present.access.tokens)
    {
        return;
    }
    present.access.tokens = fresh.access.tokens;
    _gate.SetPolicy(AccessPolicy(present.access));
    _events->EndAll(); // of a withdrawn token perhaps
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
