#include "McsSession.Impl.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace ACS::Protocol
{

McsSession::McsSession(const McsSessionOptions& options, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(options, random))
{
}

McsSession::~McsSession() = default;

bool McsSession::ShouldRefuseUpgrade() const noexcept
{
    return _impl->ShouldRefuseUpgrade();
}

void McsSession::OnConnected(ConnectionID connection, Core::Now now, SessionActions& out)
{
    _impl->OnConnected(connection, now, out);
}

void McsSession::OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out)
{
    _impl->OnText(connection, text, now, out);
}

void McsSession::OnClosed(ConnectionID connection, std::string_view reason, Core::Now /*now*/, SessionActions& out)
{
    _impl->OnClosed(connection, reason, out);
}

void McsSession::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
{
    _impl->OnTimer(timer, now, out);
}

bool McsSession::TryAnswer(
    AnswerToken token,
    EAckResult result,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    return _impl->TryAnswer(token, result, message, now, out);
}

std::size_t McsSession::GetUnansweredCount() const noexcept
{
    return _impl->GetUnansweredCount();
}

AcsRequest McsSession::MakeRequest(AcsPayload payload, Core::Now now)
{
    return _impl->MakeRequest(std::move(payload), now);
}

bool McsSession::TrySend(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    return _impl->TrySend(request, now, out);
}

std::optional<ConnectionID> McsSession::GetRegisteredOrNull() const noexcept
{
    return _impl->GetRegisteredOrNull();
}

bool McsSession::IsRegistered() const noexcept
{
    return _impl->GetRegisteredOrNull().has_value();
}

bool McsSession::IsTakingPlans() const noexcept
{
    return _impl->IsTakingPlans();
}

std::size_t McsSession::GetPendingCount() const noexcept
{
    return _impl->GetPendingCount();
}

void McsSession::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _impl->SetSiteOffset(offset);
}

const SessionStatistics& McsSession::GetStatistics() const noexcept
{
    return _impl->GetStatistics();
}

} // namespace ACS::Protocol
