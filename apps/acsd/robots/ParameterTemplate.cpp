#include "robots/ParameterTemplate.hpp"

#include "mcs/MessageValue.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Core::JsonText;
using VDA5050::EValueDataType;

/// Greater whole numbers are not exact as a double.
constexpr double LARGEST_INTEGER = 9'007'199'254'740'992.0;

std::string_view GetTypeName(EValueDataType type)
{
    switch (type)
    {
        case EValueDataType::Bool:
            return "BOOL";
        case EValueDataType::Number:
            return "NUMBER";
        case EValueDataType::Integer:
            return "INTEGER";
        case EValueDataType::Float:
            return "FLOAT";
        case EValueDataType::String:
            return "STRING";
        case EValueDataType::Object:
            return "OBJECT";
        case EValueDataType::Array:
            return "ARRAY";
        default:
            return "unknown type";
    }
}

JsonText MakeJSON(const JobValue& value)
{
    return std::visit(
        Core::Overloaded{
            [](const std::string& text) { return JsonText::FromString(text); },
            [](std::int64_t integer) { return JsonText::FromInteger(integer); },
            [](double number) { return JsonText::FromNumber(number); },
            [](bool bValue) {
                return JsonText::FromBoolean(bValue);
            }},
        value);
}

std::string WriteText(const JobValue& value)
{
    const auto* const text = std::get_if<std::string>(&value);
    return text == nullptr ? MakeJSON(value).GetText() : *text;
}

std::optional<double> ReadNumberOrNull(const std::string& text)
{
    const std::optional<double> number = Core::ParseNumberOrNull<double>(text);
    return number.has_value() && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<JsonText> MakeNumberOrNull(const JobValue& value)
{
    if (const auto* const text = std::get_if<std::string>(&value))
    {
        const std::optional<double> number = ReadNumberOrNull(*text);
        return number.has_value() ? std::optional(JsonText::FromNumber(*number)) : std::nullopt;
    }
    return std::holds_alternative<bool>(value) ? std::nullopt : std::optional(MakeJSON(value));
}

std::optional<JsonText> MakeIntegerOrNull(const JobValue& value)
{
    if (std::holds_alternative<std::int64_t>(value))
    {
        return MakeJSON(value);
    }
    const std::optional<JsonText> number = MakeNumberOrNull(value);
    const std::optional<double> whole = number.has_value() ? number->GetNumberOrNull() : std::nullopt;
    const bool bWhole = whole.has_value() && std::trunc(*whole) == *whole && std::abs(*whole) <= LARGEST_INTEGER;
    return bWhole ? std::optional(JsonText::FromInteger(static_cast<std::int64_t>(*whole))) : std::nullopt;
}

std::optional<JsonText> MakeBooleanOrNull(const JobValue& value)
{
    const std::string text = WriteText(value);
    return text == "true" || text == "false" ? std::optional(JsonText::FromBoolean(text == "true")) : std::nullopt;
}

std::optional<JsonText> ConvertOrNull(const JobValue& value, EValueDataType type)
{
    switch (type)
    {
        case EValueDataType::Bool:
            return MakeBooleanOrNull(value);
        case EValueDataType::Number:
        case EValueDataType::Float:
            return MakeNumberOrNull(value);
        case EValueDataType::Integer:
            return MakeIntegerOrNull(value);
        case EValueDataType::String:
            return JsonText::FromString(WriteText(value));
        case EValueDataType::Object:
        case EValueDataType::Array:
        default:
            return std::nullopt;
    }
}

} // namespace

tl::expected<ParameterTemplate, std::string> ParameterTemplate::Make(std::string_view text)
{
    if (std::optional<std::string> fault = FindTextFaultOrNull(text))
    {
        return tl::unexpected(std::move(*fault));
    }
    tl::expected<JobTemplate, std::string> parsed = JobTemplate::Parse(text);
    if (!parsed.has_value())
    {
        return tl::unexpected(std::move(parsed.error()));
    }
    ParameterTemplate result;
    result._pieces.push_back({{}, Scalar(std::move(*parsed))});
    return result;
}

tl::expected<ParameterTemplate, std::string> ParameterTemplate::Make(const toml::node& node)
{
    ParameterTemplate result;
    std::string json;
    if (std::optional<std::string> fault = result.AppendRecursiveOrNull(node, json))
    {
        return tl::unexpected(std::move(*fault));
    }
    if (!json.empty())
    {
        result._pieces.push_back({std::move(json), std::nullopt});
    }
    return result;
}

// NOLINTNEXTLINE(misc-no-recursion): toml++ refuses what is nested deeper than 256
std::optional<std::string> ParameterTemplate::AppendRecursiveOrNull(const toml::node& node, std::string& json)
{
    std::optional<std::string> fault;
    std::string_view joint;
    if (const toml::table* const table = node.as_table())
    {
        json += '{';
        for (auto entry = table->begin(); entry != table->end() && !fault.has_value(); ++entry)
        {
            const std::string name(entry->first.str());
            json += fmt::format("{}{}:", std::exchange(joint, ","), JsonText::FromString(name).GetText());
            fault = FindNameFaultOrNull(name);
            fault = fault.has_value() ? fault : AppendRecursiveOrNull(entry->second, json);
        }
        json += '}';
        return fault;
    }
    if (const toml::array* const array = node.as_array())
    {
        json += '[';
        for (auto entry = array->begin(); entry != array->end() && !fault.has_value(); ++entry)
        {
            json += std::exchange(joint, ",");
            fault = AppendRecursiveOrNull(*entry, json);
        }
        json += ']';
        return fault;
    }
    Scalar scalar;
    if (const std::optional<std::string> text = node.value_exact<std::string>())
    {
        tl::expected<ParameterTemplate, std::string> parsed = Make(std::string_view(*text));
        if (!parsed.has_value())
        {
            return std::move(parsed.error());
        }
        scalar = std::move(*parsed->_pieces.front().scalarOrNull);
    }
    else if (const std::optional<std::int64_t> integer = node.value_exact<std::int64_t>())
    {
        scalar = *integer;
    }
    else if (const std::optional<double> number = node.value_exact<double>())
    {
        fault = FindNumberFaultOrNull(*number);
        scalar = *number;
    }
    else if (const std::optional<bool> bValue = node.value_exact<bool>())
    {
        scalar = *bValue;
    }
    else
    {
        return "expected a string, number, boolean, table or list, found a date or time";
    }
    _pieces.push_back({std::exchange(json, {}), std::move(scalar)});
    return fault;
}

bool ParameterTemplate::IsScalar() const noexcept
{
    return _pieces.size() == 1 && _pieces.front().json.empty();
}

std::string_view ParameterTemplate::GetJsonKind() const noexcept
{
    return _pieces.front().json.starts_with('{') ? "a table" : "a list";
}

std::vector<JobName> ParameterTemplate::GetNames() const
{
    std::vector<JobName> names;
    for (const Piece& piece : _pieces)
    {
        const auto* const text =
            piece.scalarOrNull.has_value() ? std::get_if<JobTemplate>(&*piece.scalarOrNull) : nullptr;
        if (text != nullptr)
        {
            std::ranges::move(text->GetNames(), std::back_inserter(names));
        }
    }
    return names;
}

tl::expected<JsonText, std::string> ParameterTemplate::Resolve(
    const JobData& data,
    std::optional<EValueDataType> typeOrNull) const
{
    std::string json;
    for (const Piece& piece : _pieces)
    {
        json += piece.json;
        if (!piece.scalarOrNull.has_value())
        {
            continue;
        }
        const tl::expected<JobValue, JobName> value = std::visit(
            Core::Overloaded{
                [&data](const JobTemplate& text) { return text.Resolve(data); },
                [](const auto& scalar) {
                    return tl::expected<JobValue, JobName>(JobValue(scalar));
                }},
            *piece.scalarOrNull);
        if (!value.has_value())
        {
            return tl::unexpected(fmt::format("the job has no {}", MakeNameText(value.error())));
        }
        const bool bConverted = IsScalar() && typeOrNull.has_value();
        const std::optional<JsonText> converted =
            bConverted ? ConvertOrNull(*value, *typeOrNull) : std::optional(MakeJSON(*value));
        if (!converted.has_value())
        {
            return tl::unexpected(
                fmt::format("{} is not of type {}", MakeJSON(*value).GetText(), GetTypeName(*typeOrNull)));
        }
        json += converted->GetText();
    }
    const bool bObject = json.starts_with('{');
    const EValueDataType structure = bObject ? EValueDataType::Object : EValueDataType::Array;
    if (!IsScalar() && typeOrNull.value_or(structure) != structure)
    {
        return tl::unexpected(fmt::format("{} is not of type {}", GetJsonKind(), GetTypeName(*typeOrNull)));
    }
    return JsonText::FromTrusted(std::move(json));
}

} // namespace ACS::Acsd
