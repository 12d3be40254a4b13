#include "model/PlanExecutor.hpp"

#include <acs/core/Location.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/RobotID.hpp>
#include <acs/core/Timestamp.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <variant>

namespace ACS::AcsSim
{

using Protocol::EAckResult;
using Protocol::EPlanStatus;
using Protocol::EReportResult;
using Protocol::ERobotStatus;
using Protocol::ERobotType;

namespace
{

constexpr std::size_t TRAY_PORTS = 3;

ERobotType GetType(std::string_view robotName)
{
    return robotName.starts_with("CR") ? ERobotType::Control : ERobotType::Logistics;
}

std::optional<ERobotType> GetTypeOrNull(std::string_view action)
{
    constexpr std::array<std::pair<std::string_view, ERobotType>, 8> TYPES{
        {{"CassetteLoad", ERobotType::Logistics},
         {"CassetteUnload", ERobotType::Logistics},
         {"TrayLoad", ERobotType::Control},
         {"MemoryPickAndPlace", ERobotType::Control},
         {"TrayUnload", ERobotType::Control},
         {"CloseSetCover", ERobotType::Control},
         {"OpenSetCover", ERobotType::Control},
         {"Start", ERobotType::Control}}};
    const auto* const found = std::ranges::find(TYPES, action, &std::pair<std::string_view, ERobotType>::first);
    return found == TYPES.end() ? std::nullopt : std::optional(found->second);
}

/// The robot that a location names; nullopt: it is fixed, or names the alias.
std::optional<std::string> FindNamedRobotOrNull(const std::string& place)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(place);
    if (!location.has_value() || !location->GetRobotOrNull().has_value() || location->GetRobotOrNull()->IsAlias())
    {
        return std::nullopt;
    }
    return std::string(location->GetRobotOrNull()->GetText());
}

std::set<std::string> FindNamedRobots(const Protocol::ExecutionPlan& plan)
{
    std::set<std::string> names;
    for (const Protocol::PlanStep& step : plan.steps)
    {
        for (const Protocol::PlanJob& job : step.jobs)
        {
            for (const std::string* const place : {&job.from, &job.to})
            {
                const std::optional<std::string> name = FindNamedRobotOrNull(*place);
                if (name.has_value())
                {
                    names.insert(*name);
                }
            }
        }
    }
    return names;
}

SendAnswer MakeAnswer(
    const Protocol::AcsRequest& request,
    EAckResult result,
    std::string message,
    Protocol::AckPayload payload)
{
    return {GetCommand(request), request.transactionID, result, std::move(message), std::move(payload)};
}

} // namespace

PlanExecutor::PlanExecutor(Options options)
    : _options(std::move(options))
{
    for (const std::string& name : _options.robots)
    {
        RobotModel robot;
        robot.name = name;
        robot.type = GetType(name);
        robot.carriers.resize(robot.type == ERobotType::Control ? TRAY_PORTS : 1);
        _robots.push_back(std::move(robot));
    }
}

void PlanExecutor::Report(ExecutorActions& out) const
{
    out.emplace_back(SendStatus{Protocol::TscStateUpdate{Protocol::ETscState::Auto}});
    out.emplace_back(SendStatus{Protocol::AcsCommStateUpdate{true}});
    for (const RobotModel& robot : _robots)
    {
        out.emplace_back(SendStatus{MakeStatus(robot)});
    }
}

std::optional<Core::SteadyTime> PlanExecutor::GetNextDueOrNull() const
{
    std::optional<Core::SteadyTime> next;
    for (const RobotModel& robot : _robots)
    {
        if (robot.work.has_value() && !robot.work->bPaused && (!next.has_value() || robot.work->due < *next))
        {
            next = robot.work->due;
        }
    }
    return next;
}

Protocol::RobotPositionUpdate PlanExecutor::MakePositions() const
{
    constexpr double BATTERY = 80.0;
    Protocol::RobotPositionUpdate update;
    for (const RobotModel& robot : _robots)
    {
        Protocol::RobotPosition& position = update.robots.emplace_back();
        position.robotID = robot.name;
        position.battery = BATTERY;
    }
    return update;
}

void PlanExecutor::RefuseNextPlan()
{
    _bRefuseNext = true;
}

void PlanExecutor::FailNextJob()
{
    _bFailNext = true;
}

std::size_t PlanExecutor::CountEnded() const
{
    return _ended;
}

// ---- requests: each is answered once, feasible or not

void PlanExecutor::OnRequest(const Protocol::AcsRequest& request, Core::Now now, ExecutorActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::ExecutionPlan& /*plan*/) { OnPlan(request, now, out); },
            [&](const Protocol::CancelPlan& control) {
                OnControl(request, control.planID, &PlanExecutor::Cancel, now, out);
            },
            [&](const Protocol::AbortPlan& control) {
                OnControl(request, control.planID, &PlanExecutor::Abort, now, out);
            },
            [&](const Protocol::PausePlan& control) {
                OnControl(request, control.planID, &PlanExecutor::Pause, now, out);
            },
            [&](const Protocol::ResumePlan& control) {
                OnControl(request, control.planID, &PlanExecutor::Resume, now, out);
            },
            [&](const Protocol::RequestAcsPlans& /*query*/) { OnPlansQuery(request, out); },
            [&](const Protocol::RequestAcsPlanHistory& query) { OnHistory(request, query, out); },
            [&](const Protocol::RequestAcsErrorList& /*query*/) {
                out.emplace_back(MakeAnswer(request, EAckResult::Success, "", Protocol::ErrorListAck{}));
            },
            [&](const auto& /*other*/) {
                out.emplace_back(MakeAnswer(request, EAckResult::Fail, "not supported", Protocol::EmptyAck{}));
            }},
        request.payload);
}

bool PlanExecutor::CanExecute(const RobotModel& robot, const Protocol::ExecutionPlan& plan)
{
    const std::set<std::string> named = FindNamedRobots(plan);
    return GetTypeOrNull(plan.steps.front().action) == robot.type
        && (named.empty() || (named.size() == 1 && named.contains(robot.name)));
}

std::optional<std::string> PlanExecutor::GetRejectionReasonOrNull(const Protocol::ExecutionPlan& plan) const
{
    std::set<std::int32_t> numbers;
    std::set<std::string_view> jobs;
    for (const Protocol::PlanStep& step : plan.steps)
    {
        if (GetTypeOrNull(step.action) != GetTypeOrNull(plan.steps.front().action)
            || !GetTypeOrNull(step.action).has_value())
        {
            return "unknown action, or actions of both robot types";
        }
        const bool bJobsNew = std::ranges::all_of(step.jobs, [&jobs](const Protocol::PlanJob& job) {
            return jobs.insert(job.jobID).second;
        });
        if (step.stepNo < 1 || !numbers.insert(step.stepNo).second || !bJobsNew)
        {
            return "a stepNo or jobId is invalid or used twice";
        }
    }
    if (_bRefuseNext || _waiting.size() >= _options.maximumQueued)
    {
        return "Queue Full";
    }
    if (_entries.contains(plan.planID))
    {
        return "Duplicated Plan";
    }
    const bool bExecutable =
        std::ranges::any_of(_robots, [&plan](const RobotModel& robot) { return CanExecute(robot, plan); });
    return bExecutable ? std::nullopt : std::optional<std::string>("no robot can execute the plan");
}

void PlanExecutor::OnPlan(const Protocol::AcsRequest& request, Core::Now now, ExecutorActions& out)
{
    const auto& plan = std::get<Protocol::ExecutionPlan>(request.payload);
    const std::optional<std::string> reason = GetRejectionReasonOrNull(plan);
    _bRefuseNext = false;
    out.emplace_back(MakeAnswer(
        request,
        reason.has_value() ? EAckResult::Fail : EAckResult::Success,
        reason.value_or(""),
        Protocol::PlanAck{plan.planID}));
    if (reason.has_value())
    {
        return;
    }
    Protocol::ExecutionPlan& queued = _waiting.emplace_back(plan);
    std::ranges::sort(queued.steps, {}, &Protocol::PlanStep::stepNo);
    Protocol::PlanEntry& entry = _entries[plan.planID];
    entry.planID = plan.planID;
    const Protocol::PlanStep& first = queued.steps.front();
    entry.stepNo = first.stepNo;
    entry.currentAction = first.action;
    if (!first.jobs.empty())
    {
        entry.jobID = first.jobs.front().jobID;
    }
    entry.startTime = Core::Timestamp{now.wall, _options.siteOffset};
    StartPlans(now, out);
}

void PlanExecutor::OnControl(
    const Protocol::AcsRequest& request,
    const std::string& planID,
    Control control,
    Core::Now now,
    ExecutorActions& out)
{
    const bool bKnown = _entries.contains(planID);
    out.emplace_back(MakeAnswer(
        request,
        bKnown ? EAckResult::Success : EAckResult::Fail,
        bKnown ? "" : "unknown plan",
        Protocol::PlanAck{planID}));
    (this->*control)(planID, now, out);
}

void PlanExecutor::OnPlansQuery(const Protocol::AcsRequest& request, ExecutorActions& out) const
{
    Protocol::PlanListAck list;
    for (const auto& [planID, entry] : _entries)
    {
        if (!IsFinal(entry.status))
        {
            list.plans.push_back(entry);
        }
    }
    out.emplace_back(MakeAnswer(request, EAckResult::Success, "", std::move(list)));
}

void PlanExecutor::OnHistory(
    const Protocol::AcsRequest& request,
    const Protocol::RequestAcsPlanHistory& query,
    ExecutorActions& out) const
{
    Protocol::PlanListAck list;
    for (const std::string& planID : query.planIDs)
    {
        const auto found = _entries.find(planID);
        if (found != _entries.end())
        {
            list.plans.push_back(found->second);
        }
    }
    out.emplace_back(MakeAnswer(request, EAckResult::Success, "", std::move(list)));
}

// ---- controls

/// Until the robot has arrived for the first time.
void PlanExecutor::Cancel(const std::string& planID, Core::Now now, ExecutorActions& out)
{
    const RobotModel* const robotOrNull = FindRobotOrNull(planID);
    const bool bBeforeArrival =
        robotOrNull != nullptr && robotOrNull->work->step == 0 && !robotOrNull->work->job.has_value();
    if (!bBeforeArrival && !TryForgetWaiting(planID))
    {
        out.emplace_back(SendReport{Protocol::CancelResultReport{
            planID,
            EReportResult::Failed,
            "the robot has arrived, or there is no such plan"}});
        return;
    }
    if (_entries.at(planID).status == EPlanStatus::Paused) // Section 6.12 has no way from Paused to Cancelled.
    {
        SetPlan(planID, robotOrNull == nullptr ? EPlanStatus::Pending : EPlanStatus::InProgress, now, out);
    }
    SetPlan(planID, EPlanStatus::Cancelled, now, out);
    out.emplace_back(SendReport{Protocol::CancelResultReport{planID, EReportResult::Success, ""}});
    Leave(planID, now, out);
}

/// A job in progress is completed.
void PlanExecutor::Abort(const std::string& planID, Core::Now now, ExecutorActions& out)
{
    RobotModel* const robotOrNull = FindRobotOrNull(planID);
    if (robotOrNull != nullptr && robotOrNull->work->job.has_value() && !robotOrNull->work->bPaused)
    {
        ++robotOrNull->work->aborts;
    }
    else if (robotOrNull != nullptr || TryForgetWaiting(planID))
    {
        FinishAbort(planID, 1, now, out);
    }
    else
    {
        out.emplace_back(
            SendReport{Protocol::AbortResultReport{planID, EReportResult::Failed, "there is no such active plan"}});
    }
}

void PlanExecutor::FinishAbort(const std::string& planID, std::size_t aborts, Core::Now now, ExecutorActions& out)
{
    SetPlan(planID, EPlanStatus::Aborted, now, out);
    ReportAborts(planID, aborts, EReportResult::Success, out);
    Leave(planID, now, out);
}

void PlanExecutor::ReportAborts(
    const std::string& planID,
    std::size_t aborts,
    EReportResult result,
    ExecutorActions& out)
{
    const std::string message = result == EReportResult::Success ? "" : "the job has failed";
    for (std::size_t i = 0; i < aborts; ++i)
    {
        out.emplace_back(SendReport{Protocol::AbortResultReport{planID, result, message}});
    }
}

void PlanExecutor::Pause(const std::string& planID, Core::Now now, ExecutorActions& out)
{
    RobotModel* const robotOrNull = FindRobotOrNull(planID);
    const bool bAborting = robotOrNull != nullptr && robotOrNull->work->aborts > 0;
    if (bAborting || (robotOrNull == nullptr && !IsWaiting(planID)))
    {
        out.emplace_back(SendReport{Protocol::PauseResultReport{
            planID,
            EReportResult::Failed,
            "the plan is aborted, or there is no such active plan"}});
        return;
    }
    if (_entries.at(planID).status != EPlanStatus::Paused) // A second pause succeeds without reports (D-21).
    {
        if (robotOrNull != nullptr)
        {
            RobotWork& work = *robotOrNull->work;
            work.remaining = std::max(work.due - now.steady, Core::Duration{});
            work.bPaused = true;
            SetRobot(*robotOrNull, ERobotStatus::Stopped, out);
        }
        SetPlan(planID, EPlanStatus::Paused, now, out);
    }
    out.emplace_back(SendReport{Protocol::PauseResultReport{planID, EReportResult::Success, ""}});
}

void PlanExecutor::Resume(const std::string& planID, Core::Now now, ExecutorActions& out)
{
    const auto entry = _entries.find(planID);
    if (entry == _entries.end() || entry->second.status != EPlanStatus::Paused)
    {
        out.emplace_back(
            SendReport{Protocol::ResumeResultReport{planID, EReportResult::Failed, "the plan is not paused"}});
        return;
    }
    RobotModel* const robotOrNull = FindRobotOrNull(planID);
    if (robotOrNull == nullptr)
    {
        SetPlan(planID, EPlanStatus::Pending, now, out);
        out.emplace_back(SendReport{Protocol::ResumeResultReport{planID, EReportResult::Success, ""}});
        StartPlans(now, out);
        return;
    }
    RobotWork& work = *robotOrNull->work;
    work.bPaused = false;
    work.due = now.steady + work.remaining;
    SetRobot(*robotOrNull, work.job.has_value() ? ERobotStatus::Working : ERobotStatus::Moving, out);
    SetPlan(planID, EPlanStatus::InProgress, now, out);
    out.emplace_back(SendReport{Protocol::ResumeResultReport{planID, EReportResult::Success, ""}});
}

} // namespace ACS::AcsSim
