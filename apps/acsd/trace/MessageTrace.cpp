#include "trace/MessageTrace.hpp"

#include "common/trace/TraceFiles.hpp"
#include "common/trace/TraceLine.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <deque>
#include <functional>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

/// In memory.
constexpr std::size_t NEWEST_LINES = 1'000;
constexpr std::size_t NEWEST_BYTES = 4U * 1024U * 1024U;

constexpr std::string_view MCS_LINK = "mcs";
constexpr std::size_t TIME_END = std::string_view(R"({"time":"2026-01-01T00:00:00.000Z")").size();

/// The monotonic time of a line, which follows the time; 0 if there is none.
std::uint64_t ReadMonotonic(std::string_view line)
{
    constexpr std::string_view MEMBER = R"(,"mono_us":)";
    line.remove_prefix(std::min(TIME_END, line.size()));
    if (!line.starts_with(MEMBER))
    {
        return 0;
    }
    line.remove_prefix(MEMBER.size());
    return Core::ParseNumberOrNull<std::uint64_t>(line.substr(0, line.find(','))).value_or(0);
}

/// The beginning of the newest lines, which are in memory.
struct MemoryStart
{
    std::string time; ///< Empty: there are none.
    std::uint64_t monotonic = 0;
};

/// Whether a line of the files is before the lines in memory: of this boot by its monotonic time, because the clock may have been
/// set; of an earlier boot by its time. `matching` are of those in memory.
bool IsBefore(std::string_view line, const MemoryStart& start, const std::vector<std::string>& matching)
{
    return start.time.empty() || ReadMonotonic(line) < start.monotonic
        || (line.substr(0, TIME_END) < start.time && std::ranges::find(matching, line) == matching.end());
}

Apps::TraceFileStyle MakeStyle()
{
    Apps::TraceFileStyle style;
    style.bDeletedLater = true;
    return style;
}

} // namespace

std::string MakeTraceLine(const TraceEntry& entry, Core::Now now)
{
    return Apps::MakeTraceLine(
        {entry.link,
         entry.direction == ProtocolBeast::EWireDirection::In,
         entry.text,
         entry.robotID,
         entry.planID,
         entry.transactionID,
         entry.topic,
         entry.kind,
         entry.depth},
        now);
}

MessageTrace::MessageTrace(
    const std::string& folder,
    const Apps::TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger,
    std::size_t maxQueuedBytes)
    : _clock(clock),
      _folder(folder),
      _newest(NEWEST_LINES, NEWEST_BYTES),
      _writer(
          {folder, limits, std::bind_front(&Apps::MakeLossLine, std::string_view()), maxQueuedBytes, MakeStyle()},
          clock,
          std::move(logger))
{
}

Core::Result<std::unique_ptr<MessageTrace>> MessageTrace::Create(
    const std::string& folder,
    const Apps::TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger,
    std::size_t maxQueuedBytes)
{
    // The constructor is private.
    std::unique_ptr<MessageTrace> trace(new MessageTrace(folder, limits, clock, std::move(logger), maxQueuedBytes));
    if (const std::error_code error = trace->_writer.Open())
    {
        return Core::Fail(
            error,
            {},
            "a folder for --trace that can be written",
            folder + ": " + Apps::DescribeTraceError(error));
    }
    return trace;
}

void MessageTrace::Keep()
{
    _writer.Keep();
}

void MessageTrace::Write(const TraceEntry& entry)
{
    Write(entry, GetNow());
}

Core::Now MessageTrace::GetNow() const
{
    return _clock.GetNow();
}

void MessageTrace::Write(const TraceEntry& entry, Core::Now now)
{
    TraceEntry known = entry;
    if (entry.link == MCS_LINK)
    {
        known.planID = Apps::FindTextMember(entry.text, "planId");
        known.robotID = Apps::FindTextMember(entry.text, "robotId");
        known.transactionID = Apps::FindTextMember(entry.text, "transactionId");
    }
    else if (const auto plan = _plans.find(entry.robotID); plan != _plans.end())
    {
        known.planID = plan->second;
    }
    Add(known, now, ETraceUse::All);
}

void MessageTrace::Add(const TraceEntry& entry, ETraceUse use)
{
    Add(entry, GetNow(), use);
}

void MessageTrace::Add(const TraceEntry& entry, Core::Now now, ETraceUse use)
{
    std::string line = MakeTraceLine(entry, now);
    if (use == ETraceUse::All)
    {
        _newest.Add(line);
    }
    _writer.Write(std::move(line), now);
}

void MessageTrace::SetPlan(const std::string& robotID, const std::string& planID)
{
    if (planID.empty())
    {
        _plans.erase(robotID);
    }
    else
    {
        _plans.insert_or_assign(robotID, planID);
    }
}

MessageTrace::LineSearch MessageTrace::MakeSearch(Apps::TraceQuery query, std::size_t maximum) const
{
    const std::deque<std::string>& newest = _newest.GetLines();
    std::vector<std::string> matching;
    std::ranges::copy_if(newest, std::back_inserter(matching), [&query](const std::string& line) {
        return query.IsMatch(line);
    });
    // The times are at the beginning of a line. The last lines may not be in the files yet.
    MemoryStart start;
    if (!newest.empty())
    {
        start = {newest.front().substr(0, TIME_END), ReadMonotonic(newest.front())};
    }
    return [folder = _folder,
            query = std::move(query),
            maximum,
            matching = std::move(matching),
            start = std::move(start)] {
        Apps::NewestLines found(maximum, NEWEST_BYTES);
        if (matching.size() < maximum)
        {
            for (std::string& line : Apps::FindNewestLines(
                     folder,
                     Apps::TraceFileStyle().prefix,
                     maximum - matching.size(),
                     [&start, &query, &matching](std::string_view candidate) {
                         return query.IsMatch(candidate) && IsBefore(candidate, start, matching);
                     }))
            {
                found.Add(std::move(line));
            }
        }
        for (const std::string& line : matching)
        {
            found.Add(line);
        }
        return found;
    };
}

void MessageTrace::SetLimits(const Apps::TraceLimits& limits)
{
    _writer.SetLimits(limits);
}

const Apps::NewestLines& MessageTrace::GetNewest() const noexcept
{
    return _newest;
}

std::uint64_t MessageTrace::GetLost() const
{
    return _writer.GetLost();
}

} // namespace ACS::Acsd
