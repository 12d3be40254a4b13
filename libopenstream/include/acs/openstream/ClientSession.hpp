#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/openstream/StreamQuality.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace ACS::OpenStream
{

/// How far a ClientSession is.
enum class EClientState : std::uint8_t
{
    Stopped,     ///< Not started, or Stop is complete.
    Connecting,  ///< A connection attempt is under way.
    Handshaking, ///< Connected; waits for the ack of HANDSHAKE.
    Ready,       ///< CONTROLs are accepted.
    Waiting,     ///< For the next connection attempt.
    Ending,      ///< STOP session was sent.
};

/// The client side of an Open Stream, without I/O: events and the time go in, actions and events come out, appended to a
/// vector that the caller reuses. The caller carries out each batch, in order, before the next event. It moves the batch out
/// of the vector first: a call that an event of the batch causes appends to the vector. Reconnects indefinitely, and
/// establishes the MONITOR again after each handshake.
///
/// MONITOR data is not suitable for real-time decisions: the network, both systems and the controller's load occasionally
/// delay it by tens of milliseconds.
///
/// CONTROL, MONITOR and STOP carry no number, and neither do refusals. The session therefore sends them one at a time, in
/// order to match a refusal to its command: the next one follows the ack of the previous one or, for a CONTROL, the end of
/// its window (ClientSessionOptions::controlWindow) without a refusal. A Streamed CONTROL does not wait; do not mix both
/// kinds, because the refusal of a streamed one would be matched to the tracked one in flight.
///
/// "→" lists the actions that a function may append.
class ACS_API ClientSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source provides the jitter of reconnects. It must outlive the session.
    ClientSession(const ClientSessionOptions& options, Core::IRandom& random);
    ClientSession(const ClientSession&) = delete;
    ClientSession& operator=(const ClientSession&) = delete;
    ~ClientSession();

    /// Connects, and reconnects until Stop. → Connect, StartTimer. No effect if started already.
    void Start(Core::Now now, ClientActions& out);

    /// Sends STOP session, then closes; without a session, closes at once. ClientEnded is the last event. → Send, timers,
    /// Close, ClientControlSettled, ClientEnded.
    void Stop(Core::Now now, ClientActions& out);

    /// Sets the MONITOR, also for later connections; nullopt: none. The period is clamped. The calls are numbered from 1:
    /// ClientMonitorStarted has the number. → Send, timers.
    void SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out);

    /// Sends a CONTROL, at once or in its turn. For a tracked one, ClientControlSettled has the returned token; it may be in
    /// the same batch (NotSent). A CONTROL is never sent in a later session. → Send, timers, ClientControlSettled,
    /// ClientControlFault.
    std::uint64_t SendControl(
        const ControlRequest& request,
        EControlTracking tracking,
        Core::Now now,
        ClientActions& out);

    /// Like SendControl, with its own time limit and confirmation.
    std::uint64_t SendControlCall(ControlCall call, Core::Now now, ClientActions& out);

    /// STOP control, the hard stop of a trajectory. It stops neither a single move (execute_move) nor a program: these need a
    /// CONTROL of /project/robot/stop. It is sent at once, before all that waits for the socket: a CONTROL that was given to the
    /// socket or waits for a confirmation is settled as Unknown, an earlier one as NotSent. Streamed CONTROLs that wait for the
    /// socket are dropped. A later tracked CONTROL or MONITOR still waits for the end of that CONTROL's window, because its
    /// refusal may come. No effect without a session. → Send, timers, ClientControlSettled, later ClientStopped.
    void StopControl(Core::Now now, ClientActions& out);

    /// → Send, timers.
    void OnConnected(Core::Now now, ClientActions& out);
    /// → ClientLost, timers.
    void OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out);
    /// → any action.
    void OnBytes(std::string_view bytes, Core::Now now, ClientActions& out);
    /// The text of the last ClientSend was written. → Send, timers.
    void OnSendCompleted(Core::Now now, ClientActions& out);
    /// The server closed the connection. → Close, ClientLost, timers.
    void OnPeerClosed(Core::Now now, ClientActions& out);
    /// → Close, ClientLost, timers.
    void OnSocketError(std::string_view detail, Core::Now now, ClientActions& out);
    /// Requested by ClientStartTimer. → any action.
    void OnTimer(EClientTimer timer, Core::Now now, ClientActions& out);

    /// After the last call.
    [[nodiscard]] EClientState GetState() const noexcept;
    /// Counters since the session was created.
    [[nodiscard]] const ClientSessionStats& GetStats() const noexcept;

    /// The newest sample of the current MONITOR; null before the first one and without a connection. Valid until the next
    /// event. Its receivedAt gives its age.
    [[nodiscard]] const ClientData* GetLatestOrNull() const noexcept;

    /// Quality of the current MONITOR since it was (re-)established.
    [[nodiscard]] StreamQuality GetQuality() const;
};

} // namespace ACS::OpenStream
