#include "common/trace/TraceLine.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace ACS::Apps
{

namespace
{

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

void AppendMember(std::string_view name, std::string_view value, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"(,"{}":)", name);
    Core::JsonText::AppendString(value, line);
}

void AppendNumber(std::string_view name, std::uint64_t value, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"(,"{}":{})", name, value);
}

/// The first two members are always the times: traces are merged by them.
void BeginLine(Core::Now now, std::string_view program, std::string_view link, std::string& line)
{
    fmt::format_to(
        std::back_inserter(line),
        R"({{"time":"{}","mono_us":{})",
        Core::FormatUTC(now.wall),
        std::chrono::duration_cast<std::chrono::microseconds>(now.steady.time_since_epoch()).count());
    if (!program.empty())
    {
        AppendMember("program", program, line);
    }
    AppendMember("link", link, line);
}

} // namespace

std::string MakeTraceLine(const TraceLine& line, Core::Now now)
{
    std::string out;
    BeginLine(now, line.program, line.link, out);
    out += line.bIn ? R"(,"direction":"in")" : R"(,"direction":"out")";
    const auto append = [&out](std::string_view name, std::string_view value) {
        if (!value.empty())
        {
            AppendMember(name, value, out);
        }
    };
    append("kind", line.kind);
    if (line.depth > 0)
    {
        AppendNumber("depth", line.depth, out);
    }
    if (line.controller.has_value())
    {
        AppendNumber("controller", *line.controller, out);
    }
    if (line.connection.has_value())
    {
        AppendNumber("connection", *line.connection, out);
    }
    append("robot", line.robotID);
    append("plan", line.planID);
    append("transaction", line.transactionID);
    append("topic", line.topic);
    if (Core::JsonText::IsUtf8(line.text))
    {
        AppendMember("text", line.text, out);
    }
    else
    {
        AppendMember("text", EscapeBytes(line.text), out);
        out += R"(,"escaped":true)";
    }
    out += '}';
    return out;
}

std::string MakeLossLine(std::string_view program, std::uint64_t count, Core::Now now)
{
    std::string line;
    BeginLine(now, program, "trace", line);
    AppendNumber("lost", count, line);
    line += '}';
    return line;
}

std::string_view FindTextMember(std::string_view text, std::string_view name)
{
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1))
    {
        std::string_view rest = text.substr(at + name.size());
        if (at == 0 || text[at - 1] != '"' || !rest.starts_with('"'))
        {
            continue;
        }
        rest.remove_prefix(1);
        rest.remove_prefix(std::min(rest.find_first_not_of(": "), rest.size()));
        if (!rest.starts_with('"'))
        {
            continue; // null
        }
        rest.remove_prefix(1);
        const std::size_t end = rest.find_first_of("\"\\");
        return end == std::string_view::npos || rest[end] == '\\' ? std::string_view() : rest.substr(0, end);
    }
    return {};
}

} // namespace ACS::Apps
