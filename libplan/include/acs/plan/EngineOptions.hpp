#pragma once

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

/// What the from or the to of a job must be.
enum class EPlaceRule : std::uint8_t
{
    None,          ///< Nothing; what is given is ignored.
    FixedCassette, ///< A cassette port of the site.
    FixedTray,     ///< A tray port of the site.
    RobotCassette, ///< A cassette port of the robot.
    RobotTray,     ///< A tray port of the robot.
    Memory,        ///< A memory port, of the site or in a tray on the robot.
};

/// What a finished job does to the robot's ports.
enum class EActionEffect : std::uint8_t
{
    None,
    Load,   ///< The port in to has the carrier.
    Unload, ///< The port in from is empty.
    Move,   ///< Both: whichever of from and to is a carrier port of the robot is emptied or has the carrier.
};

/// One action of the MCS (section 4.1 of MCS-ACS).
struct ActionRule
{
    ERobotType robotType = ERobotType::LR;
    EPlaceRule from = EPlaceRule::None;
    EPlaceRule to = EPlaceRule::None;
    EActionEffect effect = EActionEffect::None;
    bool bJobsRequired = false;           ///< Whether a step without jobs is refused.
    std::chrono::milliseconds timeout{0}; ///< A job that takes longer has failed; 0: no limit.

    bool operator==(const ActionRule&) const = default;
};

using ActionTable = std::map<std::string, ActionRule, std::less<>>;

/// The eight actions of the document with its rules.
[[nodiscard]] ActionTable MakeStandardActions();

/// Actions that a robot cannot do, each with the reason, which the MCS is told (FindRejectedActions).
using RejectedActions = std::map<std::string, std::string, std::less<>>;

struct RobotOptions
{
    Core::RobotID robotID;
    ERobotType type = ERobotType::LR;
    std::string vehicleTypeID;              ///< Of the map: which nodes and edges it may use.
    std::optional<std::string> startNodeID; ///< Held for it until it tells where it stands.
    std::optional<std::string>
        homeStationID;                      ///< Where it goes when it has no work or stands in the way; one robot each.
    std::vector<Core::Location> ports;      ///< Its carrier ports ("LR01.CP01"), in the order of carrierIds.
    std::vector<Core::Location> childPorts; ///< Places inside its carriers ("CR01.TP01.MP01").
    RejectedActions rejectedActions;        ///< Plans with one of them are not given to it.
    /// Where it charges (DispatchOptions); one robot each, but it may be its home. Absent: its battery is not looked at.
    std::optional<std::string> chargingStationID = std::nullopt;
};

/// Until when CancelPlan ends a plan (register D-14).
enum class ECancelWindow : std::uint8_t
{
    Dispatch,     ///< While no robot has it.
    FirstArrival, ///< Until its robot has come to the last node before its first place.
    FirstJob,     ///< Until its first job is begun.
};

/// How CancelPlan, AbortPlan, PausePlan and ResumePlan are carried out (sections 6.5 to 6.8, register D-14 to D-22).
struct ControlOptions
{
    ECancelWindow cancelUntil = ECancelWindow::FirstArrival;
    std::chrono::milliseconds cancelTimeout{30'000}; ///< For a robot to confirm that its drive is at an end.
    std::chrono::milliseconds pauseTimeout{30'000};  ///< For a robot to confirm that it stands, or goes on.
    /// For a robot to tell the end of a job that was given up; then an operator is asked for it (ACS-1008).
    std::chrono::milliseconds jobEndTimeout{60'000};
    bool bPausesAfterJob = false;         ///< A running job comes to its end before the pause; a drive never does.
    bool bAbortStopsJob = false;          ///< Abort drops a running job (D-15).
    bool bAbortFinishesPausedJob = false; ///< Abort has a paused job done first (D-16).
    bool bJobFailureFailsAbort = true;    ///< A job that fails during an abort fails the plan (D-17).
    bool bAbortReportsStep = false;       ///< A step that ends with the last job of an aborted plan is told (D-18).
    bool bResultAfterRefusal = true;      ///< Also of plans that nobody knows (D-19).

    bool operator==(const ControlOptions&) const = default;
};

/// What RobotStatus::position says while a robot drives (section 5.9).
enum class EMovingPosition : std::uint8_t
{
    Last,   ///< The last station where it stood.
    Target, ///< The station to which it drives; where that is none, the last.
    None,   ///< Nothing.
};

/// Which robot takes a plan, and what becomes of those that take none.
struct DispatchOptions
{
    double batteryFloor = 20;  ///< Percent; a robot with less takes no plan and drives to its charging station.
    double batteryResume = 80; ///< Percent; until it has that much it takes no plan then, nor leaves the station.
    std::chrono::milliseconds chargeRetry{10'000}; ///< For a robot to show that it charges; then it is told again.
    /// Whether a load into a port that has a carrier, as far as the engine knows, is begun all the same, and a plan is taken
    /// that loads one port twice.
    bool bLoadsIntoTakenPorts = false;

    bool operator==(const DispatchOptions&) const = default;
};

/// Everything that the engine is told at its start.
struct EngineOptions
{
    std::vector<RobotOptions> robots;
    ActionTable actions = MakeStandardActions();
    std::vector<Core::Location> places; ///< Ports inside stations ("A01.CP01.TP01"); stations are known from the map.
    /// By station: other stations whose places a robot that is docked at it can work at. Nothing else is within reach.
    std::map<std::string, std::vector<std::string>, std::less<>> reach;

    std::size_t maximumPlans = 100; ///< Plans that are not finished; one more is refused.
    std::size_t maximumReports =
        100'000; ///< That the MCS has not acknowledged; plans are refused while there are so many.
    std::int32_t defaultPriority = 0;
    bool bLowerPriorityFirst = false;
    /// Waiting so long is worth as much as a priority by one; 0: a plan of a lower priority waits for all of a higher one.
    std::chrono::milliseconds queueAgeing{600'000};
    bool bFinishedIDsReused = false; ///< A planID may come again once its plan is finished, which is forgotten then.
    bool bInitialPendingReported = false; ///< PlanReport(Pending) of each plan that was accepted (D-24).
    bool bTscStartsPaused = false;        ///< Every start begins with the TSC paused.
    bool bTscPausedAcceptsPlans = true;   ///< Plans that come while the TSC is not Auto wait; else they are refused.
    std::size_t baseLength = 3;           ///< Nodes that a robot is released ahead; at least 1.
    /// Metres. Nodes of one map at this distance or nearer exclude each other: a vehicle on one of them leaves no room for
    /// another one on the other.
    double clearance = 0;
    ControlOptions controls;
    DispatchOptions dispatch;
    EMovingPosition movingPosition = EMovingPosition::Last;
    std::chrono::milliseconds extensionDelay{2'000}; ///< A drive that is not confirmed is extended after this.
    /// A robot that has a drive, is in reach, may drive on and passes no node for so long raises ACS-1009; at least three
    /// times what the map says for the edge before it. 0: none does.
    std::chrono::milliseconds stallTimeout{60'000};
    /// Before the second attempt of a robot that refuses to drive home; then twice as long each time, up to 64 times that.
    std::chrono::milliseconds homeRetry{5'000};
    /// After a restart nobody sets out before every robot has told where it stands and may still drive, at most so long.
    std::chrono::milliseconds restartWait{30'000};
    std::chrono::milliseconds storeRetry{1'000};
    std::chrono::milliseconds acknowledgedDelay{200}; ///< Acknowledgements that are stored together.
    std::size_t finishedPlansKept = 1'000;            ///< In memory and in the store: history, and known planIDs.
};

/// Every mistake of the options at once, each with a path ("robots.LR01.home"); empty where there is none. The engine
/// takes only options without mistakes.
[[nodiscard]] std::vector<Core::Error> FindErrors(const EngineOptions& options, const SiteMap& site);

} // namespace ACS::Planning
