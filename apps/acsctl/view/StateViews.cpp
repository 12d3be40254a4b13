#include "view/StateViews.hpp"

#include "view/AgeText.hpp"
#include "view/DetailList.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

// Ranks of the columns: what is cut first.
constexpr int NEVER = 0;
constexpr int LATE = 1;
constexpr int EARLY = 2;
constexpr int FIRST = 3;
constexpr int BEFORE_FIRST = 4;

/// "1 node", "2 nodes"
std::string MakeCount(std::uint64_t count, std::string_view noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string DescribeOutbox(const OutboxInfo& outbox, Core::WallTime now)
{
    if (outbox.reports == 0)
    {
        return "empty";
    }
    return fmt::format(
        "{} without an Ack, the oldest{}",
        MakeCount(outbox.reports, "report"),
        MakeSince(outbox.oldest, now));
}

std::string DescribeRefused(const RefusedReportsInfo& refused)
{
    if (refused.count == 0)
    {
        return {};
    }
    std::string text = MakeCount(refused.count, "report");
    if (refused.last.has_value())
    {
        const std::string plan = refused.last->planID.has_value() ? " of plan " + *refused.last->planID : std::string();
        text += fmt::format("; the last: {}{}: {}", refused.last->command, plan, refused.last->message);
    }
    return text;
}

std::string DescribeLink(const LinkInfo& link, Core::WallTime now)
{
    std::string text = fmt::format("{}{}", GetLinkText(link), MakeSince(link.since, now));
    if (!link.bUp && link.reason.has_value())
    {
        text.append(": ").append(*link.reason);
    }
    if (link.bUp && link.broker.has_value())
    {
        text.append(": ").append(*link.broker);
    }
    return text;
}

std::string DescribeRobots(const RobotCounts& robots)
{
    std::string text = std::to_string(robots.total);
    std::string_view separator = ": ";
    for (const auto& [status, count] : robots.byStatus.counts)
    {
        if (count != 0)
        {
            text += fmt::format("{}{} {}", separator, count, status);
            separator = ", ";
        }
    }
    return text;
}

std::string DescribeTSC(const StatusInfo& status)
{
    return status.tscReason.has_value() ? fmt::format("{}: {}", status.tsc, *status.tscReason) : status.tsc;
}

} // namespace

std::string_view GetLinkText(const LinkInfo& link)
{
    return link.bUp ? "up" : "down";
}

bool IsHealthy(const StatusInfo& status)
{
    const bool bLinksUp = std::ranges::all_of(status.links, &LinkInfo::bUp);
    return status.bReady && bLinksUp && status.tsc == "Auto" && status.alarms.heavy == 0;
}

std::string PrintStatus(const StatusInfo& status, const ViewContext& context)
{
    constexpr double LONGEST_UPTIME = 1e10; // seconds: more is not a duration
    const auto uptime = static_cast<std::int64_t>(std::clamp(status.uptimeSeconds, 0.0, LONGEST_UPTIME));
    DetailList details;
    details.Add(
        "acsd",
        fmt::format("{}, running for {}", status.version, MakeDurationText(std::chrono::seconds(uptime))));
    if (status.bReady)
    {
        details.Add("Ready", "yes", EStyle::Good);
    }
    else
    {
        details.Add("Ready", fmt::format("no: {}", fmt::join(status.notReadyReasons, "; ")), EStyle::Bad);
    }
    if (status.bConnected.has_value())
    {
        details.Add("Connected", fmt::format("{}, as reported to the MCS", *status.bConnected ? "yes" : "no"));
    }
    else
    {
        details.Add("Connected", "not reported to the MCS yet");
    }
    for (const LinkInfo& link : status.links)
    {
        details.Add("Link " + link.name, DescribeLink(link, context.now), GetStyle(GetLinkText(link)));
    }
    details.Add("TSC", DescribeTSC(status), GetStyle(status.tsc));
    details.Add("Plans", fmt::format("{} active, {} waiting", status.plans.active, status.plans.waiting));
    details.Add("Robots", DescribeRobots(status.robots));
    details.Add(
        "Alarms",
        fmt::format("{} heavy, {} light", status.alarms.heavy, status.alarms.light),
        status.alarms.heavy != 0 ? EStyle::Bad : EStyle::Plain);
    details.Add("Outbox", DescribeOutbox(status.outbox, context.now));
    details.AddIfAny("Refused", DescribeRefused(status.refusedReports), EStyle::Warning);
    return details.Print(context.screen);
}

std::string PrintAlarms(const std::vector<AlarmInfo>& alarms, const ViewContext& context)
{
    if (alarms.empty())
    {
        return "No alarm is active.\n";
    }
    constexpr std::size_t TITLE = 12;
    TextTable table(
        {{"ROBOT", LATE},
         {"CODE", LATE, 8},
         {"LEVEL", NEVER},
         {"AGE", NEVER, 4, true},
         {"PLAN", EARLY, 8},
         {"STEP", BEFORE_FIRST, 4, true},
         {"JOB", BEFORE_FIRST, 8},
         {"TITLE", EARLY, TITLE},
         {"MESSAGE", FIRST}});
    for (const AlarmInfo& alarm : alarms)
    {
        table.AddRow(
            {{alarm.robotID},
             {alarm.errorCode},
             {alarm.level, GetStyle(alarm.level)},
             {MakeAge(alarm.since, context.now)},
             {alarm.planID.value_or("-")},
             {alarm.stepNo.has_value() ? std::to_string(*alarm.stepNo) : "-"},
             {alarm.jobID.value_or("-")},
             {alarm.title},
             {alarm.message}});
    }
    return table.Print(context.screen);
}

std::string PrintLinks(const std::vector<LinkInfo>& links, const ViewContext& context)
{
    TextTable table({{"LINK", LATE}, {"STATE", NEVER}, {"AGE", NEVER, 4, true}, {"REASON", FIRST}});
    for (const LinkInfo& link : links)
    {
        const std::string_view state = GetLinkText(link);
        table.AddRow(
            {{link.name},
             {std::string(state), GetStyle(state)},
             {MakeAge(link.since, context.now)},
             {link.reason.value_or("")}});
    }
    return table.Print(context.screen);
}

std::string PrintQueue(const QueueAnswer& queue, const ViewContext& context)
{
    std::string out;
    if (queue.plans.empty())
    {
        out = "No plan waits in the queue.\n";
    }
    else
    {
        constexpr std::size_t WAITS = 16;
        TextTable table(
            {{"POS", NEVER, 3, true},
             {"PLAN", LATE, 8},
             {"PRIO", NEVER, 4, true},
             {"AGE", NEVER, 4, true},
             {"WAITS", FIRST, WAITS}});
        for (const QueueEntry& entry : queue.plans)
        {
            table.AddRow(
                {{std::to_string(entry.position)},
                 {entry.planID},
                 {entry.priority.has_value() ? std::to_string(*entry.priority) : "-"},
                 {MakeAge(entry.acceptedAt, context.now)},
                 {entry.waits.has_value() ? entry.waits->message : std::string()}});
        }
        out = table.Print(context.screen);
    }
    AppendIndented(out, "Outbox: " + DescribeOutbox(queue.outbox, context.now), 0, context.screen);
    return out;
}

std::string PrintSite(const SiteAnswer& site, const ViewContext& context)
{
    std::string out = fmt::format(
        "Map: {}, {}, {}\n",
        MakeCount(site.nodes.size(), "node"),
        MakeCount(site.edges.size(), "edge"),
        MakeCount(site.stations.size(), "station"));
    if (site.blocked.empty())
    {
        return out + "No place is blocked.\n";
    }
    TextTable table({{"BLOCKED", NEVER}, {"ID", LATE, 8}, {"AGE", NEVER, 4, true}, {"REASON", FIRST}});
    for (const BlockInfo& block : site.blocked)
    {
        table.AddRow({{block.kind}, {block.id}, {MakeAge(block.since, context.now)}, {block.reason.value_or("")}});
    }
    return out + table.Print(context.screen);
}

} // namespace ACS::Acsctl
