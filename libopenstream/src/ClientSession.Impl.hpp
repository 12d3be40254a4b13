#pragma once

#include "ClientControls.hpp"
#include "ClientMonitor.hpp"
#include "ClientOutput.hpp"
#include "LazyTimer.hpp"
#include "LineFramer.hpp"
#include <acs/core/Backoff.hpp>
#include <acs/openstream/ClientSession.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

class ClientSession::Impl
{
    ClientSessionOptions _options;
    Core::IRandom& _random;
    Core::Backoff _backoff;
    OpenStreamCodec _codec;
    LineFramer _framer;
    ClientSessionStats _stats;
    EClientState _state = EClientState::Stopped;

    ClientOutput _output;
    ClientMonitor _monitor;
    ClientControls _controls;
    LazyTimer _controlTimer;
    std::uint64_t _stops = 0;              ///< STOP controls without an answer.
    std::uint64_t _stopsBeforeMonitor = 0; ///< Those of them that were sent before the STOP monitor in flight.
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
    void HandleStopError(ErrorLine& error, ClientActions& out);
    void CountStopAnswer() noexcept;
    void RefuseControl(int status, std::optional<Core::JsonText> bodyOrNull, std::string detail, ClientActions& out);
    void SendNext(Core::Now now, ClientActions& out);
    void SendAwaited(const OpenStreamRequest& request, Core::Now now, ClientActions& out);
    void SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out);
    [[nodiscard]] Core::SteadyTime GetControlDeadline(std::chrono::milliseconds own, Core::Now now) const;
    /// When the first of the CONTROLs that have been given to the socket has to have left.
    [[nodiscard]] Core::SteadyTime GetSendDeadline() const noexcept;
    void CheckControls(Core::Now now, ClientActions& out);
    void ArmControlTimer(ClientActions& out);
    [[nodiscard]] bool IsConnected() const noexcept;
    void OnAnswerTimeout(Core::Now now, ClientActions& out);
    void HandleLoss(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void Disconnect(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out);
    void DropConnection(std::string_view detail, ClientActions& out);
    void End(ClientActions& out);
};

} // namespace ACS::OpenStream
