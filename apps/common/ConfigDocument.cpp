#include "common/ConfigDocument.hpp"

#include "common/TomlTree.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace ACS::Apps
{

namespace
{

/// A key this far from a known one, in edits, is taken for a slip of the pen.
constexpr std::size_t MAX_SLIP = 3;

bool IsBareKey(std::string_view key)
{
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char character) {
        return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z')
            || (character >= '0' && character <= '9') || character == '-' || character == '_';
    });
}

/// In quotes, as TOML has it.
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

/// How many characters must be inserted, removed, replaced or exchanged with their neighbour to make one of the other.
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

/// Tables are joined key by key; anything else replaces what was there.
void Merge(ConfigNode& target, ConfigNode source)
{
    std::vector<std::pair<ConfigNode*, ConfigNode>> work;
    work.emplace_back(&target, std::move(source));
    while (!work.empty())
    {
        auto [place, node] = std::move(work.back());
        work.pop_back();
        auto* const placeTable = std::get_if<ConfigNode::Table>(&place->value);
        auto* const nodeTable = std::get_if<ConfigNode::Table>(&node.value);
        if (placeTable == nullptr || nodeTable == nullptr)
        {
            *place = std::move(node);
            continue;
        }
        for (auto& [key, value] : *nodeTable)
        {
            const auto [found, bNew] = placeTable->try_emplace(key, nullptr);
            if (bNew)
            {
                found->second = std::move(value);
            }
            else
            {
                work.emplace_back(found->second.get(), std::move(*value));
            }
        }
    }
}

/// What is no table; of the tables in a list, their keys. Lists and tables alternate in depth as the file has them.
std::string MakeValueTextRecursive(const ConfigNode& node) // NOLINT(misc-no-recursion): as deep as the parser took it
{
    return std::visit(
        Core::Overloaded{
            [](const ConfigNode::Table& table) { // NOLINT(misc-no-recursion)
                std::string text = "{";
                for (const auto& [key, value] : table)
                {
                    text += fmt::format("{}={},", key, MakeValueTextRecursive(*value));
                }
                return text + "}";
            },
            [](const ConfigNode::Array& array) { // NOLINT(misc-no-recursion)
                std::string text = "[";
                for (const auto& value : array)
                {
                    text += MakeValueTextRecursive(*value) + ",";
                }
                return text + "]";
            },
            [](const std::string& text) { return fmt::format("\"{}\"", text); },
            [](std::int64_t integer) { return fmt::format("{}", integer); },
            [](double number) { return fmt::format("{}", number); },
            [](bool bValue) { return std::string(bValue ? "true" : "false"); },
            [](const ConfigNode::Other&) {
                return std::string("?");
            }},
        node.value);
}

} // namespace

ConfigDocument::ConfigDocument(std::string_view text, std::string fileName)
    : _fileName(std::move(fileName))
{
    auto root = ParseToml(text, false);
    if (root.has_value())
    {
        _root = std::move(*root);
        _root.line = 0;
        return;
    }
    ConfigNode place;
    place.line = root.error().line;
    AddMistake(&place, {}, fmt::format("not TOML: {}", root.error().text));
    _bUnreadable = true;
}

std::shared_ptr<ConfigDocument> ConfigDocument::MakeUnreadable(std::string fileName, const std::string& reason)
{
    auto document = std::make_shared<ConfigDocument>(std::string_view(), std::move(fileName));
    document->AddMistake(nullptr, {}, reason);
    document->_bUnreadable = true;
    return document;
}

void ConfigDocument::Override(const std::string& text)
{
    ConfigNode place;
    place.bOverride = true;
    const std::size_t equals = text.find('=');
    const std::string key = text.substr(0, equals);
    // A key with a line break or '#' in it would make other TOML than it seems to.
    const bool bOneKey = equals != std::string::npos && key.find_first_of("\n\r#[") == std::string::npos
        && ParseToml(key + " = 0", true).has_value();
    if (!bOneKey)
    {
        AddMistake(&place, {}, fmt::format("'{}': write table.key=value", text));
        return;
    }
    const std::string value = text.substr(equals + 1);
    const bool bOneLine = value.find_first_of("\n\r") == std::string::npos;
    auto node = bOneLine ? ParseToml(fmt::format("{} = {}", key, value), true)
                         : tl::expected<ConfigNode, TomlMistake>(tl::unexpect, TomlMistake{});
    if (!node.has_value())
    {
        node = ParseToml(key + " = ''", true);
        ConfigNode* leaf = &*node;
        while (auto* const table = std::get_if<ConfigNode::Table>(&leaf->value))
        {
            leaf = table->begin()->second.get();
        }
        leaf->value = value;
    }
    node->bOverride = false;
    Merge(_root, std::move(*node));
}

const ConfigNode& ConfigDocument::GetRoot() const noexcept
{
    return _root;
}

void ConfigDocument::NoteAsked(const std::string& tablePath, const std::string& key)
{
    _askedByTable[tablePath].insert(key);
}

void ConfigDocument::NoteAllAsked(const ConfigNode& value, const std::string& path)
{
    std::vector<std::pair<const ConfigNode*, std::string>> work;
    work.emplace_back(&value, path);
    while (!work.empty())
    {
        const auto [node, nodePath] = std::move(work.back());
        work.pop_back();
        if (const auto* const array = std::get_if<ConfigNode::Array>(&node->value))
        {
            for (std::size_t index = 0; index < array->size(); ++index)
            {
                work.emplace_back((*array)[index].get(), fmt::format("{}[{}]", nodePath, index));
            }
        }
        else if (const auto* const table = std::get_if<ConfigNode::Table>(&node->value))
        {
            for (const auto& [key, entry] : *table)
            {
                NoteAsked(nodePath, key);
                work.emplace_back(entry.get(), JoinPath(nodePath, key));
            }
        }
    }
}

void ConfigDocument::AddMistake(const ConfigNode* nodeOrNull, const std::string& path, const std::string& text)
{
    const bool bTold = !path.empty() && (IsInRefused(path) || !_mistaken.insert(path).second);
    if (_bUnreadable || bTold)
    {
        return;
    }
    const std::string where = path.empty() ? MakeOrigin(nodeOrNull) : MakeOrigin(nodeOrNull) + ": " + path;
    _mistakes.push_back(
        {nodeOrNull != nullptr && nodeOrNull->bOverride,
         nodeOrNull != nullptr ? nodeOrNull->line : 0,
         fmt::format("{}: {}", where, text)});
}

void ConfigDocument::RefuseTable(const ConfigNode* nodeOrNull, const std::string& path, const std::string& text)
{
    AddMistake(nodeOrNull, path, text);
    _refused.insert(path);
}

const ConfigNode* ConfigDocument::FindNearestOrNull(const std::string& path) const
{
    const ConfigNode* nearestOrNull = nullptr;
    const ConfigNode* nodeOrNull = &_root;
    for (std::size_t begin = 0; begin <= path.size();)
    {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        const auto* const tableOrNull = std::get_if<ConfigNode::Table>(&nodeOrNull->value);
        if (tableOrNull == nullptr)
        {
            break;
        }
        const auto found = tableOrNull->find(path.substr(begin, end - begin));
        if (found == tableOrNull->end())
        {
            break;
        }
        nodeOrNull = found->second.get();
        nearestOrNull = nodeOrNull;
        begin = end + 1;
    }
    return nearestOrNull;
}

bool ConfigDocument::IsInRefused(const std::string& path) const
{
    return std::any_of(_refused.begin(), _refused.end(), [&path](const std::string& table) {
        return path.starts_with(table + ".");
    });
}

std::vector<std::string> ConfigDocument::MakeMistakes() const
{
    std::vector<Mistake> mistakes = _mistakes;
    if (!_bUnreadable)
    {
        FindUnknown(mistakes);
    }
    std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& left, const Mistake& right) {
        return std::tie(left.bOverride, left.line) < std::tie(right.bOverride, right.line);
    });
    std::vector<std::string> texts;
    texts.reserve(mistakes.size());
    for (Mistake& mistake : mistakes)
    {
        texts.push_back(std::move(mistake.text));
    }
    return texts;
}

std::string ConfigDocument::JoinPath(const std::string& path, const std::string& key)
{
    const std::string name = IsBareKey(key) ? key : QuoteKey(key);
    return path.empty() ? name : fmt::format("{}.{}", path, name);
}

std::string ConfigDocument::MakeOrigin(const ConfigNode* nodeOrNull) const
{
    if (nodeOrNull != nullptr && nodeOrNull->bOverride)
    {
        return "--set";
    }
    const bool bHasLine = nodeOrNull != nullptr && nodeOrNull->line != 0;
    return bHasLine ? fmt::format("{}:{}", _fileName, nodeOrNull->line) : _fileName;
}

void ConfigDocument::FindUnknown(std::vector<Mistake>& out) const
{
    std::vector<std::pair<const ConfigNode*, std::string>> work;
    work.emplace_back(&_root, std::string());
    while (!work.empty())
    {
        const auto [node, path] = std::move(work.back());
        work.pop_back();
        if (const auto* const array = std::get_if<ConfigNode::Array>(&node->value))
        {
            for (std::size_t index = 0; index < array->size(); ++index)
            {
                work.emplace_back((*array)[index].get(), fmt::format("{}[{}]", path, index));
            }
        }
        else if (const auto* const table = std::get_if<ConfigNode::Table>(&node->value))
        {
            for (const auto& [key, value] : *table)
            {
                if (WasAsked(path, key))
                {
                    work.emplace_back(value.get(), JoinPath(path, key));
                    continue;
                }
                if (IsInRefused(JoinPath(path, key)))
                {
                    continue;
                }
                const std::string where = fmt::format("{}: {}", MakeOrigin(value.get()), JoinPath(path, key));
                out.push_back(
                    {value->bOverride, value->line, fmt::format("{}: {}", where, MakeUnknownText(path, key))});
            }
        }
    }
}

bool ConfigDocument::WasAsked(const std::string& tablePath, const std::string& key) const
{
    const auto asked = _askedByTable.find(tablePath);
    return asked != _askedByTable.end() && asked->second.find(key) != asked->second.end();
}

std::string ConfigDocument::MakeUnknownText(const std::string& tablePath, const std::string& key) const
{
    const auto asked = _askedByTable.find(tablePath);
    if (asked == _askedByTable.end() || asked->second.empty())
    {
        return "unknown key; this table takes none";
    }
    const auto nearest = std::min_element(
        asked->second.begin(),
        asked->second.end(),
        [&key](const std::string& left, const std::string& right) {
            return CountEdits(key, left) < CountEdits(key, right);
        });
    if (CountEdits(key, *nearest) <= std::min(MAX_SLIP, key.size() / 2))
    {
        return fmt::format("unknown key; did you mean '{}'?", *nearest);
    }
    return fmt::format("unknown key; allowed here: {}", fmt::join(asked->second, ", "));
}

std::map<std::string, std::string> ConfigDocument::MakeValues() const
{
    std::map<std::string, std::string> values;
    std::vector<std::pair<std::string, const ConfigNode*>> work{{std::string(), &_root}};
    while (!work.empty())
    {
        const auto [path, nodeOrNull] = std::move(work.back());
        work.pop_back();
        const auto* const tableOrNull = std::get_if<ConfigNode::Table>(&nodeOrNull->value);
        if (tableOrNull == nullptr)
        {
            values.emplace(path, MakeValueTextRecursive(*nodeOrNull));
            continue;
        }
        for (const auto& [key, value] : *tableOrNull)
        {
            work.emplace_back(JoinPath(path, key), value.get());
        }
    }
    return values;
}

} // namespace ACS::Apps
