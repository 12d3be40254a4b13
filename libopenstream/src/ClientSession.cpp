#include "ClientSession.Impl.hpp"

#include <utility>

namespace ACS::OpenStream
{

ClientSession::ClientSession(const ClientSessionOptions& options, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(options, random))
{
}

ClientSession::~ClientSession() = default;

void ClientSession::Start(Core::Now now, ClientActions& out)
{
    _impl->Start(now, out);
}

void ClientSession::Stop(Core::Now now, ClientActions& out)
{
    _impl->Stop(now, out);
}

void ClientSession::SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out)
{
    _impl->SetMonitor(std::move(monitorOrNull), now, out);
}

std::uint64_t ClientSession::SendControl(
    const ControlRequest& request,
    EControlTracking tracking,
    Core::Now now,
    ClientActions& out)
{
    return _impl->SendControl(request, tracking, now, out);
}

std::uint64_t ClientSession::SendControlCall(ControlCall call, Core::Now now, ClientActions& out)
{
    return _impl->SendControlCall(std::move(call), now, out);
}

void ClientSession::StopControl(Core::Now now, ClientActions& out)
{
    _impl->StopControl(now, out);
}

void ClientSession::OnConnected(Core::Now now, ClientActions& out)
{
    _impl->OnConnected(now, out);
}

void ClientSession::OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out)
{
    _impl->OnConnectFailed(detail, now, out);
}

void ClientSession::OnBytes(std::string_view bytes, Core::Now now, ClientActions& out)
{
    _impl->OnBytes(bytes, now, out);
}

void ClientSession::OnSendCompleted(Core::Now now, ClientActions& out)
{
    _impl->OnSendCompleted(now, out);
}

void ClientSession::OnPeerClosed(Core::Now now, ClientActions& out)
{
    _impl->OnPeerClosed(now, out);
}

void ClientSession::OnSocketError(std::string_view detail, Core::Now now, ClientActions& out)
{
    _impl->OnSocketError(detail, now, out);
}

void ClientSession::OnTimer(EClientTimer timer, Core::Now now, ClientActions& out)
{
    _impl->OnTimer(timer, now, out);
}

EClientState ClientSession::GetState() const noexcept
{
    return _impl->GetState();
}

const ClientSessionStats& ClientSession::GetStats() const noexcept
{
    return _impl->GetStats();
}

const ClientData* ClientSession::GetLatestOrNull() const noexcept
{
    return _impl->GetLatestOrNull();
}

StreamQuality ClientSession::GetQuality() const
{
    return _impl->GetQuality();
}

} // namespace ACS::OpenStream
