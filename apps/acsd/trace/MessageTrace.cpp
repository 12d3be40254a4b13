#include "trace/MessageTrace.hpp"

#include <acs/core/ECoreError.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <system_error>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// In memory.
constexpr std::size_t NEWEST_LINES = 1'000;
constexpr std::size_t NEWEST_BYTES = 4U * 1024U * 1024U;

/// Bytes of the character that begins here; 0: none does.
std::size_t GetCharacterLength(std::string_view text)
{
    constexpr std::size_t LONGEST = 4;
    for (std::size_t length = 1; length <= std::min(LONGEST, text.size()); ++length)
    {
        if (Core::JsonText::IsUtf8(text.substr(0, length)))
        {
            return length;
        }
    }
    return 0;
}

std::string EscapeBytes(std::string_view text)
{
    std::string escaped;
    for (std::size_t at = 0; at < text.size();)
    {
        const std::size_t length = GetCharacterLength(text.substr(at));
        if (length == 0)
        {
            fmt::format_to(std::back_inserter(escaped), "\\x{:02X}", static_cast<unsigned char>(text[at]));
        }
        else
        {
            escaped.append(text[at] == '\\' ? "\\\\" : text.substr(at, length));
        }
        at += std::max<std::size_t>(length, 1);
    }
    return escaped;
}

void BeginLine(Core::Now now, std::string_view link, std::string& line)
{
    fmt::format_to(
        std::back_inserter(line),
        R"({{"time":"{}","mono_us":{},"link":"{}")",
        Core::FormatUTC(now.wall),
        std::chrono::duration_cast<std::chrono::microseconds>(now.steady.time_since_epoch()).count(),
        link);
}

void AppendMember(std::string_view name, std::string_view value, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"(,"{}":)", name);
    Core::JsonText::AppendString(value, line);
}

std::string MakeLossLine(std::uint64_t count, Core::Now now)
{
    std::string line;
    BeginLine(now, "trace", line);
    fmt::format_to(std::back_inserter(line), R"(,"lost":{}}})", count);
    return line;
}

} // namespace

std::string MakeTraceLine(const TraceEntry& entry, Core::Now now)
{
    std::string line;
    BeginLine(now, entry.link, line);
    line += entry.direction == ProtocolBeast::EWireDirection::In ? R"(,"direction":"in")" : R"(,"direction":"out")";
    const auto append = [&line](std::string_view name, std::string_view value) {
        if (!value.empty())
        {
            AppendMember(name, value, line);
        }
    };
    append("kind", entry.kind);
    if (entry.depth > 0)
    {
        fmt::format_to(std::back_inserter(line), R"(,"depth":{})", entry.depth);
    }
    append("robot", entry.robotID);
    append("plan", entry.planID);
    append("transaction", entry.transactionID);
    append("topic", entry.topic);
    if (Core::JsonText::IsUtf8(entry.text))
    {
        AppendMember("text", entry.text, line);
    }
    else
    {
        AppendMember("text", EscapeBytes(entry.text), line);
        line += R"(,"escaped":true)";
    }
    line += '}';
    return line;
}

MessageTrace::MessageTrace(
    const std::string& folder,
    const Apps::TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger,
    std::size_t maxQueuedBytes)
    : _clock(clock),
      _newest(NEWEST_LINES, NEWEST_BYTES),
      _writer({folder, limits, MakeLossLine, maxQueuedBytes}, clock, std::move(logger))
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
        return Core::Fail(error, {}, "a folder for --trace that can be written", folder + ": " + error.message());
    }
    return trace;
}

void MessageTrace::Write(const TraceEntry& entry)
{
    Write(entry, _clock.GetNow(), ETraceUse::All);
}

void MessageTrace::Write(const TraceEntry& entry, Core::Now now, ETraceUse use)
{
    std::string line = MakeTraceLine(entry, now);
    if (use == ETraceUse::All)
    {
        _newest.Add(line);
    }
    _writer.Write(std::move(line), now);
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
