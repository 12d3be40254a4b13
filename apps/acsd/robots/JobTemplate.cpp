#include "robots/JobTemplate.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

std::string MakeText(const JobValue& value)
{
    return std::visit(
        Core::Overloaded{
            [](const std::string& text) { return text; },
            [](std::int64_t integer) { return fmt::format("{}", integer); },
            [](double number) { return fmt::format("{}", number); },
            [](bool bValue) {
                return std::string(bValue ? "true" : "false");
            }},
        value);
}

} // namespace

tl::expected<JobTemplate, std::string> JobTemplate::Parse(std::string_view text)
{
    JobTemplate result;
    std::string literal;
    for (std::size_t at = 0; at < text.size(); ++at)
    {
        const char character = text[at];
        const bool bBrace = character == '{' || character == '}';
        if (!bBrace || text.substr(at + 1, 1) == std::string_view(&character, 1))
        {
            literal += character;
            at += bBrace ? 1 : 0;
            continue;
        }
        const std::size_t end = text.find('}', at);
        if (character == '}' || end == std::string_view::npos)
        {
            return tl::unexpected(
                fmt::format("unmatched brace at character {}; write {{{{ or }}}} for a brace", at + 1));
        }
        tl::expected<JobName, std::string> name = ParseJobName(text.substr(at + 1, end - at - 1));
        if (!name.has_value())
        {
            return tl::unexpected(std::move(name.error()));
        }
        result._pieces.push_back({std::exchange(literal, {}), std::move(*name)});
        at = end;
    }
    if (!literal.empty() || result._pieces.empty())
    {
        result._pieces.push_back({std::move(literal), std::nullopt});
    }
    return result;
}

std::vector<JobName> JobTemplate::GetNames() const
{
    std::vector<JobName> names;
    for (const Piece& piece : _pieces)
    {
        if (piece.nameOrNull.has_value())
        {
            names.push_back(*piece.nameOrNull);
        }
    }
    return names;
}

tl::expected<JobValue, JobName> JobTemplate::Resolve(const JobData& data) const
{
    std::string text;
    for (const Piece& piece : _pieces)
    {
        text += piece.text;
        if (!piece.nameOrNull.has_value())
        {
            continue;
        }
        std::optional<JobValue> value = data.FindOrNull(*piece.nameOrNull);
        if (!value.has_value())
        {
            return tl::unexpected(*piece.nameOrNull);
        }
        if (_pieces.size() == 1 && piece.text.empty())
        {
            return std::move(*value);
        }
        text += MakeText(*value);
    }
    return JobValue(std::move(text));
}

} // namespace ACS::Acsd
