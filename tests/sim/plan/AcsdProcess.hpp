#pragma once

#include "ChanceModel.hpp"
#include "CrashableStore.hpp"
#include "EMutation.hpp"
#include "IRobotConnection.hpp"
#include "ISimulatedRobot.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/McsGateway.hpp"
#include "Mutator.hpp"
#include "Scenario.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/PlanEngineHost.hpp>
#include <acs/protocol/AcsSession.hpp>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// acsd from one start to its crash: the engine, its loop, the gateway to the MCS, the session and the robots' adapters,
/// connected as Acsd connects them, with the world's disk, network and radios in place of the system's.
class AcsdProcess final : private Acsd::IMcsOutput, private ITextPeer
{
public:
    /// What it lives in; everything outlives it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        ChanceModel& dice;      ///< For latencies and crashes.
        ChanceModel& ownRandom; ///< acsd's source of ids.
        CrashableStore& store;
        TextNetwork& network;
        std::map<std::string, std::unique_ptr<ISimulatedRobot>>& robots;
        WorkChecker& witness;
        const Scenario& scenario;
        EMutation mutation = EMutation::None;
        std::uint64_t number = 0; ///< Of this start.
    };

    /// Called once, at its end, from within whatever it was doing: it does nothing any more.
    using CrashHandler = std::function<void()>;
    /// Called after each batch that reached the disk.
    using CommitHandler = std::function<void()>;

private:
    Dependencies _around;
    CrashHandler _onCrash;
    CommitHandler _onCommit;
    bool _bDead = false;
    bool _bCrashing; ///< By chance; ends with the faults.

    Planning::PlanEngine _engine;
    Planning::PlanEngineHost _host;
    Protocol::AcsSession _session;
    Acsd::McsGateway _gateway;
    std::map<std::string, std::unique_ptr<IRobotConnection>> _hands;

    TimerBank<Planning::EngineTimer> _engineTimers;
    TimerBank<Protocol::ESessionTimer> _sessionTimers;
    std::deque<Protocol::SessionAction> _sessionActions;
    bool _bActing = false;
    std::optional<Protocol::ConnectionID> _connection;
    Core::SteadyTime _lastDelivery{};
    std::optional<Planning::StoreBatch> _writing; ///< On its way to the disk.
    Mutator _mutator;

public:
    AcsdProcess(const Dependencies& around, CrashHandler onCrash, CommitHandler onCommit);
    AcsdProcess(const AcsdProcess&) = delete;
    AcsdProcess& operator=(const AcsdProcess&) = delete;
    ~AcsdProcess() override;

    /// Reads the disk and begins.
    void Begin();

    /// It ends at this moment, whatever it is doing.
    void Crash(std::string_view where);
    /// No crashes by chance from now on.
    void EndCrashes();

    void PushCommand(Planning::PlanCommand command);
    [[nodiscard]] const Planning::PlanEngine& GetEngine() const noexcept;

private:
    void Store(const Planning::StoreBatch& batch);
    void Commit();
    [[nodiscard]] bool TryCommit(const Planning::StoreBatch& batch);
    void Execute(const Planning::EngineAction& action);
    void CarryOut(const Planning::EngineAction& action);
    void Report(const Planning::OutboxEntry& entry);
    void CommandRobot(const Planning::CommandRobot& command);
    void TakeRobotEvent(const std::string& robotID, const Planning::RobotEvent& event);
    void CrashByChance(std::size_t permyriad, std::string_view where);

    template <typename TCall>
    void RunSession(TCall call);
    void Act(const Protocol::SessionAction& action);

    [[nodiscard]] bool IsRegistered() const override;
    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override;
    void ReplayDone() override;
    void SendStatus(const Protocol::AcsPayload& status) override;
    void SendPosition(const Protocol::RobotPositionUpdate& positions) override;
    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override;
    void SetSiteOffset(std::chrono::minutes offset) override;

    void OnOpened(Protocol::ConnectionID connection) override;
    void OnText(Protocol::ConnectionID connection, const std::string& text) override;
    void OnClosed(Protocol::ConnectionID connection, const std::string& reason) override;
};

} // namespace ACS::Simulation
