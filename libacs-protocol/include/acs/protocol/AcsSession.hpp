#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol/SessionOptions.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// The ACS side of the protocol as a pure state machine: events and the time go in, actions come out, appended to a
/// vector that the caller clears and reuses. No I/O, no clock, no thread; not shared between threads. Move the actions out of
/// the vector before carrying them out: a call that one of them causes appends to it.
///
/// Every connection follows section 6: Registration first; after its Ack the session delivers `Registered`; the caller
/// sends its unacknowledged requests, oldest first, with TrySendDurable (false: wait for WindowOpened), and calls
/// ReplayDone once; the session then sends TscStateUpdate, AcsCommStateUpdate and one RobotStatusUpdate per robot, as set
/// by SendStatus, and requests positions. The caller keeps a durable request until `Acked`: see DurableOutbox.
///
/// Any function that receives or answers a text may deliver ProtocolNoted.
class ACS_API AcsSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source generates transaction ids and the jitter of reconnects. It must outlive the session.
    AcsSession(const SessionOptions& options, Core::IRandom& random);
    AcsSession(const AcsSession&) = delete;
    AcsSession& operator=(const AcsSession&) = delete;
    ~AcsSession();

    /// Connect. No effect if the session is started already.
    void Start(Core::Now now, SessionActions& out);

    /// If registered: SendText of AcsCommStateUpdate(false), then Close after its Ack or SessionOptions::shutdownGrace;
    /// otherwise Close at once. Timers are cancelled. Ends with Deliver Stopped, at once if there is no connection.
    void Stop(Core::Now now, SessionActions& out);

    /// The connection is open: SendText (Registration), StartTimer.
    void OnConnected(Core::Now now, SessionActions& out);

    /// A whole message, text or binary. SendText (refusals, cached Acks, queued messages), StartTimer, CancelTimer,
    /// Close (registration refused), Deliver of Registered, RegistrationRefused, RequestReceived, Acked, WindowOpened.
    void OnText(std::string_view text, Core::Now now, SessionActions& out);

    /// The connection was closed, was lost or could not be opened: Deliver LinkLost or Stopped, CancelTimer, StartTimer.
    void OnClosed(std::string_view reason, Core::Now now, SessionActions& out);

    /// SendText (resends), Connect, Close, StartTimer, Deliver of RequestUnanswered, WindowOpened, PositionDue.
    /// A timer that is not running is ignored.
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out);

    /// A report (IsDurable). SendText, StartTimer. Returns false and does nothing if the session is not registered or is
    /// stopping, or if the window is full: the caller keeps the request and sends it after Registered or WindowOpened. Also
    /// false, always, for another payload: use SendStatus, SendPosition. The caller assigns
    /// transactionID and timestamp, which are the same on every attempt. Returns true and does nothing if the request is
    /// in flight already.
    [[nodiscard]] bool TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out);

    /// Ends the replay after Registered, once per connection: SendText, StartTimer, Deliver PositionDue. If the replay has
    /// filled the window, the states and the first PositionDue follow as Acks arrive.
    void ReplayDone(Core::Now now, SessionActions& out);

    /// A TscStateUpdate, AcsCommStateUpdate or RobotStatusUpdate. The latest of each kind and robot is kept, sent as soon
    /// as possible and again after every ReplayDone; an unchanged TSC or comm state is not sent. SendText, StartTimer.
    /// An Arrival or Stopped that waits for room is kept beside the latest. Other payloads are a programming error.
    void SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out);

    /// SendText that may be dropped. No effect before the first PositionDue of the connection. A robot with a number that is
    /// not finite is left out; if no other robot is left, nothing is sent.
    void SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out);

    /// Answers a RequestReceived: SendText if registered. The Ack is cached, and a repeated request is answered with the
    /// same text and not delivered. A second answer is ignored; an answer to a request that is no longer remembered is sent
    /// and not cached.
    void Answer(
        EAcsCommand command,
        std::string_view transactionID,
        EAckResult result,
        std::string_view message,
        const AckPayload& payload,
        Core::Now now,
        SessionActions& out);

    /// Whether the MCS has accepted the Registration of the current connection.
    [[nodiscard]] bool IsRegistered() const noexcept;

    /// Number of requests that TrySendDurable would accept now.
    [[nodiscard]] std::size_t GetRoom() const noexcept;

    /// UTC offset of the timestamps that are sent from now on, and of those without one that are received (daylight saving).
    void SetSiteOffset(std::chrono::minutes offset) noexcept;

    /// Counters since the session was created, over all connections.
    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept;
};

} // namespace ACS::Protocol
