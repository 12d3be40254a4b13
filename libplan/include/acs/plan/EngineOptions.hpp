#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Location.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/RobotID.hpp>
#include <acs/plan/ERobotType.hpp>
#include <acs/plan/SiteMap.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// What the `from` or the `to` of a job must be.
enum class EPlaceRule : std::uint8_t
{
    None,          ///< Not used; a given value is ignored.
    FixedCassette, ///< A cassette port of the site.
    FixedTray,     ///< A tray port of the site.
    RobotCassette, ///< A cassette port of the robot.
    RobotTray,     ///< A tray port of the robot.
    Memory,        ///< A memory port, of the site or in a tray on the robot.
};

/// How a finished job changes the record of the robot's ports.
enum class EActionEffect : std::uint8_t
{
    None,   ///< The record stays as it is.
    Load,   ///< The port in `to` has the carrier.
    Unload, ///< The port in `from` is empty.
    Move,   ///< Both, as far as `from` and `to` are carrier ports of the robot.
};

/// One action of the MCS (sections 6.3 and 6.4 of MCS-ACS).
struct ActionRule
{
    ERobotType robotType = ERobotType::LR;
    EPlaceRule from = EPlaceRule::None;
    EPlaceRule to = EPlaceRule::None;
    EActionEffect effect = EActionEffect::None;
    bool bJobsRequired = false;           ///< Whether a step without jobs is rejected.
    std::chrono::milliseconds timeout{0}; ///< Maximum duration of a job, then it has failed; 0: no limit.

    bool operator==(const ActionRule&) const = default;
};

/// The actions of a site, by the name that a step has (Step::action).
using ActionTable = std::map<std::string, ActionRule, std::less<>>;

/// The eight actions of sections 6.3 and 6.4 of MCS-ACS.
[[nodiscard]] ACS_API ActionTable MakeStandardActions();

/// Actions that a robot cannot execute, each with the reason that is reported to the MCS (FindRejectedActions).
using RejectedActions = std::map<std::string, std::string, std::less<>>;

/// The configuration of one robot.
struct RobotOptions
{
    Core::RobotID robotID;            ///< Its name at the MCS; unique in the site.
    ERobotType type = ERobotType::LR; ///< Only steps with actions of this type are given to it.
    std::string vehicleTypeID;        ///< Vehicle type of the map: selects the nodes and edges that the robot may use.
    std::optional<std::string> startNodeID; ///< Reserved for the robot until it reports its position.
    /// Preferred parking position: the robot drives there when it has no plan or blocks another robot. Not shared by robots.
    std::optional<std::string> homeStationID;
    std::vector<Core::Location> ports;      ///< Its carrier ports ("LR01.CP01"), in the order of carrierIds.
    std::vector<Core::Location> childPorts; ///< Places inside its carriers ("CR01.TP01.MP01").
    RejectedActions rejectedActions;        ///< Plans with one of these actions are not given to the robot.
    /// Where it charges (DispatchOptions). Not shared by robots; may be the home station. nullopt: its battery level is
    /// ignored.
    std::optional<std::string> chargingStationID = std::nullopt;
    /// A sentence about where the robot is expected to connect. Ends the alarm of a robot that has not connected since the
    /// start; may be empty.
    std::string connectionHint = {};
};

/// Until when CancelPlan ends a plan (register D-14).
enum class ECancelWindow : std::uint8_t
{
    Dispatch,     ///< Until a robot has the plan.
    FirstArrival, ///< Until the robot has reached the last node before the position of the first step.
    FirstJob,     ///< Until the first job is started.
};

/// How CancelPlan, AbortPlan, PausePlan and ResumePlan are executed (sections 6.5 to 6.8, register D-14 to D-22).
struct ControlOptions
{
    ECancelWindow cancelUntil = ECancelWindow::FirstArrival;
    std::chrono::milliseconds cancelTimeout{30'000}; ///< Maximum time for a robot to confirm the end of its drive.
    std::chrono::milliseconds pauseTimeout{30'000}; ///< Maximum time for a robot to confirm that it stopped or resumed.
    /// Maximum time for a robot to report the end of a cancelled job; then the job is unresolved (ACS-1008).
    std::chrono::milliseconds jobEndTimeout{60'000};
    bool bPausesAfterJob = false;         ///< A running job finishes before the pause. A drive is always interrupted.
    bool bAbortStopsJob = false;          ///< Abort cancels a running job (D-15).
    bool bAbortFinishesPausedJob = false; ///< Abort resumes a paused job and waits for its end (D-16).
    bool bJobFailureFailsAbort = true;    ///< A job that fails during an abort fails the plan (D-17).
    bool bAbortReportsStep = false;       ///< Report a step that ends with the last job of an aborted plan (D-18).
    bool bResultAfterRefusal = true;      ///< A control of an unknown plan has a result report too (D-19).

    bool operator==(const ControlOptions&) const = default;
};

/// The value of RobotStatus::position while a robot drives (section 6.16).
enum class EMovingPosition : std::uint8_t
{
    Last,   ///< The last station at which it was docked.
    Target, ///< The station to which it drives; the last one if the target is not a station.
    None,   ///< Empty.
};

/// How plans are assigned to robots, and when robots charge.
struct DispatchOptions
{
    double batteryFloor = 20; ///< Percent. A robot below it is given no plan and drives to its charging station.
    /// Percent. A robot that was below batteryFloor is given no plan and stays at its charging station until it has this level.
    double batteryResume = 80;
    std::chrono::milliseconds chargeRetry{10'000}; ///< Maximum time to show bCharging before StartCharging is repeated.
    /// Start a load into a port that has a carrier according to the record, and accept a plan that loads a port twice.
    bool bLoadsIntoTakenPorts = false;

    bool operator==(const DispatchOptions&) const = default;
};

/// The configuration of the engine.
struct EngineOptions
{
    std::vector<RobotOptions> robots;            ///< Their robotIDs differ.
    ActionTable actions = MakeStandardActions(); ///< A plan with another action is rejected.
    std::vector<Core::Location> places; ///< Ports of stations ("A01.CP01.TP01"); the stations are those of the map.
    /// By station: the other stations at whose places a robot that is docked there can work too.
    std::map<std::string, std::vector<std::string>, std::less<>> reach;
    std::size_t maximumPlans = 100; ///< Maximum number of unfinished plans; further ones are rejected.
    /// Maximum number of unacknowledged reports. A plan is rejected while it, and the plans before it, could exceed eight tenths of
    /// it: each plan, step and job causes up to three reports. A tenth is left to alarms, a tenth to results of controls.
    std::size_t maximumReports = 100'000;
    std::int32_t defaultPriority = 0; ///< Priority of plans without one.
    bool bLowerPriorityFirst = false; ///< Lower values are more urgent.
    /// A waiting plan gains one priority level per this duration. 0: a higher priority always comes first.
    std::chrono::milliseconds queueAgeing{600'000};
    /// A plan begins before one that was accepted at most this long before it, if the free robot is nearer to its first station. At most
    /// 16 plans are compared with the first one. All plans up to it have the same priority, none uses one of its stations, and no other
    /// free robot is nearer to it. 0: never.
    std::chrono::milliseconds queueOvertaking{0};
    bool bFinishedIDsReused = false;      ///< Accept the planID of a finished plan again; deletes the finished plan.
    bool bInitialPendingReported = false; ///< Send PlanReport(Pending) for each accepted plan (D-24).
    bool bTscStartsPaused = false;        ///< The TSC is Paused after every start.
    bool bTscPausedAcceptsPlans = true;   ///< Accept plans while the TSC is not Auto; false rejects them.
    std::size_t baseLength = 3;           ///< Number of nodes released ahead of a robot; at least 1.
    /// Metres. Nodes of a map at this distance or less exclude each other, because two vehicles would not have room.
    double clearance = 0;
    ControlOptions controls;                                ///< How controls of plans are executed.
    DispatchOptions dispatch;                               ///< How plans are assigned, and charging.
    EMovingPosition movingPosition = EMovingPosition::Last; ///< What a driving robot reports as its position.
    std::chrono::milliseconds extensionDelay{2'000};        ///< Delay after which an unconfirmed drive is extended.
    /// Time after which a connected robot that is not paused by a control raises ACS-1009: with released nodes ahead and none
    /// passed (at least three times the travel time of its next edge), or with a job not begun. 0 disables the alarm.
    std::chrono::milliseconds stallTimeout{60'000};
    /// Time for which a robot with a plan waits for a block, a tray, or robots none of which makes progress, after which
    /// ACS-1015 is raised. 0 disables the alarm.
    std::chrono::milliseconds waitTimeout{300'000};
    /// Number of drives to steps and jobs that a robot rejects in a row before it is unavailable (ACS-1012); at least 1.
    std::size_t maximumRejections = 3;
    std::chrono::milliseconds rejectionRetry{2'000}; ///< Delay before a rejected drive or job is commanded again.
    /// Delay before a robot that rejected the drive to its parking position is sent again; doubled each time, up to 64 times
    /// this value.
    std::chrono::milliseconds homeRetry{5'000};
    /// Maximum time to wait, after a restart, until every robot has reported its position and the nodes it may still enter.
    /// No drive is started before.
    std::chrono::milliseconds restartWait{30'000};
    std::chrono::milliseconds storeRetry{1'000};      ///< Delay before a failed batch is stored again.
    std::chrono::milliseconds acknowledgedDelay{200}; ///< Acknowledgements of this period are stored in one batch.
    /// Bytes of a log of the store that cannot be merged, and of space left on its file system, beyond which ACS-1021 is raised.
    std::uint64_t maximumLogBytes = 64ULL * 1024 * 1024;
    std::size_t finishedPlansKept = 1'000; ///< Finished plans in memory and in the store; their planIDs stay known.
    /// The codes of alarms at the MCS, by errorCode; an alarm that is not listed has its errorCode there. An alarm keeps its
    /// Alarm::mcsCode until it is cleared, also over a restart with other codes. nullopt: alarms have no mcsCode.
    std::optional<std::map<std::string, std::string, std::less<>>> mcsCodes;
};

/// All errors of the options, each with a path ("robots.LR01.home"); empty if the options are valid. PlanEngine requires
/// valid options.
[[nodiscard]] ACS_API std::vector<Core::Error> FindErrors(const EngineOptions& options, const SiteMap& site);

} // namespace ACS::Planning
