#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/Block.hpp>
#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/StoreLog.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// A plan was accepted.
struct PlanAdded
{
    PlanRecord record; ///< With the plan as received and its first progress.

    bool operator==(const PlanAdded&) const = default;
};

/// The progress of a plan changed; the plan itself is immutable.
struct PlanProgressed
{
    std::string planID;
    PlanProgress progress; ///< Replaces the former one.

    bool operator==(const PlanProgressed&) const = default;
};

/// A finished plan was deleted (EngineOptions::finishedPlansKept, bFinishedIDsReused).
struct PlanRemoved
{
    std::uint64_t sequence = 0; ///< PlanRecord::sequence.

    bool operator==(const PlanRemoved&) const = default;
};

/// A durable report was created and waits for its acknowledgement.
struct ReportAdded
{
    OutboxEntry entry; ///< Its sequence is higher than all before.

    bool operator==(const ReportAdded&) const = default;
};

/// A report was acknowledged.
struct ReportRemoved
{
    std::uint64_t sequence = 0; ///< OutboxEntry::sequence.

    bool operator==(const ReportRemoved&) const = default;
};

/// The record of a robot's ports changed.
struct CarriersChanged
{
    std::string robotID;
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port: RobotOptions::ports, then removed ones.
    /// The names of these ports, by which a restart finds them if RobotOptions::ports has changed. Empty in a record of a
    /// version without names: the order counts.
    std::vector<std::string> ports{};

    bool operator==(const CarriersChanged&) const = default;
};

/// The commands of a robot, stored before they are sent. After a restart the engine compares them with RestartEvidence.
struct RobotWorkChanged
{
    std::string robotID;
    std::string commandID; ///< ID of the last Drive or StartJob; empty: none yet.
    /// IDs of the commands before, latest first, limited in number: they show that an order is one of this ACS.
    std::vector<std::string> earlierIDs;
    std::optional<StartJob> job; ///< The commanded job whose end was not reported.
    std::string progressToken;   ///< RestartEvidence::progressToken when this was stored.
    bool bPauseAsked = false;    ///< Pause was sent and the robot has not shown since that it resumed.
    bool bUnresolved = false;    ///< The robot may have executed jobs of its plan while the store failed.
    /// Nodes where the robot may be: the rest of its route if it was driving when this was stored, else its node.
    std::vector<std::string> nodeIDs;
    /// The robot has shown that it received one of these commands. If it shows none later, it was switched off.
    bool bCommandTaken = false;
    std::int32_t jobNumber = 0; ///< StartJob::jobNumber of the last job; 0: none yet.
    /// The last job if an operator has abandoned it and the robot may still have it: to be cancelled when the robot is back.
    std::string abandonedJobID;
    /// A job that an operator has resolved, and whose program an arm may still run: the robot is asked for its outcome after a
    /// restart.
    std::optional<StartJob> resolvedJob;

    bool operator==(const RobotWorkChanged&) const = default;
};

/// An alarm was set or its content changed; it replaces one that is the same (Alarm::IsSameAs).
struct AlarmSet
{
    Alarm alarm; ///< As it is reported.

    bool operator==(const AlarmSet&) const = default;
};

/// An alarm was cleared.
struct AlarmCleared
{
    Alarm alarm; ///< Identifies the alarm (Alarm::IsSameAs).

    bool operator==(const AlarmCleared&) const = default;
};

/// The TSC has changed.
struct TscChanged
{
    ETscState state = ETscState::Auto; ///< To be in StoredState::tscState.

    bool operator==(const TscChanged&) const = default;
};

/// Maintenance of a robot was switched on or off (SetMaintenance).
struct MaintenanceChanged
{
    std::string robotID;
    bool bOn = false; ///< The robot is in maintenance.

    bool operator==(const MaintenanceChanged&) const = default;
};

/// A node, an edge or a station was blocked.
struct BlockAdded
{
    Block block; ///< No other one has its kind and id.

    bool operator==(const BlockAdded&) const = default;
};

/// A block was removed.
struct BlockRemoved
{
    EBlockKind kind = EBlockKind::Node; ///< Of the block.
    std::string id;                     ///< Of the block.

    bool operator==(const BlockRemoved&) const = default;
};

/// A command of an operator was accepted. Drops the receipts beyond the limits of CommandReceipt.
struct ReceiptAdded
{
    CommandReceipt receipt; ///< The newest.

    bool operator==(const ReceiptAdded&) const = default;
};

/// One change of what a store has. StoredState is the result of all changes.
using StoreChange = std::variant<
    PlanAdded,
    PlanProgressed,
    PlanRemoved,
    ReportAdded,
    ReportRemoved,
    CarriersChanged,
    AlarmSet,
    AlarmCleared,
    TscChanged,
    RobotWorkChanged,
    MaintenanceChanged,
    BlockAdded,
    BlockRemoved,
    ReceiptAdded>;

/// Changes that are stored as one transaction.
struct StoreBatch
{
    std::vector<StoreChange> changes; ///< In order; a later one may concern the same plan, robot or alarm.

    bool operator==(const StoreBatch&) const = default;
};

/// The content of a store.
struct StoredState
{
    std::vector<PlanRecord> plans;                ///< By ascending sequence, finished ones included.
    std::vector<OutboxEntry> outbox;              ///< By ascending sequence.
    std::uint64_t lastReportSequence = 0;         ///< The highest ever assigned, acknowledged reports included.
    std::vector<CarriersChanged> carriers;        ///< The last one of each robot.
    std::vector<Alarm> alarms;                    ///< Those that are set.
    std::vector<std::string> robotsInMaintenance; ///< Their robotIDs.
    std::optional<ETscState> tscState;            ///< The last one; nullopt if none was ever stored: Auto.
    /// Why the content may be out of date, for example a restored backup; empty: it is not. The engine then starts with the TSC
    /// Paused and commands no robot to move or work until the operator resumes it. TscChanged to Auto clears the reason.
    std::string holdReason;
    std::vector<RobotWorkChanged> robotWorks; ///< The last one of each robot.
    std::vector<Block> blocks;                ///< In the order in which they were added.
    std::vector<CommandReceipt> receipts;     ///< The oldest first.

    bool operator==(const StoredState&) const = default;
};

/// Persistent storage of the engine's state. Used by one thread; calls block until the data is read or written.
class ACS_API IPlanStore
{
public:
    IPlanStore() = default;
    IPlanStore(const IPlanStore&) = delete;
    IPlanStore& operator=(const IPlanStore&) = delete;
    virtual ~IPlanStore() = default;

    /// Reads the whole content. Errors: EPlanningError::StoreCorrupt, StoreFailed.
    [[nodiscard]] virtual Core::Result<StoredState> Load() = 0;

    /// Stores all changes as one transaction, durable on return. Errors: EPlanningError::StoreFailed, StoreTaken as of Check: none
    /// is stored; StoreOutcomeUnknown: the next Load in another process may find them, unless a later Append succeeds.
    [[nodiscard]] virtual Core::Result<void> Append(const StoreBatch& batch) = 0;

    /// Checks, without writing, that the stored data can still be found by the next process that opens the store, for example
    /// that its files were not removed. Call it periodically and pass a failure to PlanEngine::OnStoreLost. Errors:
    /// EPlanningError::StoreFailed; StoreTaken if another program uses the place of the store: end the program.
    [[nodiscard]] virtual Core::Result<void> Check() = 0;

    /// Measures the log of the store; merges it first if it is large. Call it periodically and pass the result to
    /// PlanEngine::OnStoreLog.
    [[nodiscard]] virtual StoreLog CheckLog() = 0;
};

} // namespace ACS::Planning
