#include "programs/PlaceTemplate.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view ROBOT = "robot";
constexpr std::string_view ROBOT_FRONT = "{robot}.";
constexpr std::string_view SAMPLE_ROBOT = "CR01";
constexpr std::int64_t SAMPLE_NUMBER = 1;
constexpr std::int64_t LAST_NUMBER = Core::Location::MAX_NUMBER;

std::string MakeNumberText(std::int64_t number)
{
    return fmt::format("{:02}", number);
}

tl::unexpected<Core::Error> RefuseText(std::string_view text)
{
    return Core::Fail(
        Core::ECoreError::InvalidLocation,
        "",
        "a place such as A{ml106}.CP{ml107}.TP{ml108} or {robot}.TP{ml109}",
        Core::QuoteForError(text));
}

} // namespace

Core::Result<PlaceTemplate::Part> PlaceTemplate::ParseTag(std::string_view tag)
{
    if (tag == ROBOT)
    {
        return Part(RobotTag{});
    }
    const std::optional<RelayName> relay = ParseRelayNameOrNull(tag);
    if (!relay.has_value() || relay->width == ERelayWidth::Float)
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "",
            "{robot} or a relay that holds a whole number, such as {ml106}",
            fmt::format("{{{}}}", tag));
    }
    return Part(WordTag{std::string(tag), *relay});
}

Core::Result<PlaceTemplate> PlaceTemplate::Parse(std::string_view text)
{
    PlaceTemplate result;
    result._text = text;
    std::string_view rest = text;
    while (!rest.empty())
    {
        const std::size_t open = std::min(rest.find('{'), rest.size());
        if (open > 0)
        {
            result._parts.emplace_back(std::string(rest.substr(0, open)));
        }
        rest.remove_prefix(open);
        if (rest.empty())
        {
            break;
        }
        const std::size_t close = rest.find('}');
        Core::Result<Part> tag = ParseTag(rest.substr(1, close == std::string_view::npos ? close : close - 1));
        if (!tag.has_value() || close == std::string_view::npos)
        {
            return tag.has_value() ? RefuseText(text) : tl::make_unexpected(tag.error());
        }
        result._parts.push_back(std::move(*tag));
        rest.remove_prefix(close + 1);
    }
    const bool bRobotFirst = !result.HasRobotName() || (text.starts_with(ROBOT_FRONT) && text.rfind(ROBOT_FRONT) == 0);
    if (!bRobotFirst || !Core::Location::IsLocation(result.MakeSample()))
    {
        return RefuseText(text);
    }
    return result;
}

std::string PlaceTemplate::MakeSample() const
{
    std::string sample;
    for (const Part& part : _parts)
    {
        sample += std::visit(
            Core::Overloaded{
                [](const std::string& text) { return text; },
                [](const RobotTag&) { return std::string(SAMPLE_ROBOT); },
                [](const WordTag&) {
                    return MakeNumberText(SAMPLE_NUMBER);
                }},
            part);
    }
    return sample;
}

Core::Result<std::string> PlaceTemplate::Fill(const RelayMemory& relays, std::string_view robotID) const
{
    std::string place;
    for (const Part& part : _parts)
    {
        if (const auto* const word = std::get_if<WordTag>(&part); word != nullptr)
        {
            const auto number = static_cast<std::int64_t>(relays.Read(word->relay));
            if (number < 1 || number > LAST_NUMBER)
            {
                return Core::Fail(
                    Core::ECoreError::OutOfRange,
                    word->text,
                    fmt::format("a number from 1 to {} for {}", LAST_NUMBER, _text),
                    fmt::to_string(number));
            }
            place += MakeNumberText(number);
        }
        else if (const auto* const text = std::get_if<std::string>(&part); text != nullptr)
        {
            place += *text;
        }
        else
        {
            place += robotID;
        }
    }
    return place;
}

const std::string& PlaceTemplate::GetText() const noexcept
{
    return _text;
}

Core::ESegmentKind PlaceTemplate::GetKind() const
{
    const Core::Result<Core::Location> sample = Core::Location::Parse(MakeSample());
    assert(sample.has_value());
    return sample->GetKind();
}

bool PlaceTemplate::HasRobotName() const
{
    return std::ranges::any_of(_parts, [](const Part& part) { return std::holds_alternative<RobotTag>(part); });
}

bool PlaceTemplate::HasRelays() const
{
    return std::ranges::any_of(_parts, [](const Part& part) { return std::holds_alternative<WordTag>(part); });
}

} // namespace ACS::OpenStreamSim
