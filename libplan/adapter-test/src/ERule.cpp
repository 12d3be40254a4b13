#include <acs/adapter_test/ERule.hpp>

#include <cassert>
#include <cstddef>

namespace ACS::AdapterTest
{

namespace
{

struct RuleRow
{
    std::string_view name;
    std::string_view text;
};

/// In the order of the enumerators.
constexpr std::array<RuleRow, ALL_RULES.size()> RULES{{
    {"output-in-call", "Calls append to `out` during the call, and not later."},
    {"silent-after-destruction", "After its destruction nothing of the adapter raises events."},
    {"time-advances", "An adapter does not start timers without delay endlessly."},
    {"constant-answers", "`GetRejectionReasonOrNull` of an adapter and of an `IJobCheck` always answers the same."},
    {"link-reported", "`LinkChanged` is raised when the robot is connected or disconnected."},
    {"state-after-connection", "After each connection `StateChanged` follows. States before it are ignored."},
    {"state-true", "After each change of the robot, also the last one, `StateChanged` shows its new state."},
    {"usable",
     "A robot that obeys and is at rest is reported as automatic and compatible, not occupied and without heavy errors."},
    {"loads-true",
     "`StateChanged::loads` shows the robot's carriers; the state with those after a job precedes its `JobFinished`."},
    {"held-nodes", "After a restart `heldNodeIDs` lists each node that the robot may enter without a further command."},
    {"restart-evidence-true",
     "`RestartEvidence::commandID` is the last drive or job that the robot has received; with a `progressToken` it may be empty."},
    {"known-ids", "Events name only drives and jobs that were commanded."},
    {"late-commands-ignored", "A command for a drive or job that has just ended changes nothing."},
    {"one-end", "Each drive and each job is ended by one event, and no event of it follows."},
    {"nothing-kept", "After `DriveRejected` and `DriveCancelled` the robot is stopped and keeps nothing of the drive."},
    {"commands-kept", "A command that the robot misses because it is disconnected is answered after the connection."},
    {"drive-answered",
     "Each `Drive` gets a first event (`NodePassed` or `DriveRejected`) and, when all its nodes are released, one that ends it."},
    {"nodes-in-order", "`NodePassed` is raised for every node in the order of the route, when the robot is there."},
    {"released-nodes-only", "The robot enters only nodes that are released to it."},
    {"arrival-true", "`Arrived` is raised when every node is passed and the robot is stopped on the last one."},
    {"cancel-stops", "`CancelDrive` stops the robot and is answered when it is stopped, with the node where it is."},
    {"job-answered",
     "Each `StartJob` and `RecoverJob` gets a first event and, when the robot has ended the job, one that ends it."},
    {"job-once", "The robot executes each `commandID` at most once."},
    {"outcome-true", "An event that ends a job states what the robot has done, also after a restart."},
    {"recovery-starts-nothing", "`RecoverJob` never starts a job."},
    {"cancel-job-answered", "`CancelJob` ends the job by `JobFailed`, or by `JobFinished` if it was too late."},
    {"pause-obeyed", "After `Pause` the robot is stopped, reports `bPaused` and stays so until `Resume`."},
    {"resume-obeyed", "After `Resume` the robot reports no `bPaused` and continues its drive or job."},
    {"charging-reported", "`StartCharging` and `StopCharging` are answered by `StateChanged` with `bCharging`."},
}};

const RuleRow& GetRow(ERule rule)
{
    const auto index = static_cast<std::size_t>(rule);
    assert(index < RULES.size());
    return RULES.at(index);
}

} // namespace

std::string_view GetRuleName(ERule rule)
{
    return GetRow(rule).name;
}

std::string_view GetRuleText(ERule rule)
{
    return GetRow(rule).text;
}

} // namespace ACS::AdapterTest
