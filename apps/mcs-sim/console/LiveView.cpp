#include "console/LiveView.hpp"

#include "console/CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ACS::McsSim
{

using Protocol::ERobotStatus;

namespace
{

constexpr std::size_t MIN_COLUMNS = 40;
constexpr std::size_t MIN_ROWS = 8;
constexpr std::size_t FREE_COLUMNS = 1; ///< A screen leaves the last one empty.
constexpr std::size_t FRAME_ROWS = 7;   ///< Heading, two table heads, empty lines, the count, and the cursor's own.
constexpr std::size_t MIN_PLAN_ROWS = 2;

constexpr std::size_t ROBOT_COLUMNS = 6;
constexpr std::size_t TYPE_COLUMNS = 5;
constexpr std::size_t ROBOT_STATUS_COLUMNS = 13;
constexpr std::size_t PLACE_COLUMNS = 10;
constexpr std::size_t POINT_COLUMNS = 10;
constexpr std::size_t BATTERY_COLUMNS = 6;
constexpr std::size_t SHORT_ID_COLUMNS = 10;
constexpr std::size_t SHARE_COLUMNS = 4;

constexpr std::size_t MIN_ID_COLUMNS = 8;
constexpr std::size_t MAX_ID_COLUMNS = 24;
constexpr std::size_t PLAN_STATUS_COLUMNS = 11;
constexpr std::size_t STEP_COLUMNS = 5;
constexpr std::size_t ACTION_COLUMNS = 19;
constexpr std::size_t JOB_COLUMNS = 5;
constexpr std::size_t PERCENT_COLUMNS = 6;
constexpr std::size_t MIN_BAR_COLUMNS = 5;
constexpr std::size_t MAX_BAR_COLUMNS = 40;
/// A plan's line without its id and its bar.
constexpr std::size_t PLAN_COLUMNS = 1 + ROBOT_COLUMNS + PLAN_STATUS_COLUMNS + STEP_COLUMNS + ACTION_COLUMNS
    + JOB_COLUMNS + PERCENT_COLUMNS + FREE_COLUMNS;

EStyle GetStyle(const TrackedPlan& plan)
{
    switch (GetOutcome(plan))
    {
        case EOutcome::Open:
            return plan.bReported ? EStyle::Active : EStyle::Dim;
        case EOutcome::Completed:
            return EStyle::Good;
        case EOutcome::Failed:
        case EOutcome::Cancelled:
        case EOutcome::Aborted:
        case EOutcome::Refused:
            return EStyle::Bad;
        default:
            assert(false);
            return EStyle::Plain;
    }
}

EStyle GetStyle(ERobotStatus status)
{
    switch (status)
    {
        case ERobotStatus::Moving:
        case ERobotStatus::Arrival:
        case ERobotStatus::Docking:
        case ERobotStatus::UnDocking:
        case ERobotStatus::Working:
            return EStyle::Active;
        case ERobotStatus::Disconnected:
        case ERobotStatus::Error:
        case ERobotStatus::Stopped:
            return EStyle::Bad;
        case ERobotStatus::Idle:
        case ERobotStatus::Charging:
            return EStyle::Good;
        case ERobotStatus::Init:
        case ERobotStatus::Manual:
            return EStyle::Dim;
        default:
            assert(false);
            return EStyle::Plain;
    }
}

std::string DescribeStatus(const TrackedPlan& plan)
{
    switch (plan.delivery)
    {
        case EDelivery::Refused:
            return "Refused";
        case EDelivery::Blocked:
            return "Blocked";
        case EDelivery::Waiting:
            return plan.bReported ? std::string(GetText(plan.status)) : "Waiting";
        case EDelivery::Sent:
            return plan.bReported ? std::string(GetText(plan.status)) : "Sent";
        case EDelivery::Accepted:
            return std::string(GetText(plan.status));
        default:
            assert(false);
            return "";
    }
}

/// "1/2", or a dash where there are none.
std::string MakeShare(std::size_t index, std::size_t count)
{
    return count == 0 ? "–" : fmt::format("{}/{}", index + 1, count);
}

/// Plans differ in the end of a long planId.
std::string ShortenID(const std::string& planID, std::size_t columns)
{
    const std::string clean = CleanText(planID);
    const std::size_t length = GetColumns(clean);
    if (length <= columns || length != clean.size())
    {
        return CutText(clean, columns);
    }
    return "…" + clean.substr(clean.size() - (columns - 1));
}

/// What a robot works on: plan, step and job.
struct Work
{
    std::string plan = "–";
    std::string step;
    std::string job;
};

Work DescribeWork(const PlanTracker& tracker, const Protocol::RobotStatusUpdate& status)
{
    Work work;
    if (!status.planID.has_value())
    {
        return work;
    }
    work.plan = ShortenID(*status.planID, SHORT_ID_COLUMNS - 1);
    work.step = status.stepNo.has_value() ? fmt::format("{}", *status.stepNo) : "";
    const TrackedPlan* const planOrNull = tracker.FindPlanOrNull(*status.planID);
    if (planOrNull == nullptr || !status.stepNo.has_value())
    {
        return work;
    }
    const std::vector<TrackedStep>& steps = planOrNull->steps;
    const auto step = std::find_if(steps.begin(), steps.end(), [&status](const TrackedStep& other) {
        return other.stepNo == *status.stepNo;
    });
    if (step == steps.end())
    {
        return work;
    }
    work.step = MakeShare(static_cast<std::size_t>(step - steps.begin()), steps.size());
    const auto job = std::find_if(step->jobs.begin(), step->jobs.end(), [&status](const TrackedJob& other) {
        return other.jobID == status.jobID;
    });
    if (job != step->jobs.end())
    {
        work.job = MakeShare(static_cast<std::size_t>(job - step->jobs.begin()), step->jobs.size());
    }
    return work;
}

/// Robots without a status keep their columns.
void AddStatus(const RobotEntry& robot, StyledLine& line)
{
    if (!robot.status.has_value())
    {
        line.push_back({FitText("", TYPE_COLUMNS + ROBOT_STATUS_COLUMNS + PLACE_COLUMNS), EStyle::Plain});
        return;
    }
    const Protocol::RobotStatusUpdate& status = *robot.status;
    line.push_back({FitText(GetText(status.robotType), TYPE_COLUMNS), EStyle::Plain});
    line.push_back({FitText(GetText(status.robotStatus), ROBOT_STATUS_COLUMNS), GetStyle(status.robotStatus)});
    line.push_back({FitText(CleanText(status.position.value_or("–")), PLACE_COLUMNS - 1) + " ", EStyle::Plain});
}

StyledLine MakeRobotLine(const PlanTracker& tracker, const std::string& robotID, const RobotEntry& robot)
{
    StyledLine line{{" " + FitText(CleanText(robotID), ROBOT_COLUMNS - 1) + " ", EStyle::Bold}};
    AddStatus(robot, line);
    const bool bPosition = robot.position.has_value();
    const std::string point = bPosition ? fmt::format("{:.1f},{:5.1f}", robot.position->x, robot.position->y) : "";
    const std::string battery = bPosition ? fmt::format("{:.0f} %", robot.position->battery) : "";
    line.push_back({FitRight(point, POINT_COLUMNS), EStyle::Dim});
    line.push_back({FitRight(battery, BATTERY_COLUMNS) + "  ", EStyle::Plain});
    if (robot.status.has_value())
    {
        const Work work = DescribeWork(tracker, *robot.status);
        line.push_back(
            {FitText(work.plan, SHORT_ID_COLUMNS) + FitText(work.step, SHARE_COLUMNS) + " "
                 + FitText(work.job, SHARE_COLUMNS),
             EStyle::Plain});
        line.push_back({DescribeCarriers(*robot.status), EStyle::Plain});
    }
    return line;
}

/// Those that are being worked on, then those that failed, then what waits, then what is done.
int GetRank(const TrackedPlan& plan)
{
    switch (GetOutcome(plan))
    {
        case EOutcome::Open:
            return plan.bReported ? 0 : 2;
        case EOutcome::Completed:
            return 3;
        case EOutcome::Failed:
        case EOutcome::Cancelled:
        case EOutcome::Aborted:
        case EOutcome::Refused:
            return 1;
        default:
            assert(false);
            return 3;
    }
}

/// The plans to show, in the order in which they were sent.
std::vector<std::size_t> ChoosePlans(const std::vector<TrackedPlan>& plans, std::size_t most)
{
    std::vector<std::size_t> chosen(plans.size());
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
        chosen[i] = i;
    }
    std::stable_sort(chosen.begin(), chosen.end(), [&plans](std::size_t left, std::size_t right) {
        return GetRank(plans[left]) < GetRank(plans[right]);
    });
    chosen.resize(std::min(chosen.size(), most));
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

StyledLine MakeHeading(const PlanTracker& tracker, const ViewHeading& heading)
{
    std::string state = heading.bRegistered ? "ACS registered" : "waiting for the ACS";
    state = heading.bKept ? "all is finished, Ctrl-C ends" : state;
    StyledLine line{
        {" MCS ", EStyle::Bold},
        {CleanText(heading.address), EStyle::Dim},
        {"   " + state, heading.bRegistered ? EStyle::Good : EStyle::Bad},
        {fmt::format("   {}/{} plans completed", tracker.CountOutcome(EOutcome::Completed), tracker.GetPlans().size()),
         EStyle::Plain}};
    if (tracker.CountFailed() > 0)
    {
        line.push_back({fmt::format(", {} failed", tracker.CountFailed()), EStyle::Bad});
    }
    if (tracker.CountViolations() > 0)
    {
        line.push_back({fmt::format(", {} violations", tracker.CountViolations()), EStyle::Bad});
    }
    line.push_back({fmt::format("   {:.1f} s", static_cast<double>(heading.elapsed.count()) / 1000.0), EStyle::Dim});
    return line;
}

} // namespace

LiveView::LiveView(std::size_t columns, std::size_t rows)
    : _columns(std::max(columns, MIN_COLUMNS)),
      _rows(std::max(rows, MIN_ROWS))
{
}

StyledLines LiveView::Render(const PlanTracker& tracker, const RobotBoard& board, const ViewHeading& heading) const
{
    StyledLines lines;
    const std::size_t room = _rows - FRAME_ROWS;
    const std::size_t planRows = std::min({tracker.GetPlans().size(), MAX_PLANS, std::max(room, MIN_PLAN_ROWS)});
    const std::size_t reserved = std::min(planRows, room / 2);
    const std::size_t robotRows = std::min(board.GetRobots().size(), room - reserved);
    lines.push_back(MakeHeading(tracker, heading));
    lines.emplace_back();
    AddRobots(tracker, board, robotRows, lines);
    AddPlans(tracker, std::min(planRows, room - robotRows), lines);
    return lines;
}

void LiveView::AddRobots(const PlanTracker& tracker, const RobotBoard& board, std::size_t most, StyledLines& out)
{
    if (most == 0)
    {
        return;
    }
    out.push_back(
        {{" " + FitText("robot", ROBOT_COLUMNS) + FitText("type", TYPE_COLUMNS)
              + FitText("status", ROBOT_STATUS_COLUMNS) + FitText("at", PLACE_COLUMNS)
              + FitRight("x,    y", POINT_COLUMNS) + FitRight("batt", BATTERY_COLUMNS) + "  "
              + FitText("plan", SHORT_ID_COLUMNS) + FitText("step", SHARE_COLUMNS + 1) + FitText("job", SHARE_COLUMNS)
              + "carriers",
          EStyle::Dim}});
    for (const auto& [robotID, robot] : board.GetRobots())
    {
        if (most == 0)
        {
            break;
        }
        --most;
        out.push_back(MakeRobotLine(tracker, robotID, robot));
    }
    out.emplace_back();
}

void LiveView::AddPlans(const PlanTracker& tracker, std::size_t most, StyledLines& out) const
{
    const std::vector<TrackedPlan>& plans = tracker.GetPlans();
    const std::vector<std::size_t> chosen = ChoosePlans(plans, most);
    std::size_t idColumns = MIN_ID_COLUMNS;
    for (const std::size_t index : chosen)
    {
        idColumns = std::max(idColumns, GetColumns(CleanText(plans[index].planned.plan.planID)) + 1);
    }
    // A narrow terminal takes them from the ids: how far a plan has come must stay to be seen.
    const std::size_t others = PLAN_COLUMNS + MIN_BAR_COLUMNS;
    const std::size_t room = _columns > others ? _columns - others : 0;
    idColumns = std::min({idColumns, MAX_ID_COLUMNS, std::max(room, SHORT_ID_COLUMNS)});
    out.push_back(
        {{" " + FitText("plan", idColumns) + FitText("robot", ROBOT_COLUMNS) + FitText("status", PLAN_STATUS_COLUMNS)
              + FitText("step", STEP_COLUMNS) + FitText("action", ACTION_COLUMNS) + FitText("job", JOB_COLUMNS)
              + "progress",
          EStyle::Dim}});
    for (const std::size_t index : chosen)
    {
        out.push_back(MakePlanLine(plans[index], idColumns));
    }
    if (chosen.size() < plans.size())
    {
        const std::size_t completed = tracker.CountOutcome(EOutcome::Completed);
        out.push_back(
            {{fmt::format(
                  " {} of {} plans shown: {} completed, {} failed, {} to go",
                  chosen.size(),
                  plans.size(),
                  completed,
                  tracker.CountFailed(),
                  tracker.CountOutcome(EOutcome::Open)),
              EStyle::Dim}});
    }
}

StyledLine LiveView::MakePlanLine(const TrackedPlan& plan, std::size_t idColumns) const
{
    const EStyle style = GetStyle(plan);
    StyledLine line{
        {" " + FitText(ShortenID(plan.planned.plan.planID, idColumns - 1), idColumns - 1) + " ", EStyle::Plain},
        {FitText(CleanText(plan.robotID), ROBOT_COLUMNS - 1) + " ", EStyle::Bold},
        {FitText(DescribeStatus(plan), PLAN_STATUS_COLUMNS), style}};
    if (style == EStyle::Bad && !plan.reason.empty())
    {
        line.push_back({CleanText(plan.reason), EStyle::Plain});
        return line;
    }
    const std::size_t step = GetCurrentStep(plan);
    std::string action;
    std::string job = "–";
    if (step < plan.steps.size())
    {
        action = CleanText(plan.steps[step].action);
        job = MakeShare(GetCurrentJob(plan.steps[step]), plan.steps[step].jobs.size());
    }
    line.push_back(
        {FitText(MakeShare(step, plan.steps.size()), STEP_COLUMNS) + FitText(action, ACTION_COLUMNS - 1) + " "
             + FitText(job, JOB_COLUMNS),
         EStyle::Plain});
    const std::size_t used = PLAN_COLUMNS + idColumns;
    const std::size_t room = _columns > used ? _columns - used : 0;
    const double progress = GetProgress(plan);
    line.push_back({MakeBar(progress, std::clamp(room, MIN_BAR_COLUMNS, MAX_BAR_COLUMNS)), style});
    line.push_back({FitRight(fmt::format("{:.0f} %", std::floor(progress * 100.0)), PERCENT_COLUMNS), EStyle::Plain});
    return line;
}

std::string MakeBar(double fraction, std::size_t columns)
{
    const double exact = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(columns);
    const auto full = static_cast<std::size_t>(exact);
    std::string bar;
    for (std::size_t i = 0; i < columns; ++i)
    {
        bar += i < full ? "█" : "░";
    }
    return bar;
}

} // namespace ACS::McsSim
