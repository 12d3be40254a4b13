#pragma once

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

enum class EClientState : std::uint8_t
{
    Stopped,
    Connecting,
    Handshaking,
    Ready,
    Waiting, ///< For the next attempt.
    Ending,  ///< STOP session is on its way.
};

/// The client's side of an Open Stream, without I/O: events and the time in, actions and events out, appended to a vector
/// that the caller reuses. The caller carries out each batch, in order, before the next event. Reconnects for ever, and
/// after each handshake establishes the MONITOR again.
///
/// MONITOR data is not fit for real-time decisions: the network, both systems and the controller's load delay it by tens
/// of milliseconds now and then.
///
/// CONTROL, MONITOR and STOP carry no number, and neither do the refusals. So that a refusal can be told to belong to
/// one of them, they go one after another: the next is sent when the previous has its ack or, a CONTROL, when its window
/// (ClientSessionOptions::controlWindow) has passed in silence. A CONTROL that is Streamed does not wait; do not mix both
/// kinds, as a streamed one's refusal would be taken for that of the tracked one in flight.
class ClientSession
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source scatters the reconnects and must outlive the session.
    ClientSession(const ClientSessionOptions& options, Core::IRandom& random);
    ClientSession(const ClientSession&) = delete;
    ClientSession& operator=(const ClientSession&) = delete;
    ~ClientSession();

    /// Begins, and connects for ever. → Connect, StartTimer. Nothing where it has begun already.
    void Start(Core::Now now, ClientActions& out);

    /// STOP session, then the close: ClientEnded is the last event. Without a session at once. → Send, timers, Close,
    /// ClientControlSettled, ClientEnded.
    void Stop(Core::Now now, ClientActions& out);

    /// The MONITOR to have from now on and after every reconnect; nullopt for none. The period is clamped. The calls are
    /// numbered, the first one is 1: ClientMonitorStarted has the number. → Send, timers.
    void SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out);

    /// Sends a CONTROL, at once or in its turn. The token comes back in ClientControlSettled, for a tracked one, which
    /// may be in this very batch (NotSent). Nothing is sent later than the session that it was given in. → Send, timers,
    /// ClientControlSettled, ClientControlFault.
    std::uint64_t SendControl(
        const ControlRequest& request,
        EControlTracking tracking,
        Core::Now now,
        ClientActions& out);

    /// Likewise, with a time limit and a confirmation of its own.
    std::uint64_t SendControlCall(ControlCall call, Core::Now now, ClientActions& out);

    /// STOP control: the hard stop. Goes at once, whatever is in flight: a CONTROL that is becomes Unknown, those that
    /// wait are settled as NotSent, those that wait for a confirmation as Unknown. Nothing without a session. → Send, timers, ClientControlSettled, later ClientStopped.
    void StopControl(Core::Now now, ClientActions& out);

    /// → Send, timers.
    void OnConnected(Core::Now now, ClientActions& out);
    /// → ClientLost, timers.
    void OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out);
    /// → everything.
    void OnBytes(std::string_view bytes, Core::Now now, ClientActions& out);
    /// The text of the last ClientSend has left. → Send, timers.
    void OnSendCompleted(Core::Now now, ClientActions& out);
    /// The server closed the connection. → Close, ClientLost, timers.
    void OnPeerClosed(Core::Now now, ClientActions& out);
    /// → Close, ClientLost, timers.
    void OnSocketError(std::string_view detail, Core::Now now, ClientActions& out);
    /// As asked for by ClientStartTimer. → everything.
    void OnTimer(EClientTimer timer, Core::Now now, ClientActions& out);

    [[nodiscard]] EClientState GetState() const noexcept;
    [[nodiscard]] const ClientSessionStats& GetStats() const noexcept;

    /// The newest sample of the present MONITOR; null before its first one and without a connection. Valid until the next
    /// event. How old it is tells its receivedAt.
    [[nodiscard]] const ClientData* GetLatestOrNull() const noexcept;

    /// How good the present MONITOR is, since it was (re-)established.
    [[nodiscard]] StreamQuality GetQuality() const;
};

} // namespace ACS::OpenStream
