#include "HeldAcks.hpp"

#include "PendingRequests.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Protocol::Detail
{

void HeldAcks::Begin(const AckHold& hold, Core::Now now)
{
    std::erase_if(_holds, [now](const RunningHold& running) { return running.end <= now.steady; });
    _holds.push_back({hold, now.steady + hold.duration});
}

void HeldAcks::EndAll() noexcept
{
    _holds.clear();
}

const AckHold* HeldAcks::FindOrNull(EAcsCommand command, Core::Now now) const
{
    const auto found = std::find_if(_holds.rbegin(), _holds.rend(), [command, now](const RunningHold& running) {
        return running.hold.command.value_or(command) == command && now.steady < running.end;
    });
    return found == _holds.rend() ? nullptr : &found->hold;
}

void HeldAcks::Keep(Ack ack)
{
    _acks.push_back(std::move(ack));
}

std::vector<HeldAcks::Ack> HeldAcks::TakeDue(Core::Now now)
{
    const auto later =
        std::stable_partition(_acks.begin(), _acks.end(), [now](const Ack& ack) { return ack.deadline <= now.steady; });
    std::vector<Ack> due(std::make_move_iterator(_acks.begin()), std::make_move_iterator(later));
    _acks.erase(_acks.begin(), later);
    return due;
}

void HeldAcks::Forget(ConnectionID connection)
{
    std::erase_if(_acks, [connection](const Ack& ack) { return ack.connection == connection; });
}

std::optional<std::chrono::milliseconds> HeldAcks::GetDelayOrNull(Core::Now now) const
{
    return _acks.empty() ? std::nullopt : std::optional(GetNextDelay(_acks, now));
}

bool HeldAcks::HasRegistrationOfOther(ConnectionID connection) const
{
    return std::any_of(_acks.begin(), _acks.end(), [connection](const Ack& ack) {
        return ack.bRegisters && ack.connection != connection;
    });
}

} // namespace ACS::Protocol::Detail
