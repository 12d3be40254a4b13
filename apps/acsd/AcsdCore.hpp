#pragma once

#include "AcsdTimer.hpp"
#include "config/AcsdConfig.hpp"
#include "IAcsdOutput.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/McsGateway.hpp"
#include "mcs/RefusedReports.hpp"
#include "operator/OfferedCommands.hpp"
#include "replay/ICoreRecorder.hpp"
#include "store/StoreWatch.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/EngineInput.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/PlanEngineHost.hpp>
#include <acs/plan/StoreLog.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// acsd without its I/O: the engine and its host, the gateway to the MCS, the monitor of the store, the reported ability to
/// work, and the drain at a stop. Pure: Acsd surrounds it with sockets, disk and clock, plan_simulation with simulated ones.
/// Not shared between threads.
class AcsdCore final
{
public:
    using ActionHandler = std::function<void(const Planning::EngineAction& action)>;
    /// Receives each action of the engine, in order, and passes those to be executed to the handler.
    using ActionFilter = std::function<void(const Planning::EngineAction& action, const ActionHandler& execute)>;

    /// All references must outlive the core.
    struct Dependencies
    {
        const Core::IClock& clock;
        Core::IRandom& random;
        Core::Logger logger;
        IAcsdOutput& output;
        IMcsOutput& mcs;
        ActionFilter filter{}; ///< Faults of a simulation; empty: all actions are executed.
        ICoreRecorder* recorderOrNull = nullptr;
    };

    /// For closing the links at a stop.
    static constexpr std::chrono::milliseconds STOP_LIMIT{5'000};
    /// The engine collects acknowledgements and stores them together: a stop waits for that.
    static constexpr std::chrono::milliseconds SETTLE_TIME{300};

private:
    enum class EPhase : std::uint8_t
    {
        Running,
        Draining, ///< No new plans; waits for the Acks of all reports.
        Settling, ///< All reports are acknowledged, or no MCS is registered.
        Closing,  ///< No inputs; waits for the transaction under way.
        Leaving,  ///< The links are being closed.
        Stopped
    };

    Dependencies _dependencies;
    OperationsConfig _operations;
    Planning::PlanEngine _engine;
    Planning::PlanEngineHost _host;
    McsGateway _gateway;
    OfferedCommands _offers;
    StoreWatch _storeWatch;
    std::set<std::string> _reachable; ///< Robots that are not Disconnected.
    EPhase _phase = EPhase::Running;
    bool _bBrokerNeeded; ///< By every robot.
    bool _bMqttUp = false;
    bool _bWorking = false; ///< Work can be accepted at this moment.

public:
    /// The configuration must be without errors.
    AcsdCore(Dependencies dependencies, const AcsdConfig& config);
    AcsdCore(const AcsdCore&) = delete;
    AcsdCore& operator=(const AcsdCore&) = delete;
    ~AcsdCore() = default;

    /// The observers must outlive the core. They are called in the order in which they were added.
    void AddObserver(Planning::IPlanObserver& observer);

    /// Call once, before anything else, with what the store held.
    void Restore(Planning::StoredState state);

    /// Call once, after Restore and before the session with the MCS starts.
    void Start();

    /// Applies the keys that may change while acsd runs.
    void Reload(const AcsdConfig& config);

    /// Refuses plans and controls, waits until the MCS has acknowledged all reports (at most `shutdown.drain_timeout`), then
    /// has the links closed. Ends with IAcsdOutput::OnStopped.
    void Stop();

    /// Ends a stop without waiting for Acks: rejects commands and drops all other inputs from now on, completes the
    /// transaction under way and has the links closed.
    void Close();

    void OnSessionEvent(const Protocol::SessionEvent& event);
    void OnRobotEvent(const std::string& robotID, const Planning::RobotEvent& event);
    void OnTimer(const AcsdTimer& timer);
    void OnMqttUp();
    void OnMqttDown();
    void OnStored(const Core::Result<void>& result);
    void OnStoreLost(const Core::Error& error);
    void OnStoreLog(const Planning::StoreLog& log);
    void OnLinksClosed();

    /// A command of the operator or of a test. Unless Accepted, nothing is done. Closed from Stop on. An accepted command that
    /// the engine refuses is passed to IAcsdOutput::OnOperatorRefused, from within or later.
    [[nodiscard]] Planning::EInputAdmission Offer(
        Planning::PlanCommand command,
        std::optional<Planning::CommandReceipt> receiptOrNull = std::nullopt);

    [[nodiscard]] const Planning::PlanEngine& GetEngine() const noexcept;
    [[nodiscard]] const RefusedReports& GetRefusedReports() const noexcept;
    /// isConnected, as it was last published to the MCS; nullopt before the first time.
    [[nodiscard]] std::optional<bool> GetPublishedConnectedOrNull() const noexcept;
    [[nodiscard]] bool IsMqttUp() const noexcept;
    /// No further plans and commands of the operator are accepted.
    [[nodiscard]] bool IsStopping() const noexcept;
    /// Inputs have no effect any more.
    [[nodiscard]] bool IsClosed() const noexcept;
    [[nodiscard]] std::optional<std::string> GetStoreFaultOrNull() const;
    /// Reasons besides the links why no plan can be accepted.
    [[nodiscard]] std::vector<std::string> GetNotReadyReasons() const;

private:
    void DoClose();
    void Store(const Planning::StoreBatch& batch);
    void Execute(const Planning::EngineAction& action);
    void OnReply(const Planning::ReplyCommand& reply);
    void OnStatusChanged(const Planning::RobotStatus& status);
    void OnOwnTimer(EAcsdTimer timer);
    [[nodiscard]] bool TryEndForTakenStore(const Core::Result<void>& result);
    void UpdateWorking();
    void StartStatusTimer();
    void RepeatStatuses();
    void CheckStore();
    void UpdateDrain();
    void CloseLinks();
    void FinishStop();
};

} // namespace ACS::Acsd
