#include "why/WhyExplainer.hpp"

#include "view/AgeText.hpp"
#include "view/ShellCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t DEEPEST = 6;
constexpr std::string_view UNRESOLVED_CODE = "ACS-1008";
constexpr std::string_view STORE_CODE = "ACS-1005";
constexpr std::string_view ACSD_NAME = "ACS";

constexpr std::array<std::string_view, 4> FINAL_STATUSES{"Completed", "Failed", "Cancelled", "Aborted"};
constexpr std::array<std::string_view, 5> UNUSABLE_STATUSES{"Error", "Stopped", "Disconnected", "Manual", "Init"};

template <std::size_t COUNT>
bool IsOneOf(const std::array<std::string_view, COUNT>& words, std::string_view word)
{
    return std::ranges::find(words, word) != words.end();
}

/// The text with a full stop at its end.
std::string MakeSentence(std::string text)
{
    if (!text.empty() && text.find_last_of(".!?") != text.size() - 1)
    {
        text += '.';
    }
    return text;
}

/// For the begin of a sentence.
std::string Capitalize(std::string word)
{
    if (!word.empty() && word.front() >= 'a' && word.front() <= 'z')
    {
        word.front() = static_cast<char>(word.front() - 'a' + 'A');
    }
    return word;
}

std::string_view FindLinkRemedy(const LinkInfo& link)
{
    if (link.name == "mqtt")
    {
        return "Check the MQTT broker and the network to it.";
    }
    // The connection itself works.
    const bool bRefused = link.reason.value_or("").starts_with("connected, not registered");
    return bRefused ? "Check the MCS: it must accept the registration of this ACS, and of no other one."
                    : "Check the MCS and the network to it.";
}

std::string MakeMaintenanceRemedy(const std::string& robotID)
{
    return "When it may move: " + MakeShellCommand("maintenance", {robotID, "off"});
}

} // namespace

bool Explanation::NeedsAttention() const
{
    return std::ranges::any_of(findings, &Finding::bAttention);
}

WhyExplainer::WhyExplainer(const SnapshotAnswer& snapshot, const SiteAnswer& site, Core::WallTime now)
    : _snapshot(snapshot),
      _site(site),
      _places(site),
      _now(now)
{
}

Explanation WhyExplainer::ExplainAll() const
{
    Explanation explanation;
    std::vector<Cause> causes = ListCausesOfACSD();
    if (!causes.empty())
    {
        explanation.findings.push_back({ESubject::Acsd, {}, "acsd needs attention.", true, std::move(causes)});
    }
    for (const PlanInfo& plan : _snapshot.plans)
    {
        if (Finding finding = MakePlanFinding(plan); finding.bAttention)
        {
            explanation.findings.push_back(std::move(finding));
        }
    }
    for (const RobotInfo& robot : _snapshot.robots)
    {
        if (Finding finding = MakeRobotFinding(robot); finding.bAttention)
        {
            explanation.findings.push_back(std::move(finding));
        }
    }
    std::vector<Cause> refused;
    AddRefusedReport({}, refused);
    if (!refused.empty())
    {
        explanation.findings.push_back({ESubject::Acsd, {}, "The MCS has refused reports.", false, std::move(refused)});
    }
    else if (explanation.findings.empty())
    {
        std::string text = fmt::format(
            "Nothing is in the way: {} plans and {} robots, none of which waits.",
            _snapshot.plans.size(),
            _snapshot.robots.size());
        explanation.findings.push_back({ESubject::Acsd, {}, std::move(text), false, {}});
    }
    return explanation;
}

Explanation WhyExplainer::ExplainPlan(const PlanInfo& plan) const
{
    Finding finding = MakePlanFinding(plan);
    if (!IsOneOf(FINAL_STATUSES, plan.status))
    {
        AddLinks(0, finding.causes);
        AddStoreAlarm(finding.causes);
    }
    AddRefusedReport(plan.planID, finding.causes);
    return {{std::move(finding)}};
}

Explanation WhyExplainer::ExplainRobot(const RobotInfo& robot) const
{
    return {{MakeRobotFinding(robot)}};
}

const PlanInfo* WhyExplainer::FindPlanOrNull(std::string_view planID) const
{
    const auto found = std::ranges::find(_snapshot.plans, planID, &PlanInfo::planID);
    return found == _snapshot.plans.end() ? nullptr : &*found;
}

const RobotInfo* WhyExplainer::FindRobotOrNull(std::string_view robotID) const
{
    const auto found = std::ranges::find(_snapshot.robots, robotID, &RobotInfo::robotID);
    return found == _snapshot.robots.end() ? nullptr : &*found;
}

Finding WhyExplainer::MakePlanFinding(const PlanInfo& plan) const
{
    Finding finding{ESubject::Plan, plan.planID, {}, false, {}};
    const std::string robot = plan.robotID.has_value() ? " on " + *plan.robotID : std::string();
    if (IsOneOf(FINAL_STATUSES, plan.status))
    {
        const std::string message = plan.message.empty() ? std::string() : ": " + plan.message;
        finding.text = MakeSentence(fmt::format(
            "Plan {} does not move because it has ended: {} at {}{}",
            plan.planID,
            plan.status,
            plan.endedAt.value_or("an unknown time"),
            message));
        return finding;
    }
    Chain chain;
    AddPlanRecursive(plan, 0, chain);
    finding.bAttention = plan.waits.has_value() || plan.status == "Paused";
    if (finding.bAttention)
    {
        std::string place;
        if (plan.waits.has_value() && plan.waits->queuePosition.has_value())
        {
            place = fmt::format(", at position {} of the queue", *plan.waits->queuePosition);
        }
        const std::optional<std::string> since = plan.waits.has_value() ? plan.waits->since : std::nullopt;
        finding.text = fmt::format(
            "Plan {} does not move{}: it is {}{}{}.",
            plan.planID,
            MakeSince(since, _now),
            plan.status,
            robot,
            place);
    }
    else
    {
        finding.text =
            fmt::format("Plan {} makes progress: it is {}{}, step {}.", plan.planID, plan.status, robot, plan.stepNo);
    }
    finding.causes = std::move(chain.causes);
    return finding;
}

Finding WhyExplainer::MakeRobotFinding(const RobotInfo& robot) const
{
    Finding finding{ESubject::Robot, robot.robotID, {}, false, {}};
    Chain chain;
    chain.robots.insert(robot.robotID);
    AddState(robot, 0, chain.causes);
    AddRobot(robot, 0, chain);
    const PlanInfo* const planOrNull = robot.planID.has_value() ? FindPlanOrNull(*robot.planID) : nullptr;
    const bool bPlanWaits = planOrNull != nullptr && (planOrNull->waits.has_value() || planOrNull->status == "Paused");
    if (bPlanWaits)
    {
        chain.causes.push_back({0, fmt::format("Its plan {} waits.", planOrNull->planID), {}, {}});
        AddPlanRecursive(*planOrNull, 1, chain);
    }
    const bool bUnusable = IsOneOf(UNUSABLE_STATUSES, robot.status) || robot.reason.has_value();
    finding.bAttention = bUnusable || !chain.causes.empty();
    std::string state = fmt::format("it is {}", robot.status);
    if (!robot.position.empty())
    {
        state += " at " + robot.position;
    }
    state += robot.planID.has_value() ? " with plan " + *robot.planID : ", without a plan";
    finding.text = finding.bAttention ? fmt::format("Robot {} needs attention: {}.", robot.robotID, state)
                                      : fmt::format("Nothing is in the way of robot {}: {}.", robot.robotID, state);
    finding.causes = std::move(chain.causes);
    return finding;
}

std::vector<Cause> WhyExplainer::ListCausesOfACSD() const
{
    std::vector<Cause> causes;
    const StatusInfo& status = _snapshot.status;
    for (const std::string& reason : status.notReadyReasons)
    {
        if (std::ranges::find(status.links, reason, &LinkInfo::reason) != status.links.end())
        {
            continue; // the link has it, with its remedy
        }
        causes.push_back({0, MakeSentence("acsd is not ready: " + reason), {}, {}});
    }
    AddLinks(0, causes);
    AddTSC(0, causes);
    AddAlarms(ACSD_NAME, 0, causes);
    Chain chain;
    for (const BlockInfo& block : _site.blocked)
    {
        AddBlock(block, 0, chain);
    }
    causes.insert(causes.end(), chain.causes.begin(), chain.causes.end());
    return causes;
}

void WhyExplainer::AddLinks(std::size_t depth, std::vector<Cause>& causes) const
{
    for (const LinkInfo& link : _snapshot.status.links)
    {
        if (!link.bUp)
        {
            const std::string reason = link.reason.has_value() ? ": " + *link.reason : std::string();
            causes.push_back(
                {depth,
                 MakeSentence(fmt::format("The link {} is down{}{}", link.name, MakeSince(link.since, _now), reason)),
                 {},
                 {std::string(FindLinkRemedy(link))}});
        }
    }
}

void WhyExplainer::AddRefusedReport(std::string_view planID, std::vector<Cause>& causes) const
{
    const RefusedReportsInfo& refused = _snapshot.status.refusedReports;
    if (!refused.last.has_value() || (!planID.empty() && refused.last->planID != planID))
    {
        return;
    }
    const std::string plan = refused.last->planID.has_value() ? " of plan " + *refused.last->planID : std::string();
    causes.push_back(
        {0,
         MakeSentence(fmt::format(
             "The MCS has refused reports ({} since the start of acsd), last a {}{}: {}",
             refused.count,
             refused.last->command,
             plan,
             refused.last->message)),
         "The state of the MCS differs from that of acsd. Refused reports are not sent again.",
         {"Correct the plan in the MCS; its log has the reason."}});
}

void WhyExplainer::AddTSC(std::size_t depth, std::vector<Cause>& causes) const
{
    const StatusInfo& status = _snapshot.status;
    if (status.tsc != "Auto")
    {
        const std::string reason = status.tscReason.has_value() ? ": " + *status.tscReason : std::string();
        causes.push_back(
            {depth,
             MakeSentence(fmt::format("The TSC is {}{}", status.tsc, reason)),
             {},
             {"When the work may continue: acsctl tsc resume"}});
    }
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    if (depth > DEEPEST || !chain.plans.insert(plan.planID).second)
    {
        return;
    }
    if (plan.status == "Paused")
    {
        chain.causes.push_back(
            {depth,
             fmt::format("Plan {} is paused.", plan.planID),
             {},
             {"When it may continue: " + MakeShellCommand("resume", {plan.planID})}});
    }
    if (plan.waits.has_value())
    {
        chain.causes.push_back({depth, MakeSentence(plan.waits->message), {}, {}});
        AddTSC(depth, chain.causes);
    }
    AddUnresolvedJobs(plan, depth, chain.causes);
    std::set<std::string> listed;
    if (plan.waits.has_value())
    {
        for (const RobotReason& robot : plan.waits->robots)
        {
            listed.insert(robot.robotID);
            AddRobotOfPlanRecursive(robot.robotID, robot.reason, depth, chain);
        }
    }
    if (plan.robotID.has_value() && !listed.contains(*plan.robotID))
    {
        AddRobotOfPlanRecursive(*plan.robotID, {}, depth, chain);
    }
    if (plan.waits.has_value())
    {
        AddBlocksOfPlan(plan, depth, chain);
    }
}

// NOLINTNEXTLINE(misc-no-recursion): at most DEEPEST
void WhyExplainer::AddRobotOfPlanRecursive(
    const std::string& robotID,
    const std::string& reason,
    std::size_t depth,
    Chain& chain) const
{
    const std::size_t inner = reason.empty() ? depth : depth + 1;
    const RobotInfo* const robotOrNull = FindRobotOrNull(robotID);
    if (!reason.empty())
    {
        Cause cause{depth, MakeSentence(fmt::format("Robot {}: {}", robotID, reason)), {}, {}};
        if (robotOrNull != nullptr && robotOrNull->bMaintenance)
        {
            cause.remedy.push_back(MakeMaintenanceRemedy(robotID));
        }
        chain.causes.push_back(std::move(cause));
    }
    if (robotOrNull == nullptr)
    {
        return;
    }
    if (chain.robots.insert(robotID).second)
    {
        if (reason.empty())
        {
            AddState(*robotOrNull, inner, chain.causes);
        }
        AddRobot(*robotOrNull, inner, chain);
    }
    const PlanInfo* const otherOrNull =
        robotOrNull->planID.has_value() ? FindPlanOrNull(*robotOrNull->planID) : nullptr;
    if (otherOrNull != nullptr && !chain.plans.contains(otherOrNull->planID)
        && (otherOrNull->waits.has_value() || otherOrNull->status == "Paused"))
    {
        chain.causes.push_back({inner, fmt::format("Its plan {} does not move either.", otherOrNull->planID), {}, {}});
        AddPlanRecursive(*otherOrNull, inner + 1, chain);
    }
}

void WhyExplainer::AddState(const RobotInfo& robot, std::size_t depth, std::vector<Cause>& causes)
{
    if (robot.bMaintenance)
    {
        causes.push_back(
            {depth,
             fmt::format("Robot {} is in maintenance.", robot.robotID),
             {},
             {MakeMaintenanceRemedy(robot.robotID)}});
    }
    else if (robot.reason.has_value())
    {
        causes.push_back(
            {depth, MakeSentence(fmt::format("Robot {} is not available: {}", robot.robotID, *robot.reason)), {}, {}});
    }
    else if (IsOneOf(UNUSABLE_STATUSES, robot.status))
    {
        causes.push_back({depth, fmt::format("Robot {} is {}.", robot.robotID, robot.status), {}, {}});
    }
}

void WhyExplainer::AddRobot(const RobotInfo& robot, std::size_t depth, Chain& chain) const
{
    AddAlarms(robot.robotID, depth, chain.causes);
    AddBlocksOfRoute(robot, depth, chain);
}

void WhyExplainer::AddAlarms(std::string_view robotID, std::size_t depth, std::vector<Cause>& causes) const
{
    for (const AlarmInfo& alarm : _snapshot.alarms)
    {
        // An unresolved job is explained with its plan.
        const bool bWithPlan = alarm.errorCode == UNRESOLVED_CODE && alarm.planID.has_value();
        if (alarm.robotID == robotID && !bWithPlan)
        {
            causes.push_back(MakeAlarmCause(alarm, depth));
        }
    }
}

void WhyExplainer::AddStoreAlarm(std::vector<Cause>& causes) const
{
    const auto alarm = std::ranges::find(_snapshot.alarms, STORE_CODE, &AlarmInfo::errorCode);
    if (alarm != _snapshot.alarms.end())
    {
        causes.push_back(MakeAlarmCause(*alarm, 0));
    }
}

void WhyExplainer::AddUnresolvedJobs(const PlanInfo& plan, std::size_t depth, std::vector<Cause>& causes) const
{
    for (const AlarmInfo& alarm : _snapshot.alarms)
    {
        if (alarm.errorCode == UNRESOLVED_CODE && alarm.planID == plan.planID)
        {
            Cause cause = MakeAlarmCause(alarm, depth);
            cause.remedy.push_back(
                "Then: " + MakeShellCommand("resolve", {plan.planID, alarm.jobID.value_or("JOB")})
                + " done|failed|again");
            causes.push_back(std::move(cause));
        }
    }
}

void WhyExplainer::AddBlocksOfPlan(const PlanInfo& plan, std::size_t depth, Chain& chain) const
{
    for (const StepInfo& step : plan.steps)
    {
        const bool bEnded = IsOneOf(FINAL_STATUSES, step.status) || step.status == "Skipped";
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
    if (!chain.blocks.insert(block.kind + " " + block.id).second)
    {
        return;
    }
    const std::string reason = block.reason.value_or("").empty() ? std::string() : ": " + *block.reason;
    chain.causes.push_back(
        {depth,
         MakeSentence(fmt::format(
             "{} {} is blocked{}{}",
             Capitalize(block.kind),
             block.id,
             MakeSince(block.since, _now),
             reason)),
         {},
         {"When it is free: " + MakeShellCommand("unblock", {block.kind, block.id})}});
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
            alarm.robotID == ACSD_NAME ? "acsd" : alarm.robotID,
            MakeSince(alarm.since, _now),
            message)),
        MakeSentence(alarm.cause),
        {}};
    if (!alarm.remedy.empty())
    {
        cause.remedy.push_back(MakeSentence(alarm.remedy));
    }
    return cause;
}

} // namespace ACS::Acsctl
