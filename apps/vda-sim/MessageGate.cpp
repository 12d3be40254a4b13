#include "vda-sim/MessageGate.hpp"

#include <acs/vda5050/Topic.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double FULL_PERCENT = 100.0;
constexpr double RANDOM_RANGE = 18446744073709551616.0; // 2^64

/// [0, 1)
double Draw(Core::IRandom& random)
{
    // A double keeps 53 of the 64 bits; without the last ones the quotient never rounds up to 1.
    constexpr std::uint64_t LAST_BITS = 0x7FF;
    return static_cast<double>(random.GetNext() & ~LAST_BITS) / RANDOM_RANGE;
}

std::size_t GetSize(const VDA5050::MqttMessage& message)
{
    return message.topic.size() + message.payload.size();
}

bool IsOn(const Fault& fault, std::optional<VDA5050::ETopic> topicOrNull)
{
    return !fault.topic.has_value() || fault.topic == topicOrNull;
}

} // namespace

MessageGate::MessageGate(EFaultDirection direction, Core::Duration orderDelay)
    : _direction(direction),
      _orderDelay(orderDelay)
{
    assert(direction != EFaultDirection::Both);
}

void MessageGate::Pass(
    VDA5050::MqttMessage message,
    const FaultBoard& faults,
    Core::IRandom& random,
    Core::SteadyTime now,
    std::vector<VDA5050::MqttMessage>& out)
{
    if (faults.IsEmpty() && _held.empty() && _orderDelay == Core::Duration::zero())
    {
        out.push_back(std::move(message));
        return;
    }
    const Core::Result<VDA5050::ParsedTopic> parsed = VDA5050::ParseTopic(message.topic);
    const std::optional<VDA5050::ETopic> topic = parsed.has_value() ? std::optional(parsed->topic) : std::nullopt;
    const auto isMine = [&](const Fault& fault) {
        return IsOn(fault, topic) && (fault.direction == EFaultDirection::Both || fault.direction == _direction);
    };
    // The connection message was sent before the vehicle fell silent.
    const bool bSilent = _direction == EFaultDirection::Out && topic != VDA5050::ETopic::Connection
        && faults.FindOrNull(EFaultKind::Silence, isMine) != nullptr;
    const Fault* const loss = faults.FindOrNull(EFaultKind::Loss, isMine);
    if (bSilent || (loss != nullptr && Draw(random) * FULL_PERCENT < loss->percent))
    {
        return;
    }
    Core::SteadyTime due = topic == VDA5050::ETopic::Order ? now + _orderDelay : now;
    if (const Fault* const delay = faults.FindOrNull(EFaultKind::Delay, isMine); delay != nullptr)
    {
        const std::chrono::duration<double, Core::Duration::period> extra(
            Draw(random) * static_cast<double>(delay->jitter.count()));
        due += delay->hold + std::chrono::duration_cast<Core::Duration>(extra);
    }
    due = _held.empty() ? due : std::max(due, _held.back().due);
    if (due <= now && _held.empty())
    {
        out.push_back(std::move(message));
        return;
    }
    const std::size_t bytes = GetSize(message);
    if (_held.size() >= MAX_MESSAGES || _heldBytes + bytes > MAX_BYTES)
    {
        ++_overflow;
        return;
    }
    _heldBytes += bytes;
    _held.push_back({due, std::move(message)});
}

void MessageGate::Release(Core::SteadyTime now, std::vector<VDA5050::MqttMessage>& out)
{
    while (!_held.empty() && _held.front().due <= now)
    {
        _heldBytes -= GetSize(_held.front().message);
        out.push_back(std::move(_held.front().message));
        _held.pop_front();
    }
}

std::optional<Core::SteadyTime> MessageGate::GetNextTimeOrNull() const
{
    return _held.empty() ? std::nullopt : std::optional(_held.front().due);
}

void MessageGate::Clear()
{
    _held.clear();
    _heldBytes = 0;
}

std::size_t MessageGate::TakeOverflow() noexcept
{
    return std::exchange(_overflow, 0);
}

} // namespace ACS::VdaSim
