#pragma once

#include "ArmController.hpp"
#include "robots/RobotOutputs.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include <acs/openstream/ClientSession.hpp>
#include <acs/plan/RobotCommand.hpp>

#include <functional>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// Runs acsd's session with the controller of an arm as OpenStreamClient does, over the network of that controller.
class ArmClient final : private ITextPeer
{
public:
    using EventHandler = std::function<void(const OpenStream::ClientEvent& event)>;

private:
    Timeline& _timeline;
    ArmController& _controller;
    EventHandler _handler;
    OpenStream::ClientSession _session;
    OpenStream::ClientActions _actions;
    TimerBank<OpenStream::EClientTimer> _timers;
    std::optional<Protocol::ConnectionID> _connection;
    bool _bOpened = false;
    bool _bExecuting = false;
    std::string _toldSample;
    bool _bStartSent = false; ///< In this session or before it.
    std::string _commandID;   ///< Of the job that the adapter was commanded last.

public:
    ArmClient(
        Timeline& timeline,
        ArmController& controller,
        const OpenStream::ClientSessionOptions& options,
        EventHandler handler);
    ArmClient(const ArmClient&) = delete;
    ArmClient& operator=(const ArmClient&) = delete;
    /// A crash of acsd: no connection is closed properly.
    ~ArmClient() override;

    void Start();
    void Send(const Acsd::ArmRequest& request);

    /// Called before the adapter has the job: every program that is started from now on is for this job.
    void NoteCommand(const Planning::RobotCommand& command);

private:
    template <typename TCall>
    void Call(TCall call);
    void TraceEvent(const OpenStream::ClientEvent& event);
    /// The defect that is built in.
    void Mutate(const OpenStream::ClientEvent& event);
    void Do(const OpenStream::ClientEvent& event);
    void Do(const OpenStream::ClientConnect& action);
    void Do(const OpenStream::ClientSend& action);
    void Do(const OpenStream::ClientClose& action);
    void Do(const OpenStream::ClientStartTimer& action);
    void Do(const OpenStream::ClientCancelTimer& action);
    void OnOpened(Protocol::ConnectionID connection) override;
    void OnText(Protocol::ConnectionID connection, const std::string& text) override;
    void OnClosed(Protocol::ConnectionID connection, const std::string& reason) override;
};

} // namespace ACS::Simulation
