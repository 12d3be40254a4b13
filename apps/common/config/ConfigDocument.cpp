#include "common/config/ConfigDocument.hpp"

#include <acs/core/ControlCharacter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view OVERRIDE = "--set";

/// Maximum edit distance at which an unknown key is reported as a typing error of a known one.
constexpr std::size_t MAX_SLIP = 3;

bool IsBareKey(std::string_view key)
{
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char character) {
        return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z')
            || (character >= '0' && character <= '9') || character == '-' || character == '_';
    });
}

/// Quotes a key as TOML requires it.
std::string QuoteKey(std::string_view key)
{
    std::string text;
    for (const char character : key)
    {
        text += Core::IsControlCharacter(character) ? fmt::format("\\u{:04X}", static_cast<unsigned char>(character))
                                                    : std::string(1, character);
    }
    return fmt::format("\"{}\"", text);
}

/// Edit distance: number of characters to insert, delete, replace or exchange with their neighbour.
std::size_t CountEdits(std::string_view left, std::string_view right)
{
    std::vector<std::size_t> beforePrevious;
    std::vector<std::size_t> previous(right.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    std::vector<std::size_t> current(right.size() + 1);
    for (std::size_t row = 1; row <= left.size(); ++row)
    {
        current[0] = row;
        for (std::size_t column = 1; column <= right.size(); ++column)
        {
            const std::size_t replaced = previous[column - 1] + (left[row - 1] == right[column - 1] ? 0U : 1U);
            current[column] = std::min({replaced, previous[column] + 1, current[column - 1] + 1});
            const bool bExchanged =
                row > 1 && column > 1 && left[row - 1] == right[column - 2] && left[row - 2] == right[column - 1];
            if (bExchanged)
            {
                current[column] = std::min(current[column], beforePrevious[column - 2] + 1);
            }
        }
        beforePrevious = std::exchange(previous, current);
    }
    return previous.back();
}

std::optional<toml::table> ParseOverrideOrNull(const std::string& text)
{
    try
    {
        return toml::parse(text, OVERRIDE);
    }
    catch (const toml::parse_error&)
    {
        return std::nullopt;
    }
}

std::string MakeUnknownText(const std::set<std::string>& known, const std::string& key)
{
    if (known.empty())
    {
        return "unknown key; no key is allowed in this table";
    }
    const auto nearest =
        std::ranges::min_element(known, {}, [&key](const std::string& other) { return CountEdits(key, other); });
    if (CountEdits(key, *nearest) <= std::min(MAX_SLIP, key.size() / 2))
    {
        return fmt::format("unknown key; did you mean '{}'?", *nearest);
    }
    return fmt::format("unknown key; allowed here: {}", fmt::join(known, ", "));
}

} // namespace

ConfigDocument::ConfigDocument(std::string_view text, std::string fileName)
    : _fileName(std::move(fileName))
{
    try
    {
        _root = toml::parse(text, _fileName);
    }
    catch (const toml::parse_error& error)
    {
        AddErrorAt(error.source(), {}, fmt::format("not TOML: {}", error.description()));
        _bUnreadable = true;
    }
}

std::shared_ptr<ConfigDocument> ConfigDocument::MakeUnreadable(std::string fileName, const std::string& reason)
{
    auto document = std::make_shared<ConfigDocument>(std::string_view(), std::move(fileName));
    document->AddError(nullptr, {}, reason);
    document->_bUnreadable = true;
    return document;
}

void ConfigDocument::Override(const std::string& text)
{
    const std::size_t equals = text.find('=');
    const std::string key = text.substr(0, equals);
    // A line break, '#' or '[' in the key would change the structure of the TOML text.
    std::optional<toml::table> table = equals != std::string::npos && key.find_first_of("\n\r#[") == std::string::npos
        ? ParseOverrideOrNull(key + " = ''")
        : std::nullopt;
    if (!table.has_value())
    {
        const toml::source_region source{{}, {}, std::make_shared<const std::string>(OVERRIDE)};
        AddErrorAt(source, {}, fmt::format("'{}': write table.key=value", text));
        return;
    }
    const std::string value = text.substr(equals + 1);
    const bool bOneLine = value.find_first_of("\n\r") == std::string::npos;
    std::optional<toml::table> typed = bOneLine ? ParseOverrideOrNull(key + " = " + value) : std::nullopt;
    if (!typed.has_value())
    {
        // Anything that is not a TOML value is a string.
        toml::node* leaf = &*table;
        while (leaf->is_table())
        {
            leaf = &leaf->as_table()->begin()->second;
        }
        leaf->as_string()->get() = value;
    }
    const toml::table path = *table;
    Replace(path, std::move(typed.has_value() ? *typed : *table));
}

void ConfigDocument::Replace(const toml::table& path, toml::table source)
{
    toml::table* target = &_root;
    const toml::table* below = &path;
    toml::table* from = &source;
    for (;;)
    {
        const auto first = from->begin();
        below = below->begin()->second.as_table();
        auto* const present = target->get_as<toml::table>(first->first.str());
        if (below == nullptr || present == nullptr)
        {
            target->insert_or_assign(
                first->first,
                std::move(first->second)); // a copy would not know its place in the text
            return;
        }
        target = present;
        from = first->second.as_table();
    }
}

const toml::table& ConfigDocument::GetRoot() const noexcept
{
    return _root;
}

void ConfigDocument::AddKnownKey(const toml::table& table, const std::string& key)
{
    _knownKeys[&table].insert(key);
}

void ConfigDocument::AcceptAll(const toml::node& value)
{
    _accepted.insert(&value);
}

void ConfigDocument::AddError(const toml::node* nodeOrNull, const std::string& path, const std::string& text)
{
    AddErrorAt(GetSource(nodeOrNull), path, text);
}

void ConfigDocument::RefuseTable(const toml::node* nodeOrNull, const std::string& path, const std::string& text)
{
    AddError(nodeOrNull, path, text);
    _refused.insert(path);
}

const toml::node* ConfigDocument::FindNearestOrNull(const std::string& path) const
{
    const toml::node* nearest = &_root;
    for (std::size_t begin = 0; begin <= path.size() && nearest->is_table();)
    {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        const toml::node* const child = nearest->as_table()->get(std::string_view(path).substr(begin, end - begin));
        if (child == nullptr)
        {
            break;
        }
        nearest = child;
        begin = end + 1;
    }
    return nearest == &_root ? nullptr : nearest;
}

std::vector<std::string> ConfigDocument::MakeConfigErrors() const
{
    std::vector<ConfigError> errors = _errors;
    if (!_bUnreadable)
    {
        FindUnknown(errors);
    }
    std::ranges::stable_sort(errors, {}, [](const ConfigError& error) {
        return std::pair(error.bOverride, error.line);
    });
    std::vector<std::string> texts;
    std::ranges::transform(errors, std::back_inserter(texts), &ConfigError::text);
    return texts;
}

std::map<std::string, std::string> ConfigDocument::MakeValues() const
{
    std::map<std::string, std::string> values;
    std::vector<std::pair<std::string, const toml::node*>> work{{std::string(), &_root}};
    while (!work.empty())
    {
        const auto [path, node] = std::move(work.back());
        work.pop_back();
        if (const toml::table* const table = node->as_table())
        {
            for (auto&& [key, value] : *table)
            {
                work.emplace_back(JoinPath(path, std::string(key.str())), &value);
            }
            continue;
        }
        std::ostringstream text;
        text << toml::toml_formatter(*node, toml::format_flags::allow_unicode_strings);
        values.emplace(path, text.str());
    }
    return values;
}

std::string ConfigDocument::JoinPath(const std::string& path, const std::string& key)
{
    const std::string name = IsBareKey(key) ? key : QuoteKey(key);
    return path.empty() ? name : fmt::format("{}.{}", path, name);
}

void ConfigDocument::AddErrorAt(const toml::source_region& source, const std::string& path, const std::string& text)
{
    const bool bKnown = !path.empty() && (IsInRefused(path) || !_pathsWithErrors.insert(path).second);
    if (!_bUnreadable && !bKnown)
    {
        _errors.push_back(MakeConfigError(source, path, text));
    }
}

toml::source_region ConfigDocument::GetSource(const toml::node* nodeOrNull) const
{
    const bool bHasLine = nodeOrNull != nullptr && nodeOrNull != &_root;
    return bHasLine ? nodeOrNull->source() : toml::source_region{};
}

ConfigDocument::ConfigError ConfigDocument::MakeConfigError(
    const toml::source_region& source,
    const std::string& path,
    const std::string& text) const
{
    const bool bOverride = source.path != nullptr && *source.path == OVERRIDE;
    const std::uint32_t line = bOverride ? 0 : source.begin.line;
    std::string where = bOverride ? std::string(OVERRIDE) : _fileName;
    where += line == 0 ? std::string() : fmt::format(":{}", line);
    where += path.empty() ? std::string() : fmt::format(": {}", path);
    std::string sentence = fmt::format("{}: {}", where, text);
    std::ranges::replace_if(sentence, Core::IsControlCharacter, '?'); // in keys, values and quotations
    return {bOverride, line, std::move(sentence)};
}

bool ConfigDocument::IsInRefused(const std::string& path) const
{
    return std::ranges::any_of(_refused, [&path](const std::string& table) { return path.starts_with(table + "."); });
}

void ConfigDocument::FindUnknown(std::vector<ConfigError>& out) const
{
    static const std::set<std::string> NONE;
    std::vector<std::pair<const toml::node*, std::string>> work{{&_root, std::string()}};
    while (!work.empty())
    {
        const auto [node, path] = std::move(work.back());
        work.pop_back();
        if (_accepted.contains(node))
        {
            continue;
        }
        if (const toml::array* const array = node->as_array())
        {
            for (std::size_t index = 0; index < array->size(); ++index)
            {
                work.emplace_back(array->get(index), fmt::format("{}[{}]", path, index));
            }
        }
        else if (const toml::table* const table = node->as_table())
        {
            const auto found = _knownKeys.find(table);
            const std::set<std::string>& known = found == _knownKeys.end() ? NONE : found->second;
            for (auto&& [tomlKey, value] : *table)
            {
                const std::string key(tomlKey.str());
                const std::string keyPath = JoinPath(path, key);
                if (known.contains(key))
                {
                    work.emplace_back(&value, keyPath);
                }
                else if (!IsInRefused(keyPath))
                {
                    out.push_back(MakeConfigError(value.source(), keyPath, MakeUnknownText(known, key)));
                }
            }
        }
    }
}

} // namespace ACS::Apps
