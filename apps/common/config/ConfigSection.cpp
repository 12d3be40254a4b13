#include "common/config/ConfigSection.hpp"

#include "common/config/ConfigDocument.hpp"
#include "common/config/DurationText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view A_STRING = "a string";
constexpr std::string_view A_TABLE = "a table";

std::string DescribeValue(const toml::node& node)
{
    return node.visit([](const auto& value) -> std::string {
        if constexpr (toml::is_table<decltype(value)>)
        {
            return "a table";
        }
        else if constexpr (toml::is_array<decltype(value)>)
        {
            return "a list";
        }
        else if constexpr (toml::is_string<decltype(value)>)
        {
            return fmt::format("the string '{}'", value.get());
        }
        else if constexpr (toml::is_integer<decltype(value)>)
        {
            return fmt::format("the integer {}", value.get());
        }
        else if constexpr (toml::is_floating_point<decltype(value)>)
        {
            return fmt::format("the number {}", value.get());
        }
        else if constexpr (toml::is_boolean<decltype(value)>)
        {
            return value.get() ? "true" : "false";
        }
        else
        {
            return "a date or time";
        }
    });
}

std::string MakeWrongText(std::string_view allowed, const toml::node& node)
{
    return fmt::format("expected {}, found {}", allowed, DescribeValue(node));
}

std::string JoinWords(std::initializer_list<std::string_view> words)
{
    return fmt::format("'{}'", fmt::join(words, "' or '"));
}

} // namespace

ConfigSection::ConfigSection(std::shared_ptr<ConfigDocument> document, const toml::table* tableOrNull, std::string path)
    : _document(std::move(document)),
      _tableOrNull(tableOrNull),
      _path(std::move(path)),
      _placeOrNull(tableOrNull)
{
}

std::string ConfigSection::GetString(const std::string& key) const
{
    return ReadStringOrNull(key, true).value_or(std::string());
}

std::string ConfigSection::GetString(const std::string& key, const std::string& fallback) const
{
    return ReadStringOrNull(key, false).value_or(fallback);
}

std::optional<std::string> ConfigSection::GetStringOrNull(const std::string& key) const
{
    return ReadStringOrNull(key, false);
}

std::string ConfigSection::GetWord(const std::string& key, std::initializer_list<std::string_view> words) const
{
    return ReadWordOrNull(key, words, true).value_or(std::string());
}

std::string ConfigSection::GetWord(
    const std::string& key,
    std::initializer_list<std::string_view> words,
    const std::string& fallback) const
{
    return ReadWordOrNull(key, words, false).value_or(fallback);
}

std::int64_t ConfigSection::GetInteger(const std::string& key, std::int64_t min, std::int64_t max) const
{
    return ReadIntegerOrNull(key, min, max, true).value_or(min);
}

std::int64_t ConfigSection::GetInteger(
    const std::string& key,
    std::int64_t min,
    std::int64_t max,
    std::int64_t fallback) const
{
    return ReadIntegerOrNull(key, min, max, false).value_or(fallback);
}

double ConfigSection::GetNumber(const std::string& key, double min, double max) const
{
    return ReadNumberOrNull(key, min, max, true).value_or(min);
}

double ConfigSection::GetNumber(const std::string& key, double min, double max, double fallback) const
{
    return ReadNumberOrNull(key, min, max, false).value_or(fallback);
}

bool ConfigSection::IsEnabled(const std::string& key, bool bFallback) const
{
    const toml::node* const nodeOrNull = FindGivenOrNull(key);
    if (nodeOrNull == nullptr)
    {
        return bFallback;
    }
    const std::optional<bool> bGiven = nodeOrNull->value_exact<bool>();
    if (!bGiven.has_value())
    {
        AddError(key, MakeWrongText("true or false", *nodeOrNull));
    }
    return bGiven.value_or(bFallback);
}

std::chrono::milliseconds ConfigSection::GetDuration(
    const std::string& key,
    std::chrono::milliseconds min,
    std::chrono::milliseconds max,
    std::chrono::milliseconds fallback) const
{
    const toml::node* const nodeOrNull = FindGivenOrNull(key);
    if (nodeOrNull != nullptr && !nodeOrNull->is_string())
    {
        AddError(key, MakeWrongText(DURATION_FORM, *nodeOrNull));
        return fallback;
    }
    const auto duration = GetParsed<std::chrono::milliseconds>(key, ParseDuration, fallback);
    if (duration >= min && duration <= max)
    {
        return duration;
    }
    AddError(
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

Url ConfigSection::GetURL(const std::string& key, const std::vector<EUrlScheme>& allowed) const
{
    return GetParsed<Url>(key, [&allowed](std::string_view text) { return ParseURL(text, allowed); });
}

std::vector<std::string> ConfigSection::GetStringList(const std::string& key) const
{
    std::vector<std::string> values;
    const toml::node* const nodeOrNull = FindGivenOrNull(key);
    if (nodeOrNull == nullptr)
    {
        return values;
    }
    if (!nodeOrNull->is_array())
    {
        AddError(key, MakeWrongText("a list of strings", *nodeOrNull));
        return values;
    }
    for (const toml::node& item : *nodeOrNull->as_array())
    {
        if (!item.is_string())
        {
            AddError(key, MakeWrongText("a list of strings", item));
            return {};
        }
        values.push_back(item.as_string()->get());
    }
    return values;
}

const toml::node* ConfigSection::FindValueOrNull(const std::string& key) const
{
    const toml::node* const nodeOrNull = FindGivenOrNull(key);
    if (nodeOrNull != nullptr)
    {
        _document->AcceptAll(*nodeOrNull);
    }
    return nodeOrNull;
}

ConfigSection ConfigSection::GetSection(const std::string& name) const
{
    const toml::node* const nodeOrNull = FindGivenOrNull(name);
    const std::string path = ConfigDocument::JoinPath(_path, name);
    if (nodeOrNull != nullptr && !nodeOrNull->is_table())
    {
        _document->RefuseTable(nodeOrNull, path, MakeWrongText(A_TABLE, *nodeOrNull));
    }
    ConfigSection section(_document, nodeOrNull == nullptr ? nullptr : nodeOrNull->as_table(), path);
    if (section._tableOrNull == nullptr && !_path.empty())
    {
        section._placeOrNull = _placeOrNull;
    }
    return section;
}

std::vector<ConfigSection> ConfigSection::GetSectionList(const std::string& name) const
{
    std::vector<ConfigSection> sections;
    const toml::node* const nodeOrNull = FindGivenOrNull(name);
    if (nodeOrNull == nullptr)
    {
        return sections;
    }
    const std::string path = ConfigDocument::JoinPath(_path, name);
    const toml::array* const arrayOrNull = nodeOrNull->as_array();
    if (arrayOrNull == nullptr)
    {
        AddError(name, MakeWrongText(fmt::format("a list of tables ([[{}]])", path), *nodeOrNull));
        return sections;
    }
    for (std::size_t index = 0; index < arrayOrNull->size(); ++index)
    {
        const toml::node& item = *arrayOrNull->get(index);
        if (!item.is_table())
        {
            AddError(name, MakeWrongText(A_TABLE, item));
            continue;
        }
        sections.emplace_back(_document, item.as_table(), fmt::format("{}[{}]", path, index));
    }
    return sections;
}

std::vector<std::string> ConfigSection::GetNames() const
{
    std::vector<std::string> names;
    if (_tableOrNull != nullptr)
    {
        for (auto&& [key, value] : *_tableOrNull)
        {
            names.emplace_back(key.str());
        }
    }
    return names;
}

bool ConfigSection::HasKey(const std::string& key) const
{
    return FindGivenOrNull(key) != nullptr;
}

void ConfigSection::AddError(const std::string& key, const std::string& text) const
{
    const toml::node* const nodeOrNull = key.empty() ? nullptr : FindOrNull(key);
    const std::string path = key.empty() ? _path : ConfigDocument::JoinPath(_path, key);
    _document->AddError(nodeOrNull != nullptr ? nodeOrNull : _placeOrNull, path, text);
}

void ConfigSection::ReportRemoved(const std::string& key, std::string_view replacement) const
{
    if (FindOrNull(key) != nullptr)
    {
        static_cast<void>(FindValueOrNull(key)); // else it would be reported as unknown too
        AddError(key, fmt::format("removed: {}", replacement));
    }
}

void ConfigSection::Refuse(const std::string& text) const
{
    _document->RefuseTable(_tableOrNull, _path, text);
}

const std::string& ConfigSection::GetPath() const noexcept
{
    return _path;
}

const toml::node* ConfigSection::FindOrNull(const std::string& key) const
{
    return _tableOrNull == nullptr ? nullptr : _tableOrNull->get(key);
}

const toml::node* ConfigSection::FindGivenOrNull(const std::string& key) const
{
    if (_tableOrNull != nullptr)
    {
        _document->AddKnownKey(*_tableOrNull, key);
    }
    return FindOrNull(key);
}

template <typename TRead>
auto ConfigSection::ReadOrNull(const std::string& key, bool bRequired, std::string_view allowed, TRead readOrNull) const
    -> decltype(readOrNull(std::declval<const toml::node&>()))
{
    const toml::node* const nodeOrNull = FindGivenOrNull(key);
    if (nodeOrNull == nullptr)
    {
        if (bRequired)
        {
            AddMissing(key, allowed);
        }
        return {};
    }
    auto valueOrNull = readOrNull(*nodeOrNull);
    if (!valueOrNull.has_value())
    {
        AddError(key, MakeWrongText(allowed, *nodeOrNull));
    }
    return valueOrNull;
}

std::optional<std::string> ConfigSection::ReadStringOrNull(const std::string& key, bool bRequired) const
{
    return ReadOrNull(key, bRequired, A_STRING, [](const toml::node& node) { return node.value_exact<std::string>(); });
}

std::optional<std::int64_t> ConfigSection::ReadIntegerOrNull(
    const std::string& key,
    std::int64_t min,
    std::int64_t max,
    bool bRequired) const
{
    return ReadOrNull(
        key,
        bRequired,
        fmt::format("an integer from {} to {}", min, max),
        [min, max](const toml::node& node) {
            const std::optional<std::int64_t> value = node.value_exact<std::int64_t>();
            return value >= min && value <= max ? value : std::nullopt;
        });
}

std::optional<double> ConfigSection::ReadNumberOrNull(const std::string& key, double min, double max, bool bRequired)
    const
{
    return ReadOrNull(
        key,
        bRequired,
        fmt::format("a number from {} to {}", min, max),
        [min, max](const toml::node& node) {
            // Not a boolean, which toml++ would convert; "nan" fails the comparisons.
            const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
            return value >= min && value <= max ? value : std::nullopt;
        });
}

std::optional<std::string> ConfigSection::ReadWordOrNull(
    const std::string& key,
    std::initializer_list<std::string_view> words,
    bool bRequired) const
{
    return ReadOrNull(key, bRequired, JoinWords(words), [words](const toml::node& node) {
        const std::optional<std::string> text = node.value_exact<std::string>();
        const bool bListed = text.has_value() && std::ranges::find(words, *text) != words.end();
        return bListed ? text : std::nullopt;
    });
}

void ConfigSection::AddMissing(const std::string& key, std::string_view allowed) const
{
    AddError(key, fmt::format("missing; give {}", allowed.empty() ? A_STRING : allowed));
}

void ConfigSection::AddParseError(const std::string& key, const Core::Error& error) const
{
    AddError(key, Core::Describe(error));
}

} // namespace ACS::Apps
