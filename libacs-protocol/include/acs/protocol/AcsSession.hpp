#pragma once

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

/// The ACS's side of the protocol as a pure state machine: events and the time go in, actions come out, appended to a
/// vector that the caller clears and reuses. No I/O, no clock, no thread; not shared between threads.
///
/// Order on every connection (section 6): Registration and nothing else; after its Ack `Registered`; the caller feeds
/// its unacknowledged requests, oldest first, with TrySendDurable (false: wait for WindowOpened), then calls ReplayDone
/// once; the session sends TscStateUpdate, AcsCommStateUpdate and one RobotStatusUpdate per robot, as far as
/// SendStatus ever set them, and asks for positions. What is durable stays with the caller until `Acked`.
///
/// Any function that takes a text or answers one may deliver ProtocolNoted.
class AcsSession
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source makes transaction ids and the jitter of reconnects; it outlives the session.
    AcsSession(const SessionOptions& options, Core::IRandom& random);
    AcsSession(const AcsSession&) = delete;
    AcsSession& operator=(const AcsSession&) = delete;
    ~AcsSession();

    /// Connect. Nothing if it is started already.
    void Start(Core::Now now, SessionActions& out);

    /// Where registered: AcsCommStateUpdate(false) as SendText, and after its Ack or the grace Close; else Close, or
    /// where there is no connection Stopped at once. Timers are cancelled. Ends with Deliver Stopped.
    void Stop(Core::Now now, SessionActions& out);

    /// The connection is open: SendText (Registration), StartTimer.
    void OnConnected(Core::Now now, SessionActions& out);

    /// A whole message, text or binary. SendText (refusals, stored Acks, what waited for room), StartTimer, CancelTimer,
    /// Close (registration refused), Deliver of Registered, RegistrationRefused, RequestReceived, Acked, WindowOpened.
    void OnText(std::string_view text, Core::Now now, SessionActions& out);

    /// The connection is closed, was lost or could not be made: Deliver LinkLost or Stopped, CancelTimer, StartTimer.
    void OnClosed(std::string_view reason, Core::Now now, SessionActions& out);

    /// SendText (resends), Connect, Close, StartTimer, Deliver of RequestUnanswered, WindowOpened, PositionDue.
    /// A timer that is not running is ignored.
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out);

    /// SendText, StartTimer. False, and nothing done, where the session is not registered, is stopping, or the window is
    /// full: the caller keeps the request and feeds it after Registered or WindowOpened. The transactionID and the
    /// timestamp are the caller's, and the same on every attempt. True and nothing done where it is in flight already.
    [[nodiscard]] bool TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out);

    /// After the replay that Registered asked for, once per connection: SendText, StartTimer, Deliver PositionDue. Where
    /// the replay fills the window, the states and the first PositionDue follow as Acks make room.
    void ReplayDone(Core::Now now, SessionActions& out);

    /// A TscStateUpdate, AcsCommStateUpdate or RobotStatusUpdate: the latest of each kind and robot is kept, sent at once
    /// where possible and after every ReplayDone again; a TSC or comm state that has not changed is not sent. SendText,
    /// StartTimer. Other payloads are a defect of the caller.
    void SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out);

    /// SendText that may be dropped; nothing at all before the first PositionDue of the connection.
    void SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out);

    /// The answer to a RequestReceived: SendText where registered. Kept, so that the request, if it comes again, is
    /// answered by the same text and not delivered. A second answer is ignored; one to a
    /// request that is forgotten by now is sent and not kept.
    void Answer(
        EAcsCommand command,
        std::string_view transactionID,
        EAckResult result,
        std::string_view message,
        const AckPayload& payload,
        Core::Now now,
        SessionActions& out);

    [[nodiscard]] bool IsRegistered() const noexcept;

    /// How many more TrySendDurable would be taken now.
    [[nodiscard]] std::size_t GetRoom() const noexcept;

    /// For the timestamps sent from now on (daylight saving).
    void SetSiteOffset(std::chrono::minutes offset) noexcept;

    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept;
};

} // namespace ACS::Protocol
