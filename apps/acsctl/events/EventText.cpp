#include "events/EventText.hpp"

#include "api/ApiCodec.hpp"
#include "view/DisplayText.hpp"
#include "view/LineViews.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t MOST_VALUES_OF_EVENT = 3'000'000;
constexpr std::size_t DEEPEST_EVENT = 32;

struct ListName
{
    std::string_view member;
    std::string_view idName;
};

constexpr std::array<ListName, 4> LISTS{
    {{"plans", "planId"}, {"ended", "planId"}, {"robots", "robotId"}, {"alarms", "errorCode"}}};

/// "changes plans P1 P2, robots LR01"
std::string SummarizeChanges(const Json::Value& data)
{
    std::string text = "changes";
    std::string_view separator = " ";
    if (Json::FindFirstOrNull(data, "status") != nullptr)
    {
        text += " status";
        separator = ", ";
    }
    for (const ListName& list : LISTS)
    {
        const Json::Value* const elementsOrNull = Json::FindFirstOrNull(data, list.member);
        if (elementsOrNull == nullptr || !elementsOrNull->IsArray())
        {
            continue;
        }
        text += fmt::format("{}{}", separator, list.member);
        separator = ", ";
        for (const Json::Value& element : elementsOrNull->GetArray())
        {
            const Json::Value* const idOrNull = Json::FindFirstOrNull(element, list.idName);
            if (idOrNull != nullptr && idOrNull->IsString())
            {
                text += fmt::format(" {}", std::string_view(idOrNull->GetString(), idOrNull->GetStringLength()));
            }
        }
    }
    return text;
}

} // namespace

Core::Result<std::string> MakeEventLine(const SseEvent& event, const Screen& screen)
{
    if (event.type == "entry")
    {
        const Core::Result<EntryEvent> entry = DecodeAnswer<EntryEvent>(event.data);
        return entry.has_value() ? Core::Result<std::string>(PrintEntry(*entry, screen))
                                 : tl::unexpected<Core::Error>(entry.error());
    }
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> data =
        document.Parse(event.data, {MAX_ANSWER_BYTES, DEEPEST_EVENT, MOST_VALUES_OF_EVENT});
    if (!data.has_value())
    {
        return tl::unexpected<Core::Error>(data.error());
    }
    const std::string text = event.type == "changes" ? SummarizeChanges(**data) : event.type;
    return CutToColumns(MakeDisplayable(text), screen.columns) + "\n";
}

Core::Result<std::string> MakeEventJSON(const SseEvent& event)
{
    const Core::Result<std::string> data = MakeOneLine(event.data);
    if (!data.has_value())
    {
        return tl::unexpected<Core::Error>(data.error());
    }
    const std::optional<std::uint64_t> number = Core::ParseNumberOrNull<std::uint64_t>(event.id);
    std::string out;
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key("id");
    if (number.has_value())
    {
        writer.WriteUnsigned(*number);
    }
    else
    {
        writer.WriteNull();
    }
    writer.Key("type");
    writer.WriteString(event.type);
    writer.Key("data");
    writer.WriteRaw(Core::JsonText::FromTrusted(*data));
    writer.EndObject();
    return out + "\n";
}

} // namespace ACS::Acsctl
