#pragma once

#include "LazyTimer.hpp"
#include "LineFramer.hpp"
#include "LineOutbox.hpp"
#include "ServerControls.hpp"
#include "ServerMonitor.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::OpenStream
{

class ServerSession::Impl
{
    /// Whether the session reads, and what it waits for otherwise.
    enum class EReading : std::uint8_t
    {
        Open,
        Blocked,    ///< Paused until there is room for CONTROLs.
        Continuing, ///< Paused until OnContinue.
    };

    ServerSessionOptions _options;
    OpenStreamCodec _codec;
    LineFramer _framer;
    LineOutbox _outbox;
    ServerSessionStats _stats;
    EServerState _state = EServerState::Connected;
    EReading _reading = EReading::Open;
    EServerCloseReason _closeReason = EServerCloseReason::PeerClosed;
    bool _bPeerClosed = false;
    bool _bSendShutDown = false;

    ServerMonitor _monitor;
    ServerControls _controls;
    std::uint64_t _lastToken = 0; ///< Of the calls of both.

    Core::SteadyTime _connectedAt;
    Core::SteadyTime _lastCommandAt;
    LazyTimer _watchdog;

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
    [[nodiscard]] bool HasControl() const noexcept;
    [[nodiscard]] const ServerSessionStats& GetStats() const noexcept;

private:
    void ProcessLines(Core::Now now, ServerActions& out);
    [[nodiscard]] bool TryDrainInput(Core::Now now, ServerActions& out);
    void ProcessLine(std::string_view line, Core::Now now, ServerActions& out);
    [[nodiscard]] std::optional<EOpenStreamErrorCode> GetGateErrorOrNull(EOpenStreamCommand command) const;
    void Handle(const HandshakeRequest& request, Core::Now now, ServerActions& out);
    void Handle(const MonitorRequest& request, Core::Now now, ServerActions& out);
    void Handle(const ControlRequest& request, Core::Now now, ServerActions& out);
    void Handle(const StopRequest& request, Core::Now now, ServerActions& out);
    void StopMonitor(ServerActions& out);
    void FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out);
    void FinishMonitor(const ApiResponse& response, Core::Now now);
    void Tick(Core::Now now, ServerActions& out);
    void Apply(const ServerMonitor::Outcome& outcome);
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
