#include "AcsSession.Impl.hpp"
#include <acs/protocol/DurableRequest.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

namespace ACS::Protocol
{

namespace
{

bool IsFinite(const RobotPosition& robot)
{
    return std::isfinite(robot.x) && std::isfinite(robot.y) && std::isfinite(robot.angle)
        && std::isfinite(robot.battery);
}

} // namespace

AcsSession::AcsSession(const SessionOptions& options, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(options, random))
{
}

AcsSession::~AcsSession() = default;

void AcsSession::Start(Core::Now /*now*/, SessionActions& out)
{
    _impl->Start(out);
}

void AcsSession::Stop(Core::Now now, SessionActions& out)
{
    _impl->Stop(now, out);
}

void AcsSession::OnConnected(Core::Now now, SessionActions& out)
{
    _impl->OnConnected(now, out);
}

void AcsSession::OnText(std::string_view text, Core::Now now, SessionActions& out)
{
    _impl->OnText(text, now, out);
}

void AcsSession::OnClosed(std::string_view reason, Core::Now now, SessionActions& out)
{
    _impl->OnClosed(reason, now, out);
}

void AcsSession::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
{
    _impl->OnTimer(timer, now, out);
}

bool AcsSession::TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    return IsDurable(request.payload) && _impl->TrySendDurable(request, now, out);
}

void AcsSession::ReplayDone(Core::Now now, SessionActions& out)
{
    _impl->ReplayDone(now, out);
}

void AcsSession::SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out)
{
    _impl->SendStatus(status, now, out);
}

void AcsSession::SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out)
{
    if (std::ranges::all_of(positions.robots, IsFinite))
    {
        _impl->SendPosition(positions, now, out);
        return;
    }
    RobotPositionUpdate finite;
    std::ranges::copy_if(positions.robots, std::back_inserter(finite.robots), IsFinite);
    if (!finite.robots.empty())
    {
        _impl->SendPosition(finite, now, out);
    }
}

void AcsSession::Answer(
    EAcsCommand command,
    std::string_view transactionID,
    EAckResult result,
    std::string_view message,
    const AckPayload& payload,
    Core::Now now,
    SessionActions& out)
{
    _impl->Answer({command, std::string(transactionID), {}, result, std::string(message), payload, false}, now, out);
}

bool AcsSession::IsRegistered() const noexcept
{
    return _impl->IsRegistered();
}

std::size_t AcsSession::GetRoom() const noexcept
{
    return _impl->GetRoom();
}

void AcsSession::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _impl->SetSiteOffset(offset);
}

const SessionStatistics& AcsSession::GetStatistics() const noexcept
{
    return _impl->GetStatistics();
}

} // namespace ACS::Protocol
