#include "view/StateViewMaker.hpp"

#include "common/config/ShellCommand.hpp"
#include "operator/AlarmCatalog.hpp"
#include "view/PlanViewMaker.hpp"
#include <acs/core/Version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr double FULL_PERCENT = 100;
constexpr double PER_UNIT = 1'000;

double Round(double value)
{
    return std::round(value * PER_UNIT) / PER_UNIT;
}

/// Towards zero: 3.142 would be above pi, and no valid theta of a command.
double RoundAngle(double value)
{
    return std::trunc(value * PER_UNIT) / PER_UNIT;
}

std::optional<std::string> TextOrNull(const std::string& text)
{
    return text.empty() ? std::nullopt : std::optional(text);
}

/// The time noted for the key; `now` for a key that is new.
Core::WallTime Note(
    std::map<std::string, Core::WallTime, std::less<>>& times,
    const std::string& key,
    Core::WallTime now)
{
    return times.try_emplace(key, now).first->second;
}

void Forget(std::map<std::string, Core::WallTime, std::less<>>& times, const std::set<std::string, std::less<>>& keep)
{
    std::erase_if(times, [&keep](const auto& entry) { return !keep.contains(entry.first); });
}

/// The members of the alarm, quoted for a shell, in the place of the words that stand for them in the commands between backticks.
std::string FillRemedy(std::string_view remedy, const Planning::Alarm& alarm)
{
    const std::map<std::string_view, std::optional<std::string>> words{
        {"ROBOT", alarm.robotID},
        {"CODE", alarm.errorCode},
        {"PLAN", alarm.planID},
        {"JOB", alarm.jobID},
        {"STEP", alarm.stepNo.has_value() ? std::optional(fmt::format("{}", *alarm.stepNo)) : std::nullopt}};
    std::string filled;
    bool bCommand = false;
    while (!remedy.empty())
    {
        const std::size_t end = std::min(remedy.find_first_of(" `."), remedy.size() - 1);
        const std::string_view word = remedy.substr(0, end == 0 ? 0 : end);
        const auto found = words.find(word);
        const bool bFilled = bCommand && found != words.end() && found->second.has_value();
        filled += bFilled ? Apps::QuoteForShell(*found->second) : std::string(word);
        filled += remedy[end];
        bCommand = bCommand != (remedy[end] == '`');
        remedy.remove_prefix(end + 1);
    }
    return filled;
}

AlarmView MakeAlarmView(const Planning::Alarm& alarm, Core::WallTime since)
{
    const AlarmDescription& description = DescribeAlarm(alarm.errorCode);
    return {
        alarm.robotID,
        alarm.errorCode,
        std::string(GetText(alarm.level)),
        std::string(description.title),
        alarm.message,
        std::string(description.cause),
        FillRemedy(description.remedy, alarm),
        since,
        alarm.planID,
        alarm.stepNo,
        alarm.jobID};
}

void AddDetails(RobotView& robot, const RobotLinkState& link)
{
    robot.driver = link.driver;
    robot.ports = link.ports;
    robot.topic = TextOrNull(link.topicPrefix);
    robot.bArmUp = link.details.bArmUp;
    robot.protocolVersion = link.details.protocolVersion;
    robot.mode = link.details.mode;
    robot.warnings = link.details.warnings;
    robot.lastMessageAt = link.details.lastMessageAt;
    for (const DriverError& error : link.details.errors)
    {
        robot.errors.push_back({error.type, error.level, error.description});
    }
}

RobotView MakeRobotView(const Planning::RobotStatus& status)
{
    RobotView robot;
    robot.robotID = status.robotID;
    robot.type = GetText(status.type);
    robot.status = GetText(status.status);
    robot.position = status.position;
    robot.planID = status.planID;
    robot.stepNo = status.stepNo;
    robot.jobID = status.jobID;
    robot.carrierIDs = status.carrierIDs;
    robot.bInMaintenance = status.bInMaintenance;
    robot.reason = status.planID.has_value() ? std::nullopt : TextOrNull(status.message);
    return robot;
}

} // namespace

StateViewMaker::StateViewMaker(const Planning::PlanEngine& engine, Core::WallTime startedAt)
    : _engine(engine),
      _startedAt(startedAt)
{
}

StateView StateViewMaker::Make(const ProgramState& program, Core::WallTime now)
{
    StateView state;
    state.plans = MakePlans(now);
    state.robots = MakeRobots(program);
    state.alarms = MakeAlarms(now);
    state.status = MakeStatus(program, now);
    StatusView& status = state.status;
    status.plans.waiting = static_cast<std::size_t>(
        std::ranges::count_if(state.plans, [](const PlanView& plan) { return !plan.robotID.has_value(); }));
    status.plans.active = state.plans.size() - status.plans.waiting;
    status.robots.total = state.robots.size();
    for (const RobotView& robot : state.robots)
    {
        ++status.robots.byStatus[robot.status];
    }
    return state;
}

StatusView StateViewMaker::MakeStatus(const ProgramState& program, Core::WallTime now)
{
    StatusView status;
    status.version = Core::SDK_VERSION;
    status.startedAt = _startedAt;
    status.notReadyReasons = ListNotReadyReasons(program);
    status.bReady = status.notReadyReasons.empty();
    status.bConnected = program.bConnected;
    for (const LinkStatus& link : program.links)
    {
        auto& [bUp, since] = _links.try_emplace(link.name, link.bUp, now).first->second;
        since = std::exchange(bUp, link.bUp) == link.bUp ? since : now;
        status.links.push_back(
            {link.name,
             link.bUp,
             link.bUp ? std::nullopt : std::optional(DescribeDown(link)),
             since,
             TextOrNull(link.broker)});
    }
    status.tsc = GetText(_engine.GetTscState());
    status.tscReason = TextOrNull(std::string(_engine.GetTscReason()));
    const Planning::OutboxSummary outbox = _engine.GetOutboxSummary();
    status.outbox = {outbox.count, outbox.oldest};
    status.refusedReports.count = program.refusedReports.count;
    if (program.refusedReports.count > 0)
    {
        const RefusedReports& refused = program.refusedReports;
        status.refusedReports.last = {refused.command, TextOrNull(refused.planID), refused.message, refused.bRetried};
    }
    const std::vector<Planning::Alarm>& alarms = _engine.GetActiveAlarms();
    status.alarms.heavy =
        static_cast<std::size_t>(std::ranges::count(alarms, Planning::EAlarmLevel::Heavy, &Planning::Alarm::level));
    status.alarms.light = alarms.size() - status.alarms.heavy;
    if (_blocks != _engine.GetBlocks())
    {
        _blocks = _engine.GetBlocks();
        ++_siteRevision;
    }
    status.siteRevision = _siteRevision;
    return status;
}

std::vector<PlanView> StateViewMaker::MakePlans(Core::WallTime now)
{
    std::map<std::string, Planning::WaitReason, std::less<>> reasons;
    std::set<std::string, std::less<>> waiting;
    for (Planning::WaitReason& reason : _engine.GetWaitReasons())
    {
        waiting.insert(reason.planID);
        reasons.emplace(reason.planID, std::move(reason));
    }
    std::map<std::string, std::string, std::less<>> robots; // by planID
    for (const Planning::RobotStatus& robot : _engine.GetRobotStatuses())
    {
        if (robot.planID.has_value())
        {
            robots.emplace(*robot.planID, robot.robotID);
        }
    }
    std::vector<PlanView> plans;
    for (const Planning::PlanRecord& record : _engine.GetActivePlanRecords())
    {
        PlanView& plan = plans.emplace_back(MakePlanView(record, EPlanDetail::Steps));
        // The MCS is sent the robot of a plan only when the robot has started it.
        if (const auto robot = robots.find(plan.planID); robot != robots.end())
        {
            plan.robotID = robot->second;
        }
        if (const auto found = reasons.find(plan.planID); found != reasons.end())
        {
            // A plan in the queue has waited since it was accepted, whatever acsd has seen of that.
            const Core::WallTime noted = Note(_waits, plan.planID, now);
            plan.waits = MakeWaitView(found->second, plan.robotID.has_value() ? noted : plan.acceptedAt);
        }
    }
    Forget(_waits, waiting);
    std::stable_partition(plans.begin(), plans.end(), [](const PlanView& plan) { return plan.robotID.has_value(); });
    return plans;
}

std::vector<AlarmView> StateViewMaker::MakeAlarms(Core::WallTime now)
{
    std::vector<AlarmView> alarms;
    std::set<std::string, std::less<>> active;
    for (const Planning::Alarm& alarm : _engine.GetActiveAlarms())
    {
        const std::string key = fmt::format(
            "{}\n{}\n{}\n{}",
            alarm.robotID,
            alarm.errorCode,
            alarm.planID.value_or(std::string()),
            alarm.jobID.value_or(std::string()));
        active.insert(key);
        alarms.push_back(MakeAlarmView(alarm, Note(_alarms, key, now)));
    }
    Forget(_alarms, active);
    return alarms;
}

std::vector<RobotView> StateViewMaker::MakeRobots(const ProgramState& program) const
{
    const std::vector<Planning::RobotStatus> statuses = _engine.GetRobotStatuses();
    std::vector<RobotView> robots;
    robots.reserve(statuses.size());
    std::map<std::string_view, RobotView*> byID;
    for (const Planning::RobotStatus& status : statuses)
    {
        RobotView& robot = robots.emplace_back(MakeRobotView(status));
        byID.emplace(status.robotID, &robot);
        if (const auto link = program.robots.find(status.robotID); link != program.robots.end())
        {
            AddDetails(robot, link->second);
        }
    }
    for (const Planning::RobotPose& pose : _engine.GetRobotPoses())
    {
        RobotView& robot = *byID.at(pose.robotID);
        robot.pose = PoseView{Round(pose.x), Round(pose.y), RoundAngle(pose.theta)};
        robot.battery = std::lround(std::clamp(pose.batteryPercent, 0.0, FULL_PERCENT));
    }
    for (const Planning::RobotDetail& detail : _engine.GetRobotDetails())
    {
        RobotView& robot = *byID.at(detail.robotID);
        robot.nodeID = TextOrNull(detail.nodeID);
        robot.nextNodeID = robot.nodeID.has_value() ? detail.nextNodeID : std::nullopt;
    }
    for (Planning::RobotRoute& route : _engine.GetRobotRoutes())
    {
        RobotView& robot = *byID.at(route.robotID);
        robot.reservedNodeIDs = std::move(route.reservedNodeIDs);
        for (Planning::RouteNodeAhead& node : route.nodes)
        {
            robot.route.push_back({std::move(node.nodeID), node.bReserved});
        }
    }
    return robots;
}

} // namespace ACS::Acsd
