#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Simulation
{

/// A defect that is built in around the engine, to check that the simulation finds it.
enum class EMutation : std::uint8_t
{
    None,
    StoreConfirmsEarly,
    StoreHidesFailure,
    StoreDeniesCommit,
    OutboxForgets,
    RestoreDropsPlan,
    ReplayForgotten,
    FinalReportTwice,
    PlanReportSwallowed,
    ReportsSwapped,
    ReportNotStored,
    ResultTwice,
    ResultSwallowed,
    ResultInverted,
    AckForgotten,
    JobStartedTwice,
    JobFinishedEarly,
    NodePassedEarly,
    StationaryTooEarly,
    ResumeSwallowed,
    RefusalAcked,
    LostDriveFailsPlan,
    TimerForgotten,
    RecoveryDenied,
    MaintenanceForgotten,
    InputsOfAnotherJob,
    PortOffByOne,
    WrongPlace,
    StartRepeated,
    EchoIgnored,
    EpochNotChecked,
    LeaseEndIgnored,
};

struct MutationText
{
    std::string_view name;
    std::string_view meaning;
    bool bOfArms = false;  ///< Found only with arms, which most runs do not have.
    bool bOfLease = false; ///< Found only with a shared store, which most runs do not have.
};

inline constexpr std::size_t MUTATION_COUNT = 32;

/// By EMutation.
inline constexpr std::array<MutationText, MUTATION_COUNT> MUTATION_TEXTS{{
    {"none", "no defect"},
    {"store-confirms-early", "the store confirms a write before it is done"},
    {"store-hides-failure", "the store confirms a write that failed"},
    {"store-denies-commit", "the store reports a commit that the next start may find as not stored"},
    {"outbox-forgets", "reports of plans are not stored"},
    {"restore-drops-plan", "one unfinished plan is not restored"},
    {"replay-forgotten", "after a registration no report is sent again"},
    {"final-report-twice", "a plan's last report is sent under a second transactionId"},
    {"plan-report-swallowed", "now and then a plan's last report is not sent and counts as acknowledged"},
    {"reports-swapped", "now and then a report is sent after the next one"},
    {"report-not-stored", "now and then a report is sent that is not stored"},
    {"result-twice", "the result of a control is sent twice"},
    {"result-swallowed", "the result of a control is not sent"},
    {"result-inverted", "a control that succeeded is reported as failed, and one that failed as successful"},
    {"ack-forgotten", "acknowledgements of reports do not reach the engine"},
    {"job-started-twice", "a job is sent to the robot again under another command"},
    {"job-finished-early", "a job counts as done when it begins"},
    {"node-passed-early", "a robot counts as past a node before it is"},
    {"stands-too-early",
     "a robot counts as stationary too early after the cancel of a drive, also of a drive from before a restart"},
    {"resume-swallowed", "the command to resume does not reach the robot"},
    {"refused-plan-acked", "a plan that was refused is acknowledged as accepted"},
    {"lost-drive-fails-plan", "a plan whose robot lost or rejected a drive is reported as failed at its end"},
    {"timer-forgotten", "now and then a timer of the engine does not fire"},
    {"recovery-denied", "after a restart each robot reports that it never had its job"},
    {"maintenance-forgotten", "after a restart all robots are in service"},
    {"inputs-of-another-job", "a job is sent with the places of the previous job of the same action"},
    {"port-off-by-one", "a job is sent with the next port of the robot, or the next memory place there"},
    {"wrong-place", "a job is sent with the fixed place next to the right one"},
    {"start-repeated", "the START of a program is sent again after a reconnect of the arm", true},
    {"echo-ignored", "the job numbers that programs echo are ignored: any program counts for the job", true},
    {"epoch-not-checked", "the store accepts transactions of a former leader", false, true},
    {"lease-end-ignored", "a leader continues when its lease has ended, until the store refuses it", false, true},
}};

} // namespace ACS::Simulation
