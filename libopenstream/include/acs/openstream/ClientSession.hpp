#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/core/BoundedQueue.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/openstream/LineFramer.hpp>
#include <acs/openstream/LineOutbox.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>
#include <acs/openstream/StreamMeter.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    struct PendingControl
    {
        std::uint64_t token = 0;
        Core::SteadyTime deadline; ///< By then it has left.
        ControlCall call;
    };

    /// Of a CONTROL whose window has passed.
    struct Confirmation
    {
        std::uint64_t token = 0;
        Core::SteadyTime deadline;
        std::function<bool(const DataLine& sample)> isConfirmed;
    };

    enum class EInFlight : std::uint8_t
    {
        Nothing,
        Handshake,
        Monitor,
        Control,
        StopMonitor,
        StopSession,
    };

    ClientSessionOptions _options;
    Core::IRandom& _random;
    Core::Backoff _backoff;
    OpenStreamCodec _codec;
    LineFramer _framer;
    LineOutbox _outbox;
    ClientSessionStats _stats;
    EClientState _state = EClientState::Stopped;

    EInFlight _inFlight = EInFlight::Nothing;
    PendingControl _control;        ///< The one in flight.
    std::uint64_t _controlMark = 0; ///< Of its last byte in the outbox.
    Core::SteadyTime _controlLeftAt;
    bool _bControlLeft = false;
    bool _bControlConfirmed = false;
    std::vector<Confirmation> _confirmations;
    Core::SteadyTime _waitingDue =
        Core::SteadyTime::max(); ///< When the CONTROLs that wait in the outbox have to have left.
    Core::SteadyTime _sendingDue = Core::SteadyTime::max(); ///< Likewise those in flight, the tracked one apart.
    Core::SteadyTime _controlTimerAt;
    bool _bControlTimerArmed = false;

    std::optional<MonitorRequest> _monitor;
    std::uint64_t _monitorNumber = 0;     ///< Of the last SetMonitor call.
    std::uint64_t _sentMonitorNumber = 0; ///< Of the last MONITOR that was sent.
    std::string _sentMonitorUrl;          ///< Likewise.
    bool _bMonitorDue = false;            ///< The wish has changed and the server does not know.
    bool _bMonitorOn = false;             ///< The server streams, as far as we know.
    bool _bMonitorStopFirst = false;      ///< It said monitor_already_active.
    bool _bStale = false;
    bool _bDataAgeArmed = false;
    Core::SteadyTime _dataAgeAt;
    Core::SteadyTime _lastDataAt;
    StreamMeter _meter;
    std::optional<ClientData> _latest;

    Core::BoundedQueue<PendingControl> _controls;
    std::uint64_t _lastToken = 0;

    void Connect(Core::Now now, ClientActions& out);
    void ProcessLine(std::string_view text, Core::Now now, ClientActions& out);
    void Handle(HandshakeAck& ack, Core::Now now, ClientActions& out);
    void Handle(MonitorAck& ack, Core::Now now, ClientActions& out);
    void Handle(DataLine& line, Core::Now now, ClientActions& out);
    void Handle(StopAck& ack, Core::Now now, ClientActions& out);
    void Handle(ControlError& error, Core::Now now, ClientActions& out);
    void Handle(ErrorLine& error, Core::Now now, ClientActions& out);
    void HandleErrorWhenReady(ErrorLine& error, Core::Now now, ClientActions& out);
    void HandleMonitorError(ErrorLine& error, ClientActions& out);
    void HandleStopError(ErrorLine& error, ClientActions& out);
    void RefuseControl(int status, std::optional<Core::JsonText> body, std::string detail, ClientActions& out);
    void SettleInFlight(EControlOutcome outcome, std::string_view detail, ClientActions& out);
    void SettleWaiting(std::string_view detail, ClientActions& out);
    void FinishInFlight(ClientActions& out);
    void SendNext(Core::Now now, ClientActions& out);
    [[nodiscard]] bool TrySendMonitorWish(Core::Now now, ClientActions& out);
    void SendNow(const OpenStreamRequest& request, ClientActions& out);
    void SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out);
    [[nodiscard]] Core::SteadyTime GetControlDeadline(std::chrono::milliseconds own, Core::Now now) const;
    [[nodiscard]] Core::SteadyTime GetSendDeadline() const noexcept;
    void SendAwaited(const OpenStreamRequest& request, EInFlight kind, Core::Now now, ClientActions& out);
    void Flush(ClientActions& out);
    void FinishControlWindow(Core::Now now, ClientActions& out);
    void Confirm(const DataLine& sample, ClientActions& out);
    void CheckControls(Core::Now now, ClientActions& out);
    void ArmControlTimer(ClientActions& out);
    void SettleConfirmations(std::string_view detail, ClientActions& out);
    void SendControlInTurn(PendingControl control, ClientActions& out);
    [[nodiscard]] bool IsConnected() const noexcept;
    [[nodiscard]] std::chrono::milliseconds GetDataLimit() const noexcept;
    void ArmDataAge(ClientActions& out);
    void CheckDataAge(Core::Now now, ClientActions& out);
    void OnAnswerTimeout(Core::Now now, ClientActions& out);
    void Lose(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void Disconnect(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void DropConnection(std::string_view detail, ClientActions& out);
    void End(ClientActions& out);

public:
    /// The random source scatters the reconnects and must outlive the session.
    ClientSession(const ClientSessionOptions& options, Core::IRandom& random);

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
