#include "ServerSession.Impl.hpp"

#include <utility>

namespace ACS::OpenStream
{

ServerSession::ServerSession(const ServerSessionOptions& options)
    : _impl(std::make_unique<Impl>(options))
{
}

ServerSession::~ServerSession() = default;

void ServerSession::Start(Core::Now now, ServerActions& out)
{
    _impl->Start(now, out);
}

void ServerSession::Reject(std::string_view message, Core::Now now, ServerActions& out)
{
    _impl->Reject(message, now, out);
}

void ServerSession::OnBytes(std::string_view bytes, Core::Now now, ServerActions& out)
{
    _impl->OnBytes(bytes, now, out);
}

void ServerSession::OnContinue(Core::Now now, ServerActions& out)
{
    _impl->OnContinue(now, out);
}

void ServerSession::OnTimer(EServerTimer timer, Core::Now now, ServerActions& out)
{
    _impl->OnTimer(timer, now, out);
}

void ServerSession::OnServiceAnswer(std::uint64_t token, const ApiResponse& response, Core::Now now, ServerActions& out)
{
    _impl->OnServiceAnswer(token, response, now, out);
}

void ServerSession::OnSendCompleted(Core::Now now, ServerActions& out)
{
    _impl->OnSendCompleted(now, out);
}

void ServerSession::OnPeerClosed(Core::Now now, ServerActions& out)
{
    _impl->OnPeerClosed(now, out);
}

void ServerSession::OnSocketError(ServerActions& out)
{
    _impl->OnSocketError(out);
}

EServerState ServerSession::GetState() const noexcept
{
    return _impl->GetState();
}

bool ServerSession::HasControl() const noexcept
{
    return _impl->HasControl();
}

const ServerSessionStats& ServerSession::GetStats() const noexcept
{
    return _impl->GetStats();
}

} // namespace ACS::OpenStream
