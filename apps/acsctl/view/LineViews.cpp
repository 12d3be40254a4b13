#include "view/LineViews.hpp"

#include "view/AgeText.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t LONGEST_MESSAGE = 4U * 1024U * 1024U;
constexpr std::size_t DEEPEST_MESSAGE = 64;
constexpr std::size_t MOST_VALUES = 500'000;

/// The member as text: a string, or JSON; empty if it is absent, null, an object or a list.
std::string GetText(const Json::Value& object, std::string_view name)
{
    const Json::Value* const memberOrNull = Json::FindFirstOrNull(object, name);
    if (memberOrNull == nullptr || memberOrNull->IsObject() || memberOrNull->IsArray())
    {
        return {};
    }
    return memberOrNull->IsString() ? std::string(memberOrNull->GetString(), memberOrNull->GetStringLength())
                                    : Json::WriteText(*memberOrNull);
}

/// "planId=P1 stepNo=2" of the members that are there.
template <std::size_t COUNT>
std::string ListMembers(const Json::Value& object, const std::array<std::string_view, COUNT>& names)
{
    std::string list;
    for (const std::string_view name : names)
    {
        if (const std::string text = GetText(object, name); !text.empty())
        {
            list += fmt::format(" {}={}", name, text);
        }
    }
    return list;
}

constexpr std::array<std::string_view, 11> PAYLOAD_MEMBERS{
    "planId",
    "stepNo",
    "jobId",
    "robotId",
    "status",
    "robotStatus",
    "errorCode",
    "state",
    "isConnected",
    "result",
    "message"};
constexpr std::array<std::string_view, 2> ACK_MEMBERS{"result", "message"};
constexpr std::array<std::string_view, 9> VEHICLE_MEMBERS{
    "orderId",
    "orderUpdateId",
    "lastNodeId",
    "driving",
    "paused",
    "operatingMode",
    "connectionState",
    "charging",
    "newBaseRequest"};

/// The sentence of an answer: its message or its error.
std::string ReadAnswer(const Core::JsonText& answer)
{
    if (const std::optional<std::string> text = answer.GetStringOrNull(); text.has_value())
    {
        return *text;
    }
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> value =
        document.Parse(answer.GetText(), {LONGEST_MESSAGE, DEEPEST_MESSAGE, MOST_VALUES});
    if (value.has_value())
    {
        const std::string message = GetText(**value, "message");
        const std::string sentence = message.empty() ? GetText(**value, "error") : message;
        return sentence.empty() ? answer.GetText() : sentence;
    }
    return answer.GetText();
}

std::string SummarizeMessage(const TraceLine& line, const Json::Value& message)
{
    if (const std::string command = GetText(message, "command"); !command.empty())
    {
        // An Ack has its result beside its payload.
        const Json::Value* const payloadOrNull = Json::FindFirstOrNull(message, "payload");
        return payloadOrNull != nullptr && payloadOrNull->IsObject()
            ? command + ListMembers(*payloadOrNull, PAYLOAD_MEMBERS) + ListMembers(message, ACK_MEMBERS)
            : command + ListMembers(message, PAYLOAD_MEMBERS);
    }
    if (line.topic.has_value())
    {
        return line.topic->substr(line.topic->rfind('/') + 1) + ListMembers(message, VEHICLE_MEMBERS);
    }
    return {};
}

} // namespace

std::string Summarize(const TraceLine& line)
{
    if (line.lost.has_value())
    {
        return fmt::format("{} messages are missing before this line", *line.lost);
    }
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> message =
        document.Parse(line.text, {LONGEST_MESSAGE, DEEPEST_MESSAGE, MOST_VALUES});
    if (message.has_value() && (*message)->IsObject())
    {
        if (std::string summary = SummarizeMessage(line, **message); !summary.empty())
        {
            return summary;
        }
    }
    return line.topic.has_value() ? fmt::format("{} {}", line.topic->substr(line.topic->rfind('/') + 1), line.text)
                                  : line.text;
}

std::string PrintTrace(const std::vector<TraceLine>& lines, const Screen& screen)
{
    if (lines.empty())
    {
        return "No message.\n";
    }
    constexpr std::size_t TIME = 12;
    const bool bPrograms = std::ranges::any_of(lines, [](const TraceLine& line) { return line.program.has_value(); });
    std::vector<TextTable::Column> columns{{"TIME", 0, TIME}, {"LINK", 1}, {"DIR", 0, 3}, {"ROBOT", 1}, {"WHAT", 2}};
    if (bPrograms)
    {
        columns.insert(columns.begin() + 1, {"PROGRAM", 1});
    }
    TextTable table(std::move(columns));
    for (const TraceLine& line : lines)
    {
        std::vector<TextTable::Cell> cells{
            {MakeTimeOfDay(line.time)},
            {line.link},
            {line.direction.value_or("-")},
            {line.robot.value_or("-")},
            {Summarize(line), line.lost.has_value() ? EStyle::Warning : EStyle::Plain}};
        if (bPrograms)
        {
            cells.insert(cells.begin() + 1, {line.program.value_or("acsd")});
        }
        table.AddRow(std::move(cells));
    }
    return table.Print(screen);
}

std::string PrintAudit(const std::vector<AuditLine>& lines, const Screen& screen)
{
    if (lines.empty())
    {
        return "No command is recorded.\n";
    }
    constexpr std::size_t TIME = 19;
    constexpr std::size_t REQUEST = 16;
    constexpr std::int64_t FIRST_ERROR = 400;
    TextTable table(
        {{"TIME", 1, TIME}, {"NAME", 1}, {"STATUS", 0, 3, true}, {"REQUEST", 2, REQUEST}, {"ANSWER", 3}, {"PEER", 4}});
    for (const AuditLine& line : lines)
    {
        if (line.lost.has_value())
        {
            table.AddRow({{line.time}, {}, {}, {fmt::format("{} commands are missing", *line.lost), EStyle::Warning}});
            continue;
        }
        const bool bRefused = line.status.value_or(0) >= FIRST_ERROR;
        const std::string name = line.name.value_or("");
        table.AddRow(
            {{line.time},
             {name.empty() ? "-" : name},
             {line.status.has_value() ? std::to_string(*line.status) : "-", bRefused ? EStyle::Bad : EStyle::Plain},
             {line.request.value_or("")},
             {ReadAnswer(line.answer)},
             {line.peer.value_or("")}});
    }
    return table.Print(screen);
}

std::string PrintEntry(const EntryEvent& entry, const Screen& screen)
{
    const std::string line = fmt::format(
        "{} {:<7} {}",
        MakeDisplayable(MakeTimeOfDay(entry.time)),
        MakeDisplayable(entry.kind),
        MakeDisplayable(entry.text));
    return CutToColumns(line, screen.columns) + "\n";
}

} // namespace ACS::Acsctl
