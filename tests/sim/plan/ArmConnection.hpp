#pragma once

#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace ACS::Simulation
{

/// The controller's side of one connection: runs its ServerSession as ServerConnection does, over the network.
class ArmConnection final
{
public:
    /// What it needs from its controller.
    struct Handlers
    {
        std::function<void(const OpenStream::ApiRequest& request, OpenStream::ApiResponse& response)> call;
        std::function<void()> stopControl;
        std::function<bool()> isOtherInControl; ///< Whether another connection controls the robot.
        std::function<void()> onEnded;          ///< Called once; it may be destroyed later.
    };

private:
    /// Which request the service answers. At most one of each kind is pending.
    enum class EAnswer : std::uint8_t
    {
        Sample,
        Control,
    };

    static constexpr std::size_t ANSWERS = 2;

    struct Answer
    {
        OpenStream::ApiResponse response;
        std::uint64_t token = 0;
    };

    Timeline& _timeline;
    TextNetwork& _network;
    Protocol::ConnectionID _id;
    Handlers _handlers;
    OpenStream::ServerSession _session;
    OpenStream::ServerActions _actions;
    std::array<Answer, ANSWERS> _answers; ///< By EAnswer.
    TimerBank<OpenStream::EServerTimer> _timers;
    TimerBank<EAnswer> _answerTimers;
    bool _bEnded = false;

public:
    ArmConnection(Timeline& timeline, TextNetwork& network, Protocol::ConnectionID id, Handlers handlers);
    ArmConnection(const ArmConnection&) = delete;
    ArmConnection& operator=(const ArmConnection&) = delete;
    ~ArmConnection() = default;

    void Start();
    void OnText(const std::string& text);
    void OnPeerClosed();
    /// Closes without a message; the handler is not called.
    void Drop();
    [[nodiscard]] bool IsEnded() const noexcept;
    /// ServerSession::HasControl.
    [[nodiscard]] bool HasControl() const noexcept;

private:
    template <typename TCall>
    void Call(TCall call);
    void Do(const OpenStream::ServerSend& action);
    void Do(const OpenStream::ServerCall& action);
    void Do(const OpenStream::ServerStopControl& action) const;
    void Do(const OpenStream::ServerStartTimer& action);
    void Do(const OpenStream::ServerCancelTimer& action);
    void Do(const OpenStream::ServerPauseReading& action);
    void Do(const OpenStream::ServerResumeReading& action);
    void Do(const OpenStream::ServerContinue& action);
    void Do(const OpenStream::ServerShutdownSend& action);
    void Do(const OpenStream::ServerClose& action);
    void End();
};

} // namespace ACS::Simulation
