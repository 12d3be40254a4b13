#include "ParameterTemplate.hpp"

#include "MessageValue.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigNode;
using Core::JsonText;
using VDA5050::EValueDataType;

/// Whole numbers beyond it are not exact as a double.
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

JsonText MakeJson(const JobValue& value)
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

std::string MakeText(const JobValue& value)
{
    const auto* const text = std::get_if<std::string>(&value);
    return text == nullptr ? MakeJson(value).GetText() : *text;
}

std::optional<double> ReadNumberOrNull(const std::string& text)
{
    double number = 0;
    const char* const textEnd = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), textEnd, number);
    return error == std::errc() && end == textEnd && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<JsonText> MakeNumberOrNull(const JobValue& value)
{
    if (const auto* const text = std::get_if<std::string>(&value))
    {
        const std::optional<double> number = ReadNumberOrNull(*text);
        return number.has_value() ? std::optional(JsonText::FromNumber(*number)) : std::nullopt;
    }
    return std::holds_alternative<bool>(value) ? std::nullopt : std::optional(MakeJson(value));
}

std::optional<JsonText> MakeIntegerOrNull(const JobValue& value)
{
    if (std::holds_alternative<std::int64_t>(value))
    {
        return MakeJson(value);
    }
    const std::optional<JsonText> number = MakeNumberOrNull(value);
    const std::optional<double> whole = number.has_value() ? number->GetNumberOrNull() : std::nullopt;
    const bool bWhole = whole.has_value() && std::trunc(*whole) == *whole && std::abs(*whole) <= LARGEST_INTEGER;
    return bWhole ? std::optional(JsonText::FromInteger(static_cast<std::int64_t>(*whole))) : std::nullopt;
}

std::optional<JsonText> MakeBooleanOrNull(const JobValue& value)
{
    const std::string text = MakeText(value);
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
            return JsonText::FromString(MakeText(value));
        case EValueDataType::Object:
        case EValueDataType::Array:
        default:
            return std::nullopt;
    }
}

/// A step of writing a node as JSON: text, or a node.
using Work = std::vector<std::variant<std::string, const ConfigNode*>>;

std::optional<std::string> FindKeyFaultOrNull(const ConfigNode::Table& table)
{
    for (const auto& [name, value] : table)
    {
        if (std::optional<std::string> fault = FindNameFaultOrNull(name))
        {
            return fault;
        }
    }
    return std::nullopt;
}

void PushTable(const ConfigNode::Table& table, Work& work)
{
    work.emplace_back("}");
    for (auto entry = table.rbegin(); entry != table.rend(); ++entry)
    {
        work.emplace_back(entry->second.get());
        const std::string_view joint = std::next(entry) == table.rend() ? "" : ",";
        work.emplace_back(fmt::format("{}{}:", joint, JsonText::FromString(entry->first).GetText()));
    }
    work.emplace_back("{");
}

void PushArray(const ConfigNode::Array& array, Work& work)
{
    work.emplace_back("]");
    for (auto entry = array.rbegin(); entry != array.rend(); ++entry)
    {
        work.emplace_back(entry->get());
        if (std::next(entry) != array.rend())
        {
            work.emplace_back(",");
        }
    }
    work.emplace_back("[");
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

tl::expected<ParameterTemplate, std::string> ParameterTemplate::Make(const ConfigNode& node)
{
    ParameterTemplate result;
    std::string json;
    std::optional<std::string> fault;
    const auto add = [&result, &json](Scalar scalar) {
        result._pieces.push_back({std::exchange(json, {}), std::move(scalar)});
    };
    Work work{&node};
    while (!work.empty() && !fault.has_value())
    {
        const auto step = std::move(work.back());
        work.pop_back();
        if (const auto* const text = std::get_if<std::string>(&step))
        {
            json += *text;
            continue;
        }
        std::visit(
            Core::Overloaded{
                [&work, &fault](const ConfigNode::Table& table) {
                    fault = FindKeyFaultOrNull(table);
                    PushTable(table, work);
                },
                [&work](const ConfigNode::Array& array) { PushArray(array, work); },
                [&add, &fault](const std::string& text) {
                    tl::expected<ParameterTemplate, std::string> parsed = Make(std::string_view(text));
                    if (parsed.has_value())
                    {
                        add(std::move(*parsed->_pieces.front().scalarOrNone));
                    }
                    else
                    {
                        fault = std::move(parsed.error());
                    }
                },
                [&add](std::int64_t integer) { add(integer); },
                [&add, &fault](double number) {
                    fault = FindNumberFaultOrNull(number);
                    add(number);
                },
                [&add](bool bValue) { add(bValue); },
                [&fault](const ConfigNode::Other&) {
                    fault = "expected a string, number, boolean, table or list, found a date or time";
                }},
            std::get<const ConfigNode*>(step)->value);
    }
    if (fault.has_value())
    {
        return tl::unexpected(std::move(*fault));
    }
    if (!json.empty())
    {
        result._pieces.push_back({std::move(json), std::nullopt});
    }
    return result;
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
            piece.scalarOrNone.has_value() ? std::get_if<JobTemplate>(&*piece.scalarOrNone) : nullptr;
        if (text != nullptr)
        {
            std::ranges::move(text->GetNames(), std::back_inserter(names));
        }
    }
    return names;
}

tl::expected<JsonText, std::string> ParameterTemplate::Resolve(const JobData& data, std::optional<EValueDataType> type)
    const
{
    std::string json;
    for (const Piece& piece : _pieces)
    {
        json += piece.json;
        if (!piece.scalarOrNone.has_value())
        {
            continue;
        }
        const tl::expected<JobValue, JobName> value = std::visit(
            Core::Overloaded{
                [&data](const JobTemplate& text) { return text.Resolve(data); },
                [](const auto& scalar) {
                    return tl::expected<JobValue, JobName>(JobValue(scalar));
                }},
            *piece.scalarOrNone);
        if (!value.has_value())
        {
            return tl::unexpected(fmt::format("the job has no {}", MakeNameText(value.error())));
        }
        const bool bConverted = IsScalar() && type.has_value();
        const std::optional<JsonText> converted =
            bConverted ? ConvertOrNull(*value, *type) : std::optional(MakeJson(*value));
        if (!converted.has_value())
        {
            return tl::unexpected(fmt::format("{} is not of type {}", MakeJson(*value).GetText(), GetTypeName(*type)));
        }
        json += converted->GetText();
    }
    const bool bObject = json.starts_with('{');
    const EValueDataType structure = bObject ? EValueDataType::Object : EValueDataType::Array;
    if (!IsScalar() && type.value_or(structure) != structure)
    {
        return tl::unexpected(fmt::format("{} is not of type {}", GetJsonKind(), GetTypeName(*type)));
    }
    return JsonText::FromTrusted(std::move(json));
}

} // namespace ACS::Acsd
