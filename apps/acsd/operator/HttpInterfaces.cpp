#include "operator/HttpInterfaces.hpp"

#include <boost/asio/post.hpp>
#include <boost/system/error_code.hpp>

#include <utility>

namespace ACS::Acsd
{

HttpInterfaces::HttpInterfaces(
    Dependencies dependencies,
    const AccessPolicy::Options& access,
    std::unique_ptr<AuditLog> audit)
    : _dependencies(std::move(dependencies)),
      _audit(std::move(audit)),
      _gate(_dependencies.clock, _dependencies.logger.MakeFor("operator"), AccessPolicy(access), *_audit),
      _keepAlive(_dependencies.executor),
      _events(std::make_shared<EventFeed>(_dependencies.clock, [this] { RequestFlush(); }))
{
    _gate.GetRoutes().Add("GET", "/v1/events", [this](const Apps::HttpRequest& request, const auto&) {
        return _events->Respond(request);
    });
    _gate.SetLogoutHandler([this] { _events->EndAll(); });
}

HttpInterfaces::~HttpInterfaces()
{
    Close();
}

Apps::HttpRoutes& HttpInterfaces::GetMonitoringRoutes() noexcept
{
    return _monitoringRoutes;
}

OperatorGate& HttpInterfaces::GetGate() noexcept
{
    return _gate;
}

EventFeed& HttpInterfaces::GetEvents() noexcept
{
    return *_events;
}

void HttpInterfaces::Open()
{
    _bOpen = true;
    _dependencies.addresses.SetHandlers(
        {[this](const Apps::HttpRequest& request) { return _monitoringRoutes.Respond(request); },
         [this](const Apps::HttpRequest& request) {
             return _gate.Respond(request);
         }});
    KeepAliveAsync();
}

void HttpInterfaces::Close()
{
    if (!std::exchange(_bOpen, false))
    {
        return; // the handlers may be those of a standby
    }
    boost::system::error_code ignored;
    _keepAlive.cancel(ignored);
    _dependencies.addresses.SetHandlers({});
}

void HttpInterfaces::ReloadTokens(const OperatorConfig& fresh, OperatorConfig& present)
{
    if (TryReplaceTokens(fresh, present))
    {
        _gate.SetPolicy(AccessPolicy(present.access));
        _events->EndAll(); // of a withdrawn token perhaps
    }
}

std::uint64_t HttpInterfaces::GetLostAudit() const
{
    return _audit->GetLost();
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
        if (!error.failed() && events != nullptr && _bOpen)
        {
            _audit->LogState();
            events->KeepAlive();
            KeepAliveAsync();
        }
    });
}

} // namespace ACS::Acsd
