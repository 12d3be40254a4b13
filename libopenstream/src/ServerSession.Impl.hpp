#pragma once

#include "LineFramer.hpp"
#include "LineOutbox.hpp"
#include <acs/core/BoundedQueue.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::OpenStream
{

class ServerSession::Impl
{
    ServerSessionOptions _options;
    OpenStreamCodec _codec;
    LineFramer _framer;
    LineOutbox _outbox;
    ServerSessionStats _stats;
    EServerState _state = EServerState::Connected;
    EServerCloseReason _closeReason = EServerCloseReason::PeerClosed;

    ApiRequest _monitorCall;
    std::optional<Core::JsonText> _monitorID;
    std::chrono::milliseconds _period{};
    Core::SteadyTime _monitorBegin;
    Core::SteadyTime _nextTick;
    Core::SteadyTime _monitorAskedAt;
    std::uint64_t _monitorToken = 0; ///< Of the call in flight; 0: none.
    bool _bMonitorFailing = false;   ///< Internal errors persist and were reported.

    Core::BoundedQueue<ApiRequest> _controls; ///< The first one is in flight.
    std::size_t _controlBytes = 0;            ///< Of all of them.
    std::uint64_t _controlToken = 0;
    std::uint64_t _lastToken = 0;
    bool _bControlled = false; ///< A CONTROL was received since HANDSHAKE or the last STOP control.

    Core::SteadyTime _connectedAt;
    Core::SteadyTime _lastCommandAt;
    Core::SteadyTime _lastDataAt;
    Core::SteadyTime _watchdogAt;
    bool _bWatchdogArmed = false;
    bool _bReadingPaused = false;
    bool _bContinuing = false;
    bool _bRefusingControls = false;
    bool _bPeerClosed = false;
    bool _bSendShutDown = false;

public:
    explicit Impl(const ServerSessionOptions& options);

    void Start(Core::Now now, ServerActions& out);
    void Reject(std::string_view message, Core::Now now, ServerActions& out);
    void OnBytes(std::string_view bytes, Core::Now now, ServerActions& out);
    void OnContinue(Core::Now now, ServerActions& out);
    void OnTimer(EServerTimer timer, Core::Now now, ServerActions& out);
    void OnServiceAnswer(std::uint64_t token, const ApiResponse& response, Core::Now now, ServerActions& out);
    void OnSendCompleted(Core::Now now, ServerActions& out);
    void OnPeerClosed(Core::Now now, ServerActions& out);
    void OnSocketError(ServerActions& out);
    [[nodiscard]] EServerState GetState() const noexcept;
    [[nodiscard]] const ServerSessionStats& GetStats() const noexcept;

private:
    void ProcessLines(Core::Now now, ServerActions& out);
    void ProcessLine(std::string_view line, Core::Now now, ServerActions& out);
    [[nodiscard]] std::optional<EOpenStreamErrorCode> GetGateErrorOrNull(EOpenStreamCommand command) const;
    void Handle(const HandshakeRequest& request, Core::Now now, ServerActions& out);
    void Handle(const MonitorRequest& request, Core::Now now, ServerActions& out);
    void Handle(const ControlRequest& request, Core::Now now, ServerActions& out);
    void Handle(const StopRequest& request, Core::Now now, ServerActions& out);
    static void FillRequest(
        EApiMethod method,
        std::string_view url,
        const std::optional<Core::JsonText>& argsOrNull,
        ApiRequest& request);
    void StopMonitor(ServerActions& out);
    [[nodiscard]] bool TryStopControl(ServerActions& out);
    [[nodiscard]] bool HasRoomForControls() const noexcept;
    void CallNextControl(ServerActions& out);
    void FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out);
    void FinishMonitor(const ApiResponse& response, Core::Now now, ServerActions& out);
    void Tick(Core::Now now, ServerActions& out);
    void ReportMonitorFailure();
    void CheckWatchdog(Core::Now now, ServerActions& out);
    void EndForTimeout(Core::Now now, ServerActions& out);
    void ArmWatchdog(ServerActions& out);
    /// Whether a deadline for HANDSHAKE applies.
    [[nodiscard]] bool IsHandshakeDue() const noexcept;
    [[nodiscard]] Core::SteadyTime GetWatchdogDeadline() const;
    void AppendError(EOpenStreamErrorCode code, std::string_view message);
    void BeginClosing(EServerCloseReason reason, Core::Now now, ServerActions& out);
    void Close(ServerActions& out);
    void Flush(ServerActions& out);
};

} // namespace ACS::OpenStream
