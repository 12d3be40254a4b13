#include "why/WhyExplainer.hpp"

#include "common/config/ShellCommand.hpp"
#include "view/AgeText.hpp"
#include "why/WhyText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t DEEPEST = 6;
constexpr std::string_view UNRESOLVED_CODE = "ACS-1008";
constexpr std::string_view STORE_CODE = "ACS-1005";
constexpr std::string_view ACSD = "ACS";

/// Equal for two lists with the same robots and reasons.
std::string MakeListKey(const std::vector<RobotReason>& robots)
{
    std::string key;
    for (const RobotReason& robot : robots)
    {
        key += fmt::format("{}:{}{}:{}", robot.robotID.size(), robot.robotID, robot.reason.size(), robot.reason);
    }
    return key;
}

/// Without the sentence that takes a robot out of service.
std::string DropMaintenance(const std::string& remedy)
{
    const std::size_t found = remedy.find("maintenance ROBOT on");
    if (found == std::string::npos)
    {
        return remedy;
    }
    const std::size_t before = remedy.rfind(". ", found);
    const std::size_t after = remedy.find(". ", found);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string rest = remedy.substr(0, begin) + (after == std::string::npos ? "" : remedy.substr(after + 1));
    return rest.starts_with(' ') ? rest.substr(1) : rest;
}

/// The wait reason of a paused plan with its id, if that reason states the pause; otherwise the state.
std::string DescribePause(const PlanInfo& plan, bool bStated)
{
    constexpr std::string_view SUBJECT = "The plan";
    return bStated ? fmt::format("Plan {}{}", plan.planID, plan.waits->message.substr(SUBJECT.size()))
                   : fmt::format("Plan {} is paused.", plan.planID);
}

/// What a robot does, or why it does nothing.
std::string DescribeState(const RobotInfo& robot)
{
    if (robot.reason.has_value())
    {
        return *robot.reason;
    }
    return robot.status + (robot.planID.has_value() ? " with plan " + *robot.planID : std::string());
}

/// "Robot R1: battery 12 % is below 20 %.", or the reason alone if it is a sentence about the robot.
std::string DescribeReason(const RobotReason& robot)
{
    return MakeSentence(
        robot.reason.starts_with(robot.robotID + ' ') ? robot.reason
                                                      : fmt::format("Robot {}: {}", robot.robotID, robot.reason));
}

/// " See robot R1 and plan P1 above.", or nothing.
std::string MakeReference(const RobotInfo* robotOrNull, const PlanInfo* planOrNull)
{
    std::string text;
    if (robotOrNull != nullptr)
    {
        text += " See robot " + robotOrNull->robotID;
    }
    if (planOrNull != nullptr)
    {
        text += (text.empty() ? " See plan " : " and plan ") + planOrNull->planID;
    }
    return text.empty() ? text : text + " above.";
}

} // namespace

void WhyExplainer::AddTSC(std::size_t depth, Chain& chain) const
{
    const StatusInfo& status = _snapshot.status;
    if (status.tsc == "Auto")
    {
        return;
    }
    if (std::exchange(chain.bTSC, true))
    {
        chain.causes.push_back({depth, fmt::format("The TSC is {}: see above.", status.tsc), {}, {}});
        return;
    }
    const std::string reason = status.tscReason.value_or(std::string());
    const bool bEndsByItself = reason.starts_with("Not all robots have reported");
    chain.causes.push_back(
        {depth,
         MakeSentence(fmt::format("The TSC is {}{}{}", status.tsc, reason.empty() ? "" : ": ", reason)),
         {},
         {bEndsByItself ? "Wait, at most restart.wait (30 s by default); then see the alarms of the missing robots."
                        : "When the work may continue: acsctl tsc resume"}});
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    chain.plans.insert(plan.planID);
    const std::size_t stated = AddWaits(plan, depth, chain);
    AddUnresolvedJobs(plan, depth, chain);
    AddRobotsOfPlanRecursive(plan, stated, depth, chain);
    if (plan.waits.has_value())
    {
        AddNamedRobotsRecursive(plan, depth, chain);
        AddBlocksOfPlan(plan, depth, chain);
    }
}

std::size_t WhyExplainer::AddWaits(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    const bool bWaits = plan.waits.has_value() && !plan.waits->message.empty();
    bool bStated = false;
    if (plan.status == "Paused")
    {
        // "The plan is paused by the operator.", "The plan is held in the queue by PausePlan."
        bStated = bWaits
            && (plan.waits->message.starts_with("The plan is paused")
                || plan.waits->message.starts_with("The plan is held"));
        chain.causes.push_back(
            {depth,
             MakeSentence(DescribePause(plan, bStated)),
             {},
             {"When it may continue: " + Apps::MakeShellCommand("resume", {plan.planID})}});
    }
    std::size_t stated = NO_CAUSE;
    if (bWaits && !bStated)
    {
        stated = chain.causes.size();
        chain.causes.push_back({depth, MakeSentence(plan.waits->message), {}, {}});
    }
    const bool bStatedTSC = bWaits && plan.waits->message.starts_with("The TSC is");
    if (plan.waits.has_value() && !(chain.bTSC && bStatedTSC))
    {
        AddTSC(depth, chain);
    }
    return stated;
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddRobotsOfPlanRecursive(const PlanInfo& plan, std::size_t stated, std::size_t depth, Chain& chain)
    const
{
    const std::vector<RobotReason> robots = plan.waits.has_value() ? plan.waits->robots : std::vector<RobotReason>();
    const auto [list, bNew] = chain.lists.try_emplace(MakeListKey(robots), plan.planID);
    if (robots.size() > 1 && !bNew)
    {
        chain.causes.push_back(
            {depth,
             fmt::format("The reasons of its {} robots are those of plan {}: see above.", robots.size(), list->second),
             {},
             {}});
    }
    else
    {
        for (const RobotReason& robot : robots)
        {
            AddRobotOfPlanRecursive(plan.planID, robot, depth, chain);
        }
    }
    const bool bListed = std::ranges::find(robots, plan.robotID, &RobotReason::robotID) != robots.end();
    const RobotInfo* const ownOrNull = plan.robotID.has_value() ? FindRobotOrNull(*plan.robotID) : nullptr;
    if (bListed || ownOrNull == nullptr)
    {
        return;
    }
    const bool bStated = stated != NO_CAUSE && plan.waits->message.starts_with(ownOrNull->robotID + ": ");
    if (const auto known = chain.robots.find(ownOrNull->robotID); known == chain.robots.end())
    {
        if (!bStated && !ownOrNull->bMaintenance)
        {
            AddState(*ownOrNull, depth, chain.causes);
        }
        AddRobot(*ownOrNull, bStated ? stated : NO_CAUSE, depth, chain);
    }
    else if (known->second)
    {
        chain.causes.push_back({depth, fmt::format("Its robot {0}: see robot {0} above.", ownOrNull->robotID), {}, {}});
    }
    const PlanInfo* const otherOrNull = FindStoppedPlanOrNull(*ownOrNull);
    if (otherOrNull != nullptr && !chain.plans.contains(otherOrNull->planID))
    {
        AddOtherPlanRecursive(*otherOrNull, depth, chain);
    }
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddNamedRobotsRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    for (const RobotInfo* const robotOrNull : ListNamedRobots(plan.waits->message))
    {
        const std::string& id = robotOrNull->robotID;
        const bool bListed =
            std::ranges::find(plan.waits->robots, id, &RobotReason::robotID) != plan.waits->robots.end();
        if (id != plan.robotID && !bListed)
        {
            AddRobotOfPlanRecursive(plan.planID, {id, DescribeState(*robotOrNull)}, depth, chain);
        }
    }
}

void WhyExplainer::AddNamedRobots(const RobotInfo& robot, Chain& chain) const
{
    if (!robot.reason.has_value())
    {
        return;
    }
    for (const RobotInfo* const otherOrNull : ListNamedRobots(*robot.reason))
    {
        if (otherOrNull != &robot)
        {
            AddRobotOfPlanRecursive({}, {otherOrNull->robotID, DescribeState(*otherOrNull)}, 0, chain);
        }
    }
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddRobotOfPlanRecursive(
    std::string_view planID,
    const RobotReason& reason,
    std::size_t depth,
    Chain& chain) const
{
    const RobotInfo* const robotOrNull = FindRobotOrNull(reason.robotID);
    const PlanInfo* const foundOrNull = robotOrNull == nullptr ? nullptr : FindStoppedPlanOrNull(*robotOrNull);
    const PlanInfo* const otherOrNull = foundOrNull == nullptr || foundOrNull->planID == planID ? nullptr : foundOrNull;
    const auto known = chain.robots.find(reason.robotID);
    const bool bKnown = known != chain.robots.end();
    const bool bOtherKnown = otherOrNull != nullptr && chain.plans.contains(otherOrNull->planID);
    const std::size_t stated = chain.causes.size();
    chain.causes.push_back(
        {depth,
         DescribeReason(reason)
             + MakeReference(bKnown && known->second ? robotOrNull : nullptr, bOtherKnown ? otherOrNull : nullptr),
         {},
         {}});
    if (robotOrNull != nullptr && !bKnown)
    {
        AddRobot(*robotOrNull, stated, depth + 1, chain);
    }
    if (otherOrNull != nullptr && !bOtherKnown)
    {
        AddOtherPlanRecursive(*otherOrNull, depth + 1, chain);
    }
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddOtherPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    std::string text = fmt::format("Its plan {} does not move either.", plan.planID);
    if (depth >= DEEPEST)
    {
        chain.causes.push_back(
            {depth, std::move(text), {}, {"For its causes: " + Apps::MakeShellCommand("why", {plan.planID})}});
        return;
    }
    chain.causes.push_back({depth, std::move(text), {}, {}});
    AddPlanRecursive(plan, depth + 1, chain);
}

std::vector<const RobotInfo*> WhyExplainer::ListNamedRobots(std::string_view text) const
{
    std::vector<const RobotInfo*> named;
    constexpr std::string_view BETWEEN = " ,.:;";
    for (std::size_t begin = 0; begin < text.size();)
    {
        const std::size_t end = std::min(text.find_first_of(BETWEEN, begin), text.size());
        const RobotInfo* const robotOrNull = FindRobotOrNull(text.substr(begin, end - begin));
        if (robotOrNull != nullptr && std::ranges::find(named, robotOrNull) == named.end())
        {
            named.push_back(robotOrNull);
        }
        begin = end + 1;
    }
    return named;
}

const PlanInfo* WhyExplainer::FindStoppedPlanOrNull(const RobotInfo& robot) const
{
    const PlanInfo* const planOrNull = robot.planID.has_value() ? FindPlanOrNull(*robot.planID) : nullptr;
    return planOrNull != nullptr && IsStopped(*planOrNull) ? planOrNull : nullptr;
}

void WhyExplainer::AddState(const RobotInfo& robot, std::size_t depth, std::vector<Cause>& causes)
{
    if (robot.reason.has_value())
    {
        const bool bSentence = robot.reason->starts_with(robot.robotID + ' ');
        causes.push_back(
            {depth,
             MakeSentence(
                 bSentence ? *robot.reason
                           : fmt::format("Robot {} is not available: {}", robot.robotID, *robot.reason)),
             {},
             {}});
    }
    else if (IsUnusableStatus(robot.status))
    {
        causes.push_back({depth, fmt::format("Robot {} is {}.", robot.robotID, robot.status), {}, {}});
    }
}

void WhyExplainer::AddRobot(const RobotInfo& robot, std::size_t stated, std::size_t depth, Chain& chain) const
{
    const std::size_t before = chain.causes.size();
    AddAlarms(robot.robotID, depth, chain);
    AddBlocksOfRoute(robot, depth, chain);
    if (robot.bMaintenance)
    {
        // After what it may be in maintenance for.
        const bool bOwn = chain.causes.size() != before;
        if (stated == NO_CAUSE || bOwn)
        {
            chain.causes.push_back(
                {depth,
                 stated == NO_CAUSE
                     ? fmt::format("Robot {} is in maintenance.", robot.robotID)
                     : fmt::format("Robot {} stays in maintenance until an operator ends it.", robot.robotID),
                 {},
                 {}});
        }
        chain.causes[bOwn || stated == NO_CAUSE ? chain.causes.size() - 1 : stated].remedy.push_back(
            "When it may move: " + Apps::MakeShellCommand("maintenance", {robot.robotID, "off"}));
    }
    chain.robots[robot.robotID] = chain.causes.size() != before || robot.bMaintenance;
}

void WhyExplainer::AddAlarms(std::string_view robotID, std::size_t depth, Chain& chain) const
{
    for (const AlarmInfo& alarm : _snapshot.alarms)
    {
        // An unresolved job is explained with its plan.
        const bool bWithPlan = alarm.errorCode == UNRESOLVED_CODE && alarm.planID.has_value();
        if (alarm.robotID == robotID && !bWithPlan)
        {
            AddAlarm(alarm, depth, chain);
        }
    }
}

void WhyExplainer::AddAlarm(const AlarmInfo& alarm, std::size_t depth, Chain& chain) const
{
    if (chain.alarms.insert(&alarm).second)
    {
        chain.causes.push_back(MakeAlarmCause(alarm, depth));
    }
}

void WhyExplainer::AddStoreAlarm(Chain& chain) const
{
    const auto alarm = std::ranges::find(_snapshot.alarms, STORE_CODE, &AlarmInfo::errorCode);
    if (alarm != _snapshot.alarms.end())
    {
        AddAlarm(*alarm, 0, chain);
    }
}

void WhyExplainer::AddUnresolvedJobs(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    for (const AlarmInfo& alarm : _snapshot.alarms)
    {
        if (alarm.errorCode == UNRESOLVED_CODE && alarm.planID == plan.planID && chain.alarms.insert(&alarm).second)
        {
            Cause cause = MakeAlarmCause(alarm, depth);
            for (const auto& [finding, outcome] :
                 {std::pair("If it was done", "done"),
                  std::pair("If it failed", "failed"),
                  std::pair("If nothing was moved", "again")})
            {
                cause.remedy.push_back(fmt::format(
                    "{}: {}",
                    finding,
                    Apps::MakeShellCommand("resolve", {plan.planID, alarm.jobID.value_or("JOB"), outcome})));
            }
            chain.causes.push_back(std::move(cause));
        }
    }
}

void WhyExplainer::AddBlocksOfPlan(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    for (const StepInfo& step : plan.steps)
    {
        const bool bEnded = IsFinalStatus(step.status) || step.status == "Skipped";
        for (const BlockInfo& block : _site.blocked)
        {
            if (!bEnded && _places.IsAtStation(block, step.position))
            {
                AddBlock(block, depth, chain);
            }
        }
    }
    // An edge in the way of a robot that has no route yet is named by the wait reason only.
    for (const BlockInfo& block : _site.blocked)
    {
        if (BlockedPlaces::IsNamed(block, *plan.waits))
        {
            AddBlock(block, depth, chain);
        }
    }
}

void WhyExplainer::AddBlocksOfRoute(const RobotInfo& robot, std::size_t depth, Chain& chain) const
{
    for (const BlockInfo& block : _site.blocked)
    {
        if (_places.IsOnRoute(block, robot))
        {
            AddBlock(block, depth, chain);
        }
    }
}

void WhyExplainer::AddBlock(const BlockInfo& block, std::size_t depth, Chain& chain) const
{
    const std::string name = block.kind + " " + block.id;
    if (!chain.named.insert(name).second)
    {
        return;
    }
    if (!chain.blocks.insert(name).second)
    {
        chain.causes.push_back({depth, fmt::format("{} is blocked: see above.", Capitalize(name)), {}, {}});
        return;
    }
    const std::string reason = block.reason.value_or("").empty() ? std::string() : ": " + *block.reason;
    chain.causes.push_back(
        {depth,
         MakeSentence(fmt::format("{} is blocked{}{}", Capitalize(name), MakeSince(block.since, _now), reason)),
         {},
         {"When it is free: " + Apps::MakeShellCommand("unblock", {block.kind, block.id})}});
}

Cause WhyExplainer::MakeAlarmCause(const AlarmInfo& alarm, std::size_t depth) const
{
    const std::string title = alarm.title.empty() ? std::string() : " " + alarm.title;
    const std::string message = alarm.message.empty() ? std::string() : ": " + alarm.message;
    Cause cause{
        depth,
        MakeSentence(fmt::format(
            "{} alarm {}{} of {}{}{}",
            Capitalize(alarm.level),
            alarm.errorCode,
            title,
            alarm.robotID == ACSD ? "acsd" : alarm.robotID,
            MakeSince(alarm.since, _now),
            message)),
        MakeSentence(alarm.cause),
        {}};
    const RobotInfo* const robotOrNull = FindRobotOrNull(alarm.robotID);
    const std::string remedy =
        robotOrNull != nullptr && robotOrNull->bMaintenance ? DropMaintenance(alarm.remedy) : alarm.remedy;
    if (!remedy.empty())
    {
        cause.remedy.push_back(MakeSentence(remedy));
    }
    return cause;
}

} // namespace ACS::Acsctl
