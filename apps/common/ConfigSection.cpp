#include "common/ConfigSection.hpp"

#include "common/ConfigDocument.hpp"
#include "common/DurationText.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view A_STRING = "a string";
constexpr std::string_view A_TABLE = "a table";

std::string DescribeValue(const ConfigNode& node)
{
    return std::visit(
        Core::Overloaded{
            [](const ConfigNode::Table&) { return std::string("a table"); },
            [](const ConfigNode::Array&) { return std::string("a list"); },
            [](const std::string& text) { return fmt::format("the string '{}'", text); },
            [](std::int64_t integer) { return fmt::format("the integer {}", integer); },
            [](double number) { return fmt::format("the number {}", number); },
            [](bool bValue) { return std::string(bValue ? "true" : "false"); },
            [](const ConfigNode::Other&) { return std::string("a date or time"); },
        },
        node.value);
}

std::string MakeWrongText(std::string_view allowed, const ConfigNode& node)
{
    return fmt::format("expected {}, found {}", allowed, DescribeValue(node));
}

std::string JoinWords(std::initializer_list<std::string_view> words)
{
    return fmt::format("'{}'", fmt::join(words, "' or '"));
}

} // namespace

ConfigSection::ConfigSection(std::shared_ptr<ConfigDocument> document, const ConfigNode* nodeOrNull, std::string path)
    : _document(std::move(document)),
      _nodeOrNull(nodeOrNull),
      _path(std::move(path))
{
}

std::string ConfigSection::GetString(const std::string& key) const
{
    return GetStringIfGivenOrNull(key, true).value_or(std::string());
}

std::string ConfigSection::GetString(const std::string& key, const std::string& fallback) const
{
    return GetStringIfGivenOrNull(key, false).value_or(fallback);
}

std::optional<std::string> ConfigSection::GetStringOrNull(const std::string& key) const
{
    return GetStringIfGivenOrNull(key, false);
}

std::string ConfigSection::GetWord(const std::string& key, std::initializer_list<std::string_view> words) const
{
    return GetWordIfGivenOrNull(key, words, true).value_or(std::string());
}

std::string ConfigSection::GetWord(
    const std::string& key,
    std::initializer_list<std::string_view> words,
    const std::string& fallback) const
{
    return GetWordIfGivenOrNull(key, words, false).value_or(fallback);
}

std::int64_t ConfigSection::GetInteger(const std::string& key, std::int64_t min, std::int64_t max) const
{
    return GetIntegerIfGivenOrNull(key, min, max, true).value_or(min);
}

std::int64_t ConfigSection::GetInteger(
    const std::string& key,
    std::int64_t min,
    std::int64_t max,
    std::int64_t fallback) const
{
    return GetIntegerIfGivenOrNull(key, min, max, false).value_or(fallback);
}

double ConfigSection::GetNumber(const std::string& key, double min, double max) const
{
    return GetNumberIfGivenOrNull(key, min, max, true).value_or(min);
}

double ConfigSection::GetNumber(const std::string& key, double min, double max, double fallback) const
{
    return GetNumberIfGivenOrNull(key, min, max, false).value_or(fallback);
}

bool ConfigSection::IsEnabled(const std::string& key, bool bFallback) const
{
    const ConfigNode* const node = FindGivenOrNull(key, false, {});
    if (node == nullptr)
    {
        return bFallback;
    }
    const bool* const value = std::get_if<bool>(&node->value);
    if (value == nullptr)
    {
        AddMistake(key, MakeWrongText("true or false", *node));
        return bFallback;
    }
    return *value;
}

std::chrono::milliseconds ConfigSection::GetDuration(
    const std::string& key,
    std::chrono::milliseconds min,
    std::chrono::milliseconds max,
    std::chrono::milliseconds fallback) const
{
    const auto duration = GetParsed<std::chrono::milliseconds>(key, ParseDuration, fallback);
    if (duration >= min && duration <= max)
    {
        return duration;
    }
    AddMistake(
        key,
        fmt::format(
            "expected a duration from '{}' to '{}', found '{}'",
            MakeDurationText(min),
            MakeDurationText(max),
            MakeDurationText(duration)));
    return fallback;
}

Endpoint ConfigSection::GetEndpoint(const std::string& key, const Endpoint& fallback) const
{
    return GetParsed<Endpoint>(key, ParseEndpoint, fallback);
}

Url ConfigSection::GetUrl(const std::string& key, const std::vector<EUrlScheme>& allowed) const
{
    return GetParsed<Url>(key, [&allowed](std::string_view text) { return ParseUrl(text, allowed); });
}

std::optional<Url> ConfigSection::GetUrlOrNull(const std::string& key, const std::vector<EUrlScheme>& allowed) const
{
    return HasKey(key) ? std::optional<Url>(GetUrl(key, allowed)) : std::nullopt;
}

std::vector<std::string> ConfigSection::GetStringList(const std::string& key) const
{
    std::vector<std::string> values;
    const ConfigNode* const node = FindGivenOrNull(key, false, {});
    if (node == nullptr)
    {
        return values;
    }
    const auto* const array = std::get_if<ConfigNode::Array>(&node->value);
    if (array == nullptr)
    {
        AddMistake(key, MakeWrongText("a list of strings", *node));
        return values;
    }
    for (const std::unique_ptr<ConfigNode>& item : *array)
    {
        const auto* const text = std::get_if<std::string>(&item->value);
        if (text == nullptr)
        {
            AddMistake(key, MakeWrongText("a list of strings", *item));
            return {};
        }
        values.push_back(*text);
    }
    return values;
}

const ConfigNode* ConfigSection::FindValueOrNull(const std::string& key) const
{
    const ConfigNode* const nodeOrNull = FindGivenOrNull(key, false, {});
    if (nodeOrNull != nullptr)
    {
        _document->NoteAllAsked(*nodeOrNull, ConfigDocument::JoinPath(_path, key));
    }
    return nodeOrNull;
}

ConfigSection ConfigSection::GetSection(const std::string& name) const
{
    const ConfigNode* node = FindGivenOrNull(name, false, {});
    const std::string path = ConfigDocument::JoinPath(_path, name);
    if (node != nullptr && !std::holds_alternative<ConfigNode::Table>(node->value))
    {
        _document->RefuseTable(node, path, MakeWrongText(A_TABLE, *node));
        node = nullptr;
    }
    return {_document, node, path};
}

std::vector<ConfigSection> ConfigSection::GetSectionList(const std::string& name) const
{
    std::vector<ConfigSection> sections;
    const ConfigNode* const node = FindGivenOrNull(name, false, {});
    if (node == nullptr)
    {
        return sections;
    }
    const std::string path = ConfigDocument::JoinPath(_path, name);
    const auto* const array = std::get_if<ConfigNode::Array>(&node->value);
    if (array == nullptr)
    {
        AddMistake(name, MakeWrongText(fmt::format("a list of tables ([[{}]])", path), *node));
        return sections;
    }
    for (std::size_t index = 0; index < array->size(); ++index)
    {
        const ConfigNode* const item = (*array)[index].get();
        if (!std::holds_alternative<ConfigNode::Table>(item->value))
        {
            AddMistake(name, MakeWrongText(A_TABLE, *item));
            continue;
        }
        sections.emplace_back(_document, item, fmt::format("{}[{}]", path, index));
    }
    return sections;
}

std::vector<std::string> ConfigSection::GetNames() const
{
    std::vector<std::string> names;
    if (_nodeOrNull != nullptr)
    {
        for (const auto& [name, node] : std::get<ConfigNode::Table>(_nodeOrNull->value))
        {
            names.push_back(name);
        }
    }
    return names;
}

bool ConfigSection::HasKey(const std::string& key) const
{
    return FindGivenOrNull(key, false, {}) != nullptr;
}

void ConfigSection::AddMistake(const std::string& key, const std::string& text) const
{
    if (key.empty())
    {
        _document->AddMistake(_nodeOrNull, _path, text);
        return;
    }
    const ConfigNode* const node = FindOrNull(key);
    _document->AddMistake(node != nullptr ? node : _nodeOrNull, ConfigDocument::JoinPath(_path, key), text);
}

void ConfigSection::Refuse(const std::string& text) const
{
    _document->RefuseTable(_nodeOrNull, _path, text);
}

const std::string& ConfigSection::GetPath() const noexcept
{
    return _path;
}

const ConfigNode* ConfigSection::FindOrNull(const std::string& key) const
{
    if (_nodeOrNull == nullptr)
    {
        return nullptr;
    }
    const auto& table = std::get<ConfigNode::Table>(_nodeOrNull->value);
    const auto found = table.find(key);
    return found == table.end() ? nullptr : found->second.get();
}

const ConfigNode* ConfigSection::FindGivenOrNull(const std::string& key, bool bRequired, std::string_view allowed) const
{
    _document->NoteAsked(_path, key);
    const ConfigNode* const node = FindOrNull(key);
    if (node == nullptr && bRequired)
    {
        AddMissing(key, allowed);
    }
    return node;
}

std::optional<std::string> ConfigSection::GetStringIfGivenOrNull(const std::string& key, bool bRequired) const
{
    const ConfigNode* const node = FindGivenOrNull(key, bRequired, A_STRING);
    if (node == nullptr)
    {
        return std::nullopt;
    }
    const auto* const text = std::get_if<std::string>(&node->value);
    if (text == nullptr)
    {
        AddMistake(key, MakeWrongText(A_STRING, *node));
        return std::nullopt;
    }
    return *text;
}

std::optional<std::int64_t> ConfigSection::GetIntegerIfGivenOrNull(
    const std::string& key,
    std::int64_t min,
    std::int64_t max,
    bool bRequired) const
{
    const std::string allowed = fmt::format("an integer from {} to {}", min, max);
    const ConfigNode* const node = FindGivenOrNull(key, bRequired, allowed);
    if (node == nullptr)
    {
        return std::nullopt;
    }
    const auto* const integer = std::get_if<std::int64_t>(&node->value);
    if (integer == nullptr || *integer < min || *integer > max)
    {
        AddMistake(key, MakeWrongText(allowed, *node));
        return std::nullopt;
    }
    return *integer;
}

std::optional<double> ConfigSection::GetNumberIfGivenOrNull(
    const std::string& key,
    double min,
    double max,
    bool bRequired) const
{
    const std::string allowed = fmt::format("a number from {} to {}", min, max);
    const ConfigNode* const node = FindGivenOrNull(key, bRequired, allowed);
    if (node == nullptr)
    {
        return std::nullopt;
    }
    const auto* const integer = std::get_if<std::int64_t>(&node->value);
    const auto* const number = std::get_if<double>(&node->value);
    std::optional<double> value;
    if (integer != nullptr)
    {
        value = static_cast<double>(*integer);
    }
    else if (number != nullptr)
    {
        value = *number;
    }
    // Written so that "nan" fails, too.
    if (!value.has_value() || !(*value >= min && *value <= max))
    {
        AddMistake(key, MakeWrongText(allowed, *node));
        return std::nullopt;
    }
    return value;
}

std::optional<std::string> ConfigSection::GetWordIfGivenOrNull(
    const std::string& key,
    std::initializer_list<std::string_view> words,
    bool bRequired) const
{
    const ConfigNode* const node = FindGivenOrNull(key, bRequired, JoinWords(words));
    if (node == nullptr)
    {
        return std::nullopt;
    }
    const auto* const text = std::get_if<std::string>(&node->value);
    if (text == nullptr || std::find(words.begin(), words.end(), *text) == words.end())
    {
        AddMistake(key, MakeWrongText(JoinWords(words), *node));
        return std::nullopt;
    }
    return *text;
}

void ConfigSection::AddMissing(const std::string& key, std::string_view allowed) const
{
    AddMistake(key, fmt::format("missing; give {}", allowed.empty() ? A_STRING : allowed));
}

void ConfigSection::AddParseMistake(const std::string& key, const Core::Error& error) const
{
    AddMistake(key, Core::Describe(error));
}

} // namespace ACS::Apps
