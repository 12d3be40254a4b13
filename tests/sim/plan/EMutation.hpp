#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Simulation
{

/// A defect that is built in around the engine, to see that the simulation finds it.
enum class EMutation : std::uint8_t
{
    None,
    StoreConfirmsEarly,
    StoreHidesFailure,
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
    StandsTooEarly,
    ResumeSwallowed,
    RefusalAcked,
    TimerForgotten,
    RecoveryDenied,
    MaintenanceForgotten,
    InputsOfAnotherJob,
    PortOffByOne,
    WrongPlace,
    StartRepeated,
    EchoIgnored,
};

struct MutationText
{
    std::string_view name;
    std::string_view meaning;
    bool bOfArms = false; ///< Looked for in worlds with arms, of which there are few else.
};

inline constexpr std::size_t MUTATION_COUNT = 28;

/// By EMutation.
inline constexpr std::array<MutationText, MUTATION_COUNT> MUTATION_TEXTS{{
    {"none", "nothing is broken"},
    {"store-confirms-early", "the store says that it has stored before it has"},
    {"store-hides-failure", "the store says that it has stored where it failed"},
    {"outbox-forgets", "reports of plans are not stored"},
    {"restore-drops-plan", "one unfinished plan is not restored"},
    {"replay-forgotten", "after a registration no report is sent again"},
    {"final-report-twice", "a plan's last report is sent under a second transactionId"},
    {"plan-report-swallowed", "now and then a plan's last report is not sent and counts as acknowledged"},
    {"reports-swapped", "now and then a report leaves after the next one"},
    {"report-not-stored", "now and then a report is told that nobody stored"},
    {"result-twice", "the result of a control is told twice"},
    {"result-swallowed", "the result of a control is not told"},
    {"result-inverted", "a control that was done is told as failed, and one that failed as done"},
    {"ack-forgotten", "the engine does not hear that a report was acknowledged"},
    {"job-started-twice", "a job is given to the robot once more under another command"},
    {"job-finished-early", "a job counts as done when it begins"},
    {"node-passed-early", "a robot counts as past a node before it is"},
    {"stands-too-early",
     "a robot whose drive is cancelled, or of an engine that is gone, counts as standing before it does"},
    {"resume-swallowed", "a robot is not told that its pause is over"},
    {"refused-plan-acked", "a plan that was refused is acknowledged as accepted"},
    {"timer-forgotten", "now and then a timer of the engine does not fire"},
    {"recovery-denied", "after a restart each robot seems never to have had its job"},
    {"maintenance-forgotten", "after a restart all robots are in service"},
    {"inputs-of-another-job", "a job is given to the robot with the places of the one before of the same action"},
    {"port-off-by-one", "a job is given to the robot with the next port of it, or the next memory place there"},
    {"wrong-place", "a job is given to the robot with the fixed place beside the right one"},
    {"start-repeated", "a program's start is sent again when the connection to the arm is back", true},
    {"echo-ignored", "the numbers that an arm's programs echo are not read: any program counts for the job", true},
}};

} // namespace ACS::Simulation
