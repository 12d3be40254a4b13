#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/Uuid.hpp>
#include <acs/protocol/DurableOutbox.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::Protocol
{

bool IsDurable(const AcsPayload& payload) noexcept
{
    const EAcsCommand command = GetCommand(payload);
    return command >= EAcsCommand::PlanReport && command <= EAcsCommand::ErrorReport;
}

DurableOutbox::DurableOutbox(IOutboxStore& store, Core::IRandom& random)
    : _store(store),
      _random(random)
{
}

void DurableOutbox::Restore(std::vector<DurableRequest> requests)
{
    assert(_requests.empty() && "the store is read before the first report");
    std::ranges::sort(requests, {}, &DurableRequest::sequence);
    _lastSequence = requests.empty() ? 0 : requests.back().sequence;
    std::erase_if(requests, [](const DurableRequest& request) { return !IsDurable(request.request.payload); });
    _requests.assign(std::make_move_iterator(requests.begin()), std::make_move_iterator(requests.end()));
}

Core::Result<void> DurableOutbox::Add(AcsPayload payload, const Core::Timestamp& timestamp)
{
    if (!IsDurable(payload))
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "payload",
            "a report",
            std::string(GetText(GetCommand(payload))));
    }
    DurableRequest request{_lastSequence + 1, {Core::MakeUUID(_random), timestamp, std::move(payload)}};
    Core::Result<void> stored = _store.Append(request);
    if (stored.has_value())
    {
        Queue(std::move(request));
        return stored;
    }
    // The number is not used again: the store may have it.
    _lastSequence = request.sequence;
    return stored;
}

void DurableOutbox::Queue(DurableRequest request)
{
    assert(request.sequence > _lastSequence && "requests are queued in their order");
    _lastSequence = request.sequence;
    if (IsDurable(request.request.payload))
    {
        _requests.push_back(std::move(request));
    }
}

void DurableOutbox::Drop(std::uint64_t sequence)
{
    const auto found = std::ranges::lower_bound(_requests, sequence, {}, &DurableRequest::sequence);
    if (found != _requests.end() && found->sequence == sequence)
    {
        Erase(found);
    }
}

Core::Result<std::size_t> DurableOutbox::Discard(const std::function<bool(const DurableRequest& request)>& predicate)
{
    std::vector<std::uint64_t> dropped;
    std::deque<DurableRequest> kept;
    std::size_t keptSent = 0;
    for (std::size_t i = 0; i < _requests.size(); ++i)
    {
        if (predicate(_requests[i]))
        {
            dropped.push_back(_requests[i].sequence);
            continue;
        }
        kept.push_back(std::move(_requests[i]));
        keptSent += i < _sent ? 1 : 0;
    }
    _requests = std::move(kept);
    _sent = keptSent;
    Core::Result<std::size_t> result = dropped.size();
    for (const std::uint64_t sequence : dropped) // the store may queue further requests from within
    {
        if (const Core::Result<void> removed = _store.Remove(sequence); !removed.has_value() && result.has_value())
        {
            result = tl::unexpected(removed.error());
        }
    }
    return result;
}

Core::Result<void> DurableOutbox::OnEvent(const SessionEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [this](const Registered& /*registered*/) -> Core::Result<void> {
                _sent = 0;
                _phase = EPhase::Replaying;
                return {};
            },
            [this](const LinkLost& /*lost*/) -> Core::Result<void> {
                _phase = EPhase::Closed;
                return {};
            },
            [this](const Stopped& /*stopped*/) -> Core::Result<void> {
                _phase = EPhase::Closed;
                return {};
            },
            [this](const Acked& acked) { return Remove(acked.transactionID); },
            [](const auto& /*other*/) -> Core::Result<void> {
                return {};
            }},
        event);
}

const std::deque<DurableRequest>& DurableOutbox::GetRequests() const noexcept
{
    return _requests;
}

void DurableOutbox::Erase(const std::deque<DurableRequest>::const_iterator& request)
{
    if (std::cmp_less(request - _requests.cbegin(), _sent))
    {
        --_sent;
    }
    _requests.erase(request);
}

Core::Result<void> DurableOutbox::Remove(std::string_view transactionID)
{
    const auto found = std::ranges::find(_requests, transactionID, [](const DurableRequest& request) {
        return std::string_view(request.request.transactionID);
    });
    if (found == _requests.end())
    {
        return {}; // a second Ack
    }
    const std::uint64_t sequence = found->sequence;
    Erase(found);
    return _store.Remove(sequence);
}

} // namespace ACS::Protocol
