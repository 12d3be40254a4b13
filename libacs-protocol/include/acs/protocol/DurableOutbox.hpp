#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/protocol/DurableRequest.hpp>
#include <acs/protocol/IOutboxStore.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Protocol
{

/// The reports that an ACS must not lose: stored before they are sent, sent in order, replayed after a reconnect or a
/// restart, and forgotten when the MCS has acknowledged them. Pure: the store and the session are the caller's. Not
/// shared between threads.
///
///     outbox.Add(report, timestamp);           // or: outbox.OnEvent(event), for each event of the session
///     outbox.Feed(client);
class ACS_API DurableOutbox
{
    enum class EPhase : std::uint8_t
    {
        Closed,    ///< No session is registered: nothing is sent.
        Replaying, ///< From Registered until everything was sent once.
        Open       ///< Reports are sent as they are added.
    };

    IOutboxStore& _store;
    Core::IRandom& _random;
    std::deque<DurableRequest> _requests; ///< Without an Ack, in order. The first _sent of them are with the session.
    std::size_t _sent = 0;
    std::uint64_t _lastSequence = 0;
    EPhase _phase = EPhase::Closed;

public:
    /// The random source generates transaction ids. Store and random source must outlive the outbox.
    DurableOutbox(IOutboxStore& store, Core::IRandom& random);

    /// Requests that the store returned at start, in any order. Call before all other functions. A request that is not
    /// IsDurable is ignored.
    void Restore(std::vector<DurableRequest> requests);

    /// Assigns sequence and transactionID, stores the report and queues it. On an error of the store the report is not
    /// queued: whatever it reports must not have happened, or the caller adds it again. A payload that is not IsDurable is
    /// an error (UnknownWord) and is not stored.
    [[nodiscard]] Core::Result<void> Add(AcsPayload payload, const Core::Timestamp& timestamp);

    /// Queues a request that the caller has stored itself, for example together with the state it reports. Its sequence
    /// is higher than that of all requests before it. A request that is not IsDurable is ignored.
    void Queue(DurableRequest request);

    /// Drops a request that the caller has removed from the store itself; no effect if there is none. Its Ack is ignored.
    void Drop(std::uint64_t sequence);

    /// Drops the requests for which the predicate is true, in the store as well: they are not sent again. Returns their
    /// number. An error is that of IOutboxStore::Remove; the outbox has dropped them nevertheless.
    [[nodiscard]] Core::Result<std::size_t> Discard(
        const std::function<bool(const DurableRequest& request)>& predicate);

    /// Handles Registered, LinkLost, Stopped and Acked; other events have no effect. An error is that of
    /// IOutboxStore::Remove; the outbox has forgotten the request nevertheless.
    [[nodiscard]] Core::Result<void> OnEvent(const SessionEvent& event);

    /// Sends what the session accepts, in order, and ends the replay of a connection. Before Registered, and after LinkLost
    /// or Stopped, it sends nothing. Call after Restore, Add, Queue, Discard and OnEvent. The session has
    /// TrySendDurable(request) and ReplayDone(), as an AcsClient has.
    template <typename TSession>
    void Feed(TSession& session)
    {
        if (_phase == EPhase::Closed)
        {
            return;
        }
        while (_sent < _requests.size() && session.TrySendDurable(_requests[_sent].request))
        {
            ++_sent;
        }
        if (_phase == EPhase::Replaying && _sent == _requests.size())
        {
            _phase = EPhase::Open;
            session.ReplayDone();
        }
    }

    /// Requests without an Ack, in order.
    [[nodiscard]] const std::deque<DurableRequest>& GetRequests() const noexcept;

private:
    void Erase(const std::deque<DurableRequest>::const_iterator& request);
    [[nodiscard]] Core::Result<void> Remove(std::string_view transactionID);
};

} // namespace ACS::Protocol
