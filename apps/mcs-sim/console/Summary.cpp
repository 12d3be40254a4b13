#include "console/Summary.hpp"

#include "console/CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ACS::McsSim
{

using Protocol::CommandCounters;
using Protocol::EAcsCommand;

namespace
{

constexpr std::size_t LABEL_COLUMNS = 24;
constexpr std::size_t NUMBER_COLUMNS = 13;
constexpr std::size_t RULE_COLUMNS = LABEL_COLUMNS + 1 + 4 * NUMBER_COLUMNS;
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

StyledLine MakeNumbers(std::string_view label, const std::vector<std::string>& numbers, EStyle style)
{
    std::string text = " " + FitText(label, LABEL_COLUMNS);
    for (const std::string& number : numbers)
    {
        text += FitRight(number, NUMBER_COLUMNS);
    }
    return {{std::move(text), style}};
}

std::string MakeDifference(std::uint64_t all, std::uint64_t others)
{
    return fmt::format("{}", all - std::min(all, others));
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
    out.push_back(MakeNumbers("message to the ACS", {"sent", "acknowledged", "sent again"}, EStyle::Dim));
    const CommandCounters& plans = statistics.Of(EAcsCommand::ExecutionPlan);
    const std::size_t resends = tracker.CountResends();
    out.push_back(MakeNumbers(
        GetText(EAcsCommand::ExecutionPlan),
        {MakeDifference(plans.sent, resends), fmt::format("{}", plans.answered), fmt::format("{}", resends)},
        EStyle::Plain));
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        const CommandCounters& counters = statistics.Of(command);
        if (command != EAcsCommand::ExecutionPlan && IsSentByMCS(command) && counters.sent > 0)
        {
            // Nothing but a plan is ever sent again.
            out.push_back(MakeNumbers(
                GetText(command),
                {fmt::format("{}", counters.sent), fmt::format("{}", counters.answered), "–"},
                EStyle::Plain));
        }
    }
    out.emplace_back();
    out.push_back(
        MakeNumbers("message from the ACS", {"received", "acknowledged", "sent again", "refused"}, EStyle::Dim));
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        const CommandCounters& counters = statistics.Of(command);
        if (IsSentByMCS(command) || counters.received == 0)
        {
            continue;
        }
        // A message that came twice was answered twice, and counts once; one that was refused was none.
        const std::uint64_t others = counters.duplicates + counters.refused;
        const std::string received = MakeDifference(counters.received, others);
        out.push_back(
            HasAck(command) ? MakeNumbers(
                GetText(command),
                {received,
                 MakeDifference(counters.acknowledged, others),
                 fmt::format("{}", counters.duplicates),
                 fmt::format("{}", counters.refused)},
                counters.refused > 0 ? EStyle::Bad : EStyle::Plain)
                            : MakeNumbers(GetText(command), {received, "–", "–", "–"}, EStyle::Plain));
    }
}

StyledLine MakeNote(std::uint64_t count, std::string_view meaning, EStyle style)
{
    return {{fmt::format(" {} {}", FitRight(fmt::format("{}", count), 6), meaning), style}};
}

void AddNotes(
    const NoteCounts& notes,
    const TimestampCounts& timestamps,
    std::uint64_t missingMembers,
    StyledLines& out)
{
    StyledLines rows;
    for (std::size_t i = 0; i < Protocol::NOTE_COUNT; ++i)
    {
        const auto note = static_cast<Protocol::EProtocolNote>(i);
        if (notes[i] > 0)
        {
            const EStyle style = GetBlame(note) == EBlame::Deviation ? EStyle::Plain : EStyle::Bad;
            rows.push_back(MakeNote(notes[i], GetMeaning(note), style));
        }
    }
    for (std::size_t i = 0; i < TIMESTAMP_DEVIATION_COUNT; ++i)
    {
        if (timestamps[i] > 0)
        {
            rows.push_back(MakeNote(timestamps[i], GetMeaning(static_cast<ETimestampDeviation>(i)), EStyle::Plain));
        }
    }
    if (missingMembers > 0)
    {
        rows.push_back(MakeNote(missingMembers, "required member left out", EStyle::Plain));
    }
    if (!rows.empty())
    {
        out.emplace_back();
        out.push_back({{" noticed in what the ACS sent", EStyle::Dim}});
        out.insert(out.end(), rows.begin(), rows.end());
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
    const NoteCounts& notes,
    const TimestampCounts& timestamps,
    std::uint64_t missingMembers,
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
    AddNotes(notes, timestamps, missingMembers, lines);
    lines.push_back(MakeRule());
    AddFailures(tracker, lines);
    return lines;
}

std::vector<std::string> DescribePlans(const PlanTracker& tracker)
{
    std::vector<std::string> lines;
    for (const TrackedPlan& plan : tracker.GetPlans())
    {
        lines.push_back(fmt::format(
            "{} {}{}{}",
            CleanText(plan.planned.plan.planID),
            plan.delivery == EDelivery::Refused ? "refused" : GetText(plan.status),
            plan.robotID.empty() ? "" : " (" + CleanText(plan.robotID) + ")",
            plan.reason.empty() ? "" : ": " + CleanText(plan.reason)));
    }
    if (lines.empty())
    {
        lines.emplace_back("no plans");
    }
    return lines;
}

bool WasDuplicateRefused(const PlanTracker& tracker)
{
    const std::vector<TrackedPlan>& plans = tracker.GetPlans();
    return std::any_of(plans.begin(), plans.end(), [](const TrackedPlan& plan) {
        // In whatever case, and beside "Queue Full".
        return GetOutcome(plan) == EOutcome::Refused && plan.reason.find("uplicate") != std::string::npos;
    });
}

std::string MakeDeliveryLine(const DeliveryCount& count)
{
    return fmt::format("{} carriers delivered, {} misplaced", count.delivered, count.misplaced);
}

std::string MakeLastLine(const PlanTracker& tracker)
{
    return fmt::format(
        "{} plans completed, {} failed",
        tracker.CountOutcome(EOutcome::Completed),
        tracker.CountFailed());
}

} // namespace ACS::McsSim
