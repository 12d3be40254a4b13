#include "Summary.hpp"

#include "CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace ACS::McsSim
{

using Protocol::CommandCounters;
using Protocol::EAcsCommand;

namespace
{

constexpr std::size_t LABEL_COLUMNS = 24;
constexpr std::size_t NUMBER_COLUMNS = 14;
constexpr std::size_t RULE_COLUMNS = LABEL_COLUMNS + 1 + 3 * NUMBER_COLUMNS;
constexpr std::size_t MAX_FAILURES = 20;

StyledLine MakeRule()
{
    std::string rule = " ";
    for (std::size_t i = 1; i < RULE_COLUMNS; ++i)
    {
        rule += "─";
    }
    return {{rule, EStyle::Dim}};
}

StyledLine MakeRow(std::string_view label, const std::string& text, EStyle style)
{
    return {{" " + FitText(label, LABEL_COLUMNS), EStyle::Plain}, {text, style}};
}

StyledLine MakeNumbers(
    std::string_view label,
    const std::string& first,
    const std::string& second,
    const std::string& third,
    EStyle style)
{
    return {
        {" " + FitText(label, LABEL_COLUMNS) + FitRight(first, NUMBER_COLUMNS) + FitRight(second, NUMBER_COLUMNS)
             + FitRight(third, NUMBER_COLUMNS),
         style}};
}

std::string MakeOutcomes(const PlanTracker& tracker)
{
    std::string text = fmt::format("{} completed", tracker.CountOutcome(EOutcome::Completed));
    for (const EOutcome outcome :
         {EOutcome::Failed, EOutcome::Cancelled, EOutcome::Aborted, EOutcome::Refused, EOutcome::Open})
    {
        const std::size_t count = tracker.CountOutcome(outcome);
        if (count > 0 || outcome == EOutcome::Failed)
        {
            text += fmt::format(", {} {}", count, GetText(outcome));
        }
    }
    return text;
}

std::string MakeDone(const DoneCount& count)
{
    return fmt::format("{} of {} completed", count.done, count.all);
}

void AddMessages(const PlanTracker& tracker, const Protocol::SessionStatistics& statistics, StyledLines& out)
{
    out.push_back(MakeNumbers("message to the ACS", "sent", "acknowledged", "sent again", EStyle::Dim));
    const CommandCounters& plans = statistics.Of(EAcsCommand::ExecutionPlan);
    const std::size_t resends = tracker.CountResends();
    out.push_back(MakeNumbers(
        GetText(EAcsCommand::ExecutionPlan),
        fmt::format("{}", plans.sent - std::min<std::uint64_t>(plans.sent, resends)),
        fmt::format("{}", plans.answered),
        fmt::format("{}", resends),
        EStyle::Plain));
    out.emplace_back();
    out.push_back(MakeNumbers("message from the ACS", "received", "acknowledged", "sent again", EStyle::Dim));
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        const CommandCounters& counters = statistics.Of(command);
        if (IsSentByMcs(command) || counters.received == 0)
        {
            continue;
        }
        // A message that came twice was answered twice, and counts once.
        const std::uint64_t answered = counters.acknowledged - std::min(counters.acknowledged, counters.duplicates);
        out.push_back(MakeNumbers(
            GetText(command),
            fmt::format("{}", counters.received - counters.duplicates),
            HasAck(command) ? fmt::format("{}", answered) : "–",
            HasAck(command) ? fmt::format("{}", counters.duplicates) : "–",
            EStyle::Plain));
    }
}

void AddFailures(const PlanTracker& tracker, StyledLines& out)
{
    std::size_t shown = 0;
    for (const TrackedPlan& plan : tracker.GetPlans())
    {
        const EOutcome outcome = GetOutcome(plan);
        if (outcome == EOutcome::Open || outcome == EOutcome::Completed || shown >= MAX_FAILURES)
        {
            continue;
        }
        ++shown;
        out.push_back(
            {{fmt::format(" {} {}", CleanText(plan.planned.plan.planID), GetText(outcome)), EStyle::Bad},
             {plan.reason.empty() ? "" : ": " + CleanText(plan.reason), EStyle::Plain}});
    }
    for (const std::string& violation : tracker.GetViolations())
    {
        out.push_back({{" violation: ", EStyle::Bad}, {violation, EStyle::Plain}});
    }
    if (tracker.CountViolations() > tracker.GetViolations().size())
    {
        out.push_back(
            {{fmt::format(" and {} violations more", tracker.CountViolations() - tracker.GetViolations().size()),
              EStyle::Bad}});
    }
}

} // namespace

StyledLines MakeSummary(
    const PlanTracker& tracker,
    const Protocol::SessionStatistics& statistics,
    std::chrono::milliseconds duration)
{
    const bool bAllCompleted = tracker.CountOutcome(EOutcome::Completed) == tracker.GetPlans().size();
    const bool bViolated = tracker.CountViolations() > 0;
    const std::uint64_t reconnects = statistics.registrations > 0 ? statistics.registrations - 1 : 0;
    StyledLines lines{MakeRule()};
    lines.push_back(MakeRow("plans", MakeOutcomes(tracker), bAllCompleted ? EStyle::Good : EStyle::Bad));
    lines.push_back(MakeRow("steps", MakeDone(tracker.CountSteps()), EStyle::Plain));
    lines.push_back(MakeRow("jobs", MakeDone(tracker.CountJobs()), EStyle::Plain));
    lines.push_back(
        MakeRow("violations", fmt::format("{}", tracker.CountViolations()), bViolated ? EStyle::Bad : EStyle::Plain));
    lines.push_back(MakeRow("reconnects", fmt::format("{}", reconnects), EStyle::Plain));
    lines.push_back(
        MakeRow("duration", fmt::format("{:.1f} s", static_cast<double>(duration.count()) / 1000.0), EStyle::Plain));
    lines.emplace_back();
    AddMessages(tracker, statistics, lines);
    lines.push_back(MakeRule());
    AddFailures(tracker, lines);
    return lines;
}

std::string MakeLastLine(const PlanTracker& tracker)
{
    return fmt::format(
        "{} plans completed, {} failed",
        tracker.CountOutcome(EOutcome::Completed),
        tracker.CountFailed());
}

} // namespace ACS::McsSim
