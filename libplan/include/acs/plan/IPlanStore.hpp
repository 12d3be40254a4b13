#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>

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
    PlanRecord record;

    bool operator==(const PlanAdded&) const = default;
};

/// The states of a plan changed; the plan itself never does.
struct PlanProgressed
{
    std::string planID;
    PlanProgress progress;

    bool operator==(const PlanProgressed&) const = default;
};

/// A finished plan is forgotten.
struct PlanRemoved
{
    std::uint64_t sequence = 0; ///< PlanRecord::sequence.

    bool operator==(const PlanRemoved&) const = default;
};

/// A report waits for its acknowledgement.
struct ReportAdded
{
    OutboxEntry entry;

    bool operator==(const ReportAdded&) const = default;
};

/// A report was acknowledged.
struct ReportRemoved
{
    std::uint64_t sequence = 0;

    bool operator==(const ReportRemoved&) const = default;
};

/// What a robot has on its ports.
struct CarriersChanged
{
    std::string robotID;
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port.

    bool operator==(const CarriersChanged&) const = default;
};

/// What a robot was told last, stored before it is told: by this its work is known again after a restart.
struct RobotWorkChanged
{
    std::string robotID;
    std::string commandID; ///< Of its last Drive or StartJob; empty: none yet.
    /// Of those before, the latest first, so many as tell an old order of the robot from a stranger's.
    std::vector<std::string> earlierIDs;
    std::optional<StartJob> job; ///< Commanded, and its end not told.
    std::string progressToken;   ///< RestartEvidence::progressToken, when all this was written down.
    bool bPauseAsked = false;    ///< It was told to pause, and has not shown since that it goes on.
    bool bUnresolved = false;    ///< It may have done jobs of its plan that could not be written down.
    /// Where it may be: while it drives what was left of its way when this was written down, else where it stands.
    std::vector<std::string> nodeIDs;
    bool bCommandTaken = false; ///< It has shown that it had one of these commands: showing none, it was switched off.
    std::int32_t jobNumber = 0; ///< StartJob::jobNumber of its last job; 0: none yet.

    bool operator==(const RobotWorkChanged&) const = default;
};

struct AlarmSet
{
    Alarm alarm;

    bool operator==(const AlarmSet&) const = default;
};

struct AlarmCleared
{
    Alarm alarm; ///< Its identity counts (Alarm::IsSameAs).

    bool operator==(const AlarmCleared&) const = default;
};

struct TscChanged
{
    ETscState state = ETscState::Auto;

    bool operator==(const TscChanged&) const = default;
};

/// A robot was taken out of service, or given back.
struct MaintenanceChanged
{
    std::string robotID;
    bool bOn = false;

    bool operator==(const MaintenanceChanged&) const = default;
};

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
    MaintenanceChanged>;

/// Changes that are stored together or not at all.
struct StoreBatch
{
    std::vector<StoreChange> changes;

    bool operator==(const StoreBatch&) const = default;
};

/// Everything that a store holds.
struct StoredState
{
    std::vector<PlanRecord> plans;        ///< By ascending sequence; finished ones too.
    std::vector<OutboxEntry> outbox;      ///< By ascending sequence.
    std::uint64_t lastReportSequence = 0; ///< The highest ever given, acknowledged reports included.
    std::vector<CarriersChanged> carriers;
    std::vector<Alarm> alarms;
    std::vector<std::string> robotsInMaintenance;
    ETscState tscState = ETscState::Auto; ///< Auto where none was ever stored.
    std::vector<RobotWorkChanged> robotWorks;

    bool operator==(const StoredState&) const = default;
};

/// Where plans survive. Used by one thread; a call returns when the work is done.
class IPlanStore
{
public:
    IPlanStore() = default;
    IPlanStore(const IPlanStore&) = delete;
    IPlanStore& operator=(const IPlanStore&) = delete;
    virtual ~IPlanStore() = default;

    /// Everything stored. Errors: EPlanningError::StoreCorrupt, StoreFailed.
    [[nodiscard]] virtual Core::Result<StoredState> Load() = 0;

    /// All changes as one transaction, on disk on return; on error none of them. Errors: EPlanningError::StoreFailed.
    [[nodiscard]] virtual Core::Result<void> Append(const StoreBatch& batch) = 0;

    /// Whether what is stored will be found by the next program that opens it, as far as can be told without writing; to be
    /// asked now and then. Errors: EPlanningError::StoreFailed (see PlanEngine::OnStoreLost).
    [[nodiscard]] virtual Core::Result<void> Check() = 0;
};

} // namespace ACS::Planning
