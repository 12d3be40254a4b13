#include "why/WhyExplainer.hpp"

#include "view/AgeText.hpp"
#include "why/WhyText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::string_view ACSD_NAME = "ACS";

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
    for (const PlanInfo& plan : snapshot.plans)
    {
        _plans.emplace(plan.planID, &plan);
    }
    for (const RobotInfo& robot : snapshot.robots)
    {
        _robots.emplace(robot.robotID, &robot);
    }
}

Explanation WhyExplainer::ExplainAll() const
{
    Explanation explanation;
    Chain chain;
    AddCausesOfACSD(chain);
    if (!chain.causes.empty())
    {
        explanation.findings.push_back({ESubject::Acsd, {}, "acsd needs attention.", true, TakeCauses(chain)});
    }
    for (const PlanInfo& plan : _snapshot.plans)
    {
        if (IsStopped(plan))
        {
            explanation.findings.push_back(MakePlanFinding(plan, chain));
        }
    }
    for (const RobotInfo& robot : _snapshot.robots)
    {
        AddCausesOfRobot(robot, chain);
        if (Finding finding = MakeRobotFinding(robot, chain); finding.bAttention)
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
    Chain chain;
    Finding finding = MakePlanFinding(plan, chain);
    if (!IsFinalStatus(plan.status))
    {
        AddLinks(0, chain.causes);
        AddStoreAlarm(chain);
    }
    AddRefusedReport(plan.planID, chain.causes);
    std::ranges::move(chain.causes, std::back_inserter(finding.causes));
    return {{std::move(finding)}};
}

Explanation WhyExplainer::ExplainRobot(const RobotInfo& robot) const
{
    Chain chain;
    AddCausesOfRobot(robot, chain);
    AddLinks(0, chain.causes);
    AddStoreAlarm(chain);
    if (!robot.planID.has_value()) // a TSC that is not Auto stops no plan that has begun
    {
        AddTSC(0, chain);
    }
    Finding finding = MakeRobotFinding(robot, chain);
    if (robot.planID.has_value())
    {
        AddRefusedReport(*robot.planID, finding.causes);
    }
    return {{std::move(finding)}};
}

const PlanInfo* WhyExplainer::FindPlanOrNull(std::string_view planID) const
{
    const auto found = _plans.find(planID);
    return found == _plans.end() ? nullptr : found->second;
}

const RobotInfo* WhyExplainer::FindRobotOrNull(std::string_view robotID) const
{
    const auto found = _robots.find(robotID);
    return found == _robots.end() ? nullptr : found->second;
}

std::vector<Cause> WhyExplainer::TakeCauses(Chain& chain)
{
    chain.named.clear();
    return std::exchange(chain.causes, {});
}

Finding WhyExplainer::MakePlanFinding(const PlanInfo& plan, Chain& chain) const
{
    Finding finding{ESubject::Plan, plan.planID, {}, false, {}};
    const std::string robot = plan.robotID.has_value() ? " on " + *plan.robotID : std::string();
    if (IsFinalStatus(plan.status))
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
    if (chain.plans.contains(plan.planID))
    {
        chain.causes.push_back({0, fmt::format("See plan {} above.", plan.planID), {}, {}});
    }
    else
    {
        AddPlanRecursive(plan, 0, chain);
    }
    finding.bAttention = IsStopped(plan);
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
    finding.causes = TakeCauses(chain);
    return finding;
}

void WhyExplainer::AddCausesOfRobot(const RobotInfo& robot, Chain& chain) const
{
    const auto explained = chain.robots.find(robot.robotID);
    if (explained == chain.robots.end())
    {
        if (!robot.bMaintenance && robot.reason.has_value())
        {
            AddState(robot, 0, chain.causes);
        }
        AddRobot(robot, NO_CAUSE, 0, chain);
        AddNamedRobots(robot, chain);
    }
    else if (explained->second)
    {
        chain.causes.push_back({0, fmt::format("See robot {} above.", robot.robotID), {}, {}});
    }
    const PlanInfo* const planOrNull = FindStoppedPlanOrNull(robot);
    if (planOrNull != nullptr && chain.plans.contains(planOrNull->planID))
    {
        chain.causes.push_back({0, fmt::format("Its plan {0} waits: see plan {0} above.", planOrNull->planID), {}, {}});
    }
    else if (planOrNull != nullptr)
    {
        chain.causes.push_back({0, fmt::format("Its plan {} waits.", planOrNull->planID), {}, {}});
        AddPlanRecursive(*planOrNull, 1, chain);
    }
}

Finding WhyExplainer::MakeRobotFinding(const RobotInfo& robot, Chain& chain)
{
    Finding finding{ESubject::Robot, robot.robotID, {}, false, {}};
    const bool bUnusable = IsUnusableStatus(robot.status) || robot.reason.has_value();
    finding.bAttention = bUnusable || !chain.causes.empty();
    std::string state = fmt::format("it is {}", robot.status);
    if (!robot.position.empty())
    {
        state += " at " + robot.position;
    }
    state += robot.planID.has_value() ? " with plan " + *robot.planID : ", without a plan";
    finding.text = finding.bAttention ? fmt::format("Robot {} needs attention: {}.", robot.robotID, state)
                                      : fmt::format("Nothing is in the way of robot {}: {}.", robot.robotID, state);
    finding.causes = TakeCauses(chain);
    return finding;
}

void WhyExplainer::AddCausesOfACSD(Chain& chain) const
{
    const StatusInfo& status = _snapshot.status;
    for (const std::string& reason : status.notReadyReasons)
    {
        if (std::ranges::find(status.links, reason, &LinkInfo::reason) != status.links.end())
        {
            continue; // the link has it, with its remedy
        }
        chain.causes.push_back({0, MakeSentence("acsd is not ready: " + reason), {}, {}});
    }
    AddLinks(0, chain.causes);
    AddTSC(0, chain);
    AddAlarms(ACSD_NAME, 0, chain);
    for (const BlockInfo& block : _site.blocked)
    {
        AddBlock(block, 0, chain);
    }
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
         refused.last->bRetried
             ? "The state of the MCS differs from that of acsd. Refused reports are sent again after the next registration."
             : "The state of the MCS differs from that of acsd. Refused reports are not sent again.",
         {refused.last->planID.has_value() ? "Correct the plan in the MCS; its log has the reason."
                                           : "Correct the cause in the MCS; its log has the reason."}});
}

} // namespace ACS::Acsctl
