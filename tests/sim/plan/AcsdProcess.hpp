#pragma once

#include "AcsdCore.hpp"
#include "ChanceModel.hpp"
#include "config/AcsdConfig.hpp"
#include "CrashableStore.hpp"
#include "EMutation.hpp"
#include "IAcsdOutput.hpp"
#include "IRobotConnection.hpp"
#include "ISimulatedRobot.hpp"
#include "mcs/IMcsOutput.hpp"
#include "Mutator.hpp"
#include "ProcessStore.hpp"
#include "replay/CoreRecorder.hpp"
#include "Scenario.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"
#include <acs/plan/PlanEngine.hpp>
#include <acs/protocol/AcsSession.hpp>

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// acsd from one start to its crash: AcsdCore with a simulated disk, network and radios. All inputs and outputs of the
/// core pass the mutator.
class AcsdProcess final : private Acsd::IAcsdOutput, private Acsd::IMcsOutput, private ITextPeer, private IStoreOwner
{
public:
    /// All references must outlive it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        ChanceModel& chance;    ///< For latencies and crashes.
        ChanceModel& ownRandom; ///< acsd's source of ids.
        CrashableStore& store;
        TextNetwork& network;
        std::map<std::string, std::unique_ptr<ISimulatedRobot>>& robots;
        WorkChecker& workChecker;
        const Scenario& scenario;
        EMutation mutation = EMutation::None;
        std::uint64_t number = 0; ///< The number of this start.
        std::uint64_t epoch = 0;  ///< With which it has taken the lease of a shared store.
        /// Receives the inputs and outputs of the core; may be empty.
        Acsd::CoreRecorder::RecordHandler onRecord = {};
    };

    /// Called once at the crash, possibly from within a call of this class. Afterwards it does nothing.
    using CrashHandler = std::function<void()>;
    /// Called after each batch that is on the disk.
    using CommitHandler = std::function<void()>;

private:
    Dependencies _around;
    CrashHandler _onCrash;
    bool _bDead = false;
    bool _bCrashing; ///< Crashes at random; ends with the faults.

    std::optional<Acsd::CoreRecorder> _recorder;
    Acsd::AcsdCore _core;
    Protocol::AcsSession _session;
    std::map<std::string, std::unique_ptr<IRobotConnection>> _hands;

    TimerBank<Acsd::AcsdTimer> _timers;
    TimerBank<Protocol::ESessionTimer> _sessionTimers;
    std::deque<Protocol::SessionAction> _sessionActions;
    bool _bActing = false;
    std::optional<Protocol::ConnectionID> _connection;
    Core::SteadyTime _lastDelivery{};
    Mutator _mutator;
    ProcessStore _disk;

public:
    /// With the lease of a shared store, which is taken.
    AcsdProcess(
        const Dependencies& around,
        std::unique_ptr<SimulatedLease> leaseOrNull,
        CrashHandler onCrash,
        CommitHandler onCommit);
    AcsdProcess(const AcsdProcess&) = delete;
    AcsdProcess& operator=(const AcsdProcess&) = delete;
    ~AcsdProcess() override;

    /// The configuration of acsd.
    [[nodiscard]] static Acsd::AcsdConfig MakeConfig(const Scenario& scenario);

    /// Reads the disk and starts.
    void Begin();

    /// Ends it at this moment, whatever it is doing.
    void Crash(std::string_view where) override;
    /// No random crashes from now on.
    void EndCrashes();
    /// It loses its connection to the shared store, until it ends.
    void CutOff();
    /// It is stopped by an operator, and ends when it has released the lease of the shared store.
    void Stop();
    [[nodiscard]] std::uint64_t GetNumber() const noexcept;

    void PushCommand(Planning::PlanCommand command);
    [[nodiscard]] const Planning::PlanEngine& GetEngine() const noexcept;

private:
    [[nodiscard]] Acsd::AcsdCore::Dependencies MakeDependencies();
    void OnAction(const Planning::EngineAction& action, const Acsd::AcsdCore::ActionHandler& execute);
    void OnReport(const Planning::SendReport& report, const Acsd::AcsdCore::ActionHandler& execute);
    void OnRobotEvent(const std::string& robotID, const Planning::RobotEvent& event);
    /// An operator may ask at any time, and each plan that waits has its reason. What the functions read that they must not
    /// read, such as the value of an empty optional, is found by builds with sanitizers only.
    void CheckWaitReasons() const;
    void CrashByChance(std::size_t permyriad, std::string_view where);

    template <typename TCall>
    void RunSession(TCall call);
    void Act(const Protocol::SessionAction& action);
    void OnSessionEvent(const Protocol::SessionEvent& event);

    [[nodiscard]] bool HasCrashed(std::string_view where) override;
    void OnStored(const Core::Result<void>& result) override;

    void Store(const Planning::StoreBatch& batch) override;
    void CheckStore() override;
    void CommandRobot(const Planning::CommandRobot& command) override;
    void StartTimer(const Acsd::AcsdTimer& timer, Core::Duration delay) override;
    void CancelTimer(const Acsd::AcsdTimer& timer) override;
    void CancelTimers() override;
    void OnOperatorRefused(const Acsd::RefusedOffer& refused) override;
    void CloseLinks() override;
    void OnStopped() override;
    void OnStoreTaken(const std::string& reason) override;
    void ObserveCommit(Core::Duration duration) override;
    void ObserveAckWait(Core::Duration wait) override;

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
