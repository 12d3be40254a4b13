#pragma once

#include "LineFramer.hpp"
#include "LineOutbox.hpp"
#include "StreamMeter.hpp"
#include <acs/core/Backoff.hpp>
#include <acs/core/BoundedQueue.hpp>
#include <acs/openstream/ClientSession.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

class ClientSession::Impl
{
    struct PendingControl
    {
        std::uint64_t token = 0;
        Core::SteadyTime deadline; ///< For sending it.
        ControlCall call;
    };

    /// A CONTROL whose window has passed and whose confirmation is pending.
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
    std::uint64_t _inFlightMark = 0; ///< Position of its last byte in the outbox.
    PendingControl _control;         ///< The one in flight.
    Core::SteadyTime _controlLeftAt;
    bool _bControlLeft = false;
    bool _bControlConfirmed = false;
    std::vector<Confirmation> _confirmations;
    Core::SteadyTime _waitingDue = Core::SteadyTime::max(); ///< Deadline for sending the CONTROLs in the outbox.
    Core::SteadyTime _sendingDue =
        Core::SteadyTime::max(); ///< Likewise for those in flight, except for the tracked one.
    Core::SteadyTime _controlTimerAt;
    bool _bControlTimerArmed = false;

    std::optional<MonitorRequest> _monitor;
    std::uint64_t _monitorNumber = 0;        ///< Of the last SetMonitor call.
    std::uint64_t _sentMonitorNumber = 0;    ///< Of the last MONITOR sent.
    std::uint64_t _startedMonitorNumber = 0; ///< Of the last MONITOR that the server accepted in this session; 0: none.
    std::string _sentMonitorURL;             ///< Likewise.
    bool _bMonitorDue = false;               ///< SetMonitor was called and nothing was sent yet.
    bool _bMonitorOn = false;                ///< The server streams, as far as known.
    bool _bMonitorStopFirst = false;         ///< The server answered monitor_already_active.
    bool _bStale = false;
    bool _bDataAgeArmed = false;
    Core::SteadyTime _dataAgeAt;
    Core::SteadyTime _lastDataAt;
    StreamMeter _meter;
    std::optional<ClientData> _latest;

    std::uint64_t _stopMark = 0; ///< Position of the last byte of the last STOP control in the outbox.
    Core::BoundedQueue<PendingControl> _controls;
    std::uint64_t _lastToken = 0;

public:
    Impl(const ClientSessionOptions& options, Core::IRandom& random);

    void Start(Core::Now now, ClientActions& out);
    void Stop(Core::Now now, ClientActions& out);
    void SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out);
    std::uint64_t SendControl(
        const ControlRequest& request,
        EControlTracking tracking,
        Core::Now now,
        ClientActions& out);
    std::uint64_t SendControlCall(ControlCall call, Core::Now now, ClientActions& out);
    void StopControl(Core::Now now, ClientActions& out);
    void OnConnected(Core::Now now, ClientActions& out);
    void OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out);
    void OnBytes(std::string_view bytes, Core::Now now, ClientActions& out);
    void OnSendCompleted(Core::Now now, ClientActions& out);
    void OnPeerClosed(Core::Now now, ClientActions& out);
    void OnSocketError(std::string_view detail, Core::Now now, ClientActions& out);
    void OnTimer(EClientTimer timer, Core::Now now, ClientActions& out);
    [[nodiscard]] EClientState GetState() const noexcept;
    [[nodiscard]] const ClientSessionStats& GetStats() const noexcept;
    [[nodiscard]] const ClientData* GetLatestOrNull() const noexcept;
    [[nodiscard]] StreamQuality GetQuality() const;

private:
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
    void RefuseControl(int status, std::optional<Core::JsonText> bodyOrNull, std::string detail, ClientActions& out);
    void SettleInFlight(EControlOutcome outcome, std::string_view detail, ClientActions& out);
    void SettleWaiting(std::string_view detail, ClientActions& out);
    void FinishInFlight(ClientActions& out);
    void SendNext(Core::Now now, ClientActions& out);
    [[nodiscard]] bool TrySendMonitor(Core::Now now, ClientActions& out);
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
    /// Whether a command of this kind has been given to the socket and has no answer. What has not left has no answer
    /// either: a server that does not read could otherwise fill the outbox.
    [[nodiscard]] bool IsAwaited(EInFlight kind) const noexcept;
    /// Whether the server streams the MONITOR of the last SetMonitor call.
    [[nodiscard]] bool IsMonitorCurrent() const noexcept;
    [[nodiscard]] bool IsConnected() const noexcept;
    [[nodiscard]] std::chrono::milliseconds GetDataLimit() const noexcept;
    void ArmDataAge(ClientActions& out);
    void CheckDataAge(Core::Now now, ClientActions& out);
    void OnAnswerTimeout(Core::Now now, ClientActions& out);
    void HandleLoss(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void Disconnect(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void DropConnection(std::string_view detail, ClientActions& out);
    void End(ClientActions& out);
};

} // namespace ACS::OpenStream
