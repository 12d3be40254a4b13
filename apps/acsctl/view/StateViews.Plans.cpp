#include "view/StateViews.hpp"

#include "view/AgeText.hpp"
#include "view/DetailList.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace ACS::Acsctl
{

namespace
{

constexpr int CUT_LATE = 1;
constexpr int CUT_EARLY = 2;
constexpr int CUT_FIRST = 3;

/// Number of steps begun; of a finished plan, number of steps done. Step numbers may have gaps.
std::string MakeStepText(const PlanInfo& plan)
{
    if (plan.steps.empty())
    {
        return plan.stepNo > 0 ? std::to_string(plan.stepNo) : "-";
    }
    const auto done = std::ranges::count_if(plan.steps, [](const StepInfo& step) {
        return step.status == "Completed" || step.status == "Skipped";
    });
    const auto begun = std::ranges::count_if(
        plan.steps,
        [&plan](std::int64_t stepNo) { return stepNo <= plan.stepNo; },
        &StepInfo::stepNo);
    return fmt::format("{}/{}", plan.endedAt.has_value() ? done : begun, plan.steps.size());
}

/// Why the plan makes no progress, or how it ended.
const std::string& GetReason(const PlanInfo& plan)
{
    return plan.waits.has_value() ? plan.waits->message : plan.message;
}

const std::optional<std::string>& GetTime(const PlanInfo& plan)
{
    return plan.endedAt.has_value() ? plan.endedAt : plan.acceptedAt;
}

std::string MakeNumber(const std::optional<std::int64_t>& numberOrNull)
{
    return numberOrNull.has_value() ? std::to_string(*numberOrNull) : "-";
}

void AddWaits(DetailList& details, const WaitsInfo& waits, Core::WallTime now)
{
    const std::string since = waits.since.has_value() ? fmt::format(" ({})", MakeAge(waits.since, now)) : std::string();
    details.Add("Waits", waits.message + since, EStyle::Warning);
    if (waits.queuePosition.has_value())
    {
        details.Add("Queue", fmt::format("position {}", *waits.queuePosition));
    }
    for (const RobotReason& robot : waits.robots)
    {
        details.Add("", fmt::format("{}: {}", robot.robotID, robot.reason));
    }
}

std::string MakeCarriers(const StepInfo& step)
{
    std::string text;
    for (const std::optional<std::string>& carrierOrNull : step.carrierIDs)
    {
        text.append(text.empty() ? "" : " ").append(carrierOrNull.value_or("-"));
    }
    return text;
}

std::string PrintSteps(const PlanInfo& plan, const Screen& screen)
{
    TextTable table(
        {{"STEP", 0, 4, true},
         {"STATUS", 0},
         {"ACTION", CUT_LATE, 8},
         {"POSITION", CUT_LATE, 8},
         {"JOB", CUT_EARLY},
         {"FROM", CUT_EARLY, 8},
         {"TO", CUT_EARLY, 8},
         {"CARRIERS", CUT_FIRST}});
    for (const StepInfo& step : plan.steps)
    {
        table.AddRow(
            {{std::to_string(step.stepNo)},
             {step.status, GetStyle(step.status)},
             {step.action},
             {step.position},
             {},
             {},
             {},
             {MakeCarriers(step)}});
        for (const JobInfo& job : step.jobs)
        {
            table.AddRow(
                {{},
                 {job.status, GetStyle(job.status)},
                 {},
                 {},
                 {job.jobID},
                 {job.from.value_or("")},
                 {job.to.value_or("")}});
        }
    }
    return table.Print(screen);
}

} // namespace

std::string PrintPlans(const std::vector<PlanInfo>& plans, const ViewContext& context)
{
    if (plans.empty())
    {
        return "No such plan.\n";
    }
    const bool bLots =
        std::ranges::any_of(plans, [](const PlanInfo& plan) { return !plan.lotID.value_or("").empty(); });
    constexpr std::size_t REASON = 16;
    std::vector<TextTable::Column> columns{
        {"PLAN", CUT_LATE, 8},
        {"STATUS", 0},
        {"ROBOT", CUT_LATE},
        {"STEP", 0, 4, true},
        {"PRIO", 0, 4, true},
        {"AGE", 0, 4, true}};
    if (bLots)
    {
        columns.push_back({"LOT", CUT_EARLY});
    }
    columns.push_back({"REASON", CUT_FIRST, REASON});
    TextTable table(std::move(columns));
    for (const PlanInfo& plan : plans)
    {
        TextTable::Row row{
            {plan.planID},
            {plan.status, GetStyle(plan.status)},
            {plan.robotID.value_or("-")},
            {MakeStepText(plan)},
            {MakeNumber(plan.priority)},
            {MakeAge(GetTime(plan), context.now)}};
        if (bLots)
        {
            row.push_back({plan.lotID.value_or("")});
        }
        row.push_back({GetReason(plan), plan.waits.has_value() ? EStyle::Warning : EStyle::Plain});
        table.AddRow(std::move(row));
    }
    return table.Print(context.screen);
}

std::string PrintPlan(const PlanInfo& plan, const ViewContext& context)
{
    DetailList details;
    details.Add("Plan", plan.planID);
    details.AddIfAny("Lot", plan.lotID.value_or(""));
    details.Add("Status", plan.status, GetStyle(plan.status));
    details.Add("Robot", plan.robotID.value_or("-"));
    details.Add("Priority", MakeNumber(plan.priority));
    details.Add("Step", MakeStepText(plan));
    details.AddIfAny("Job", plan.jobID.value_or(""));
    details.AddIfAny("Action", plan.currentAction.value_or(""));
    details.AddIfAny("Accepted", plan.acceptedAt.value_or(""));
    details.AddIfAny("Started", plan.startedAt.value_or(""));
    details.AddIfAny("Ended", plan.endedAt.value_or(""));
    details.AddIfAny("Message", plan.message);
    if (plan.waits.has_value())
    {
        AddWaits(details, *plan.waits, context.now);
    }
    std::string out = details.Print(context.screen);
    if (!plan.steps.empty())
    {
        out += '\n';
        out += PrintSteps(plan, context.screen);
    }
    return out;
}

} // namespace ACS::Acsctl
