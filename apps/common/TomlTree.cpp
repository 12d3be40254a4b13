#include "common/TomlTree.hpp"

#include <toml++/toml.h>

#include <utility>
#include <vector>

namespace ACS::Apps
{

namespace
{

/// A node of toml++ and the place of its copy.
using Work = std::vector<std::pair<const toml::node*, ConfigNode*>>;

void TakeTable(const toml::table& source, ConfigNode& target, Work& work)
{
    ConfigNode::Table table;
    for (const auto& [key, value] : source)
    {
        const auto place = table.emplace(std::string(key.str()), std::make_unique<ConfigNode>()).first;
        work.emplace_back(&value, place->second.get());
    }
    target.value = std::move(table);
}

void TakeArray(const toml::array& source, ConfigNode& target, Work& work)
{
    ConfigNode::Array array;
    for (const toml::node& value : source)
    {
        array.push_back(std::make_unique<ConfigNode>());
        work.emplace_back(&value, array.back().get());
    }
    target.value = std::move(array);
}

void TakeScalar(const toml::node& source, ConfigNode& target)
{
    if (const auto* const string = source.as_string())
    {
        target.value = string->get();
    }
    else if (const auto* const integer = source.as_integer())
    {
        target.value = integer->get();
    }
    else if (const auto* const number = source.as_floating_point())
    {
        target.value = number->get();
    }
    else if (const auto* const boolean = source.as_boolean())
    {
        target.value = boolean->get();
    }
    else
    {
        target.value = ConfigNode::Other{};
    }
}

ConfigNode MakeTree(const toml::table& document, bool bOverride)
{
    ConfigNode root;
    Work work{{&document, &root}};
    while (!work.empty())
    {
        const auto [source, target] = work.back();
        work.pop_back();
        target->bOverride = bOverride;
        target->line = source->source().begin.line;
        if (const toml::table* const table = source->as_table())
        {
            TakeTable(*table, *target, work);
        }
        else if (const toml::array* const array = source->as_array())
        {
            TakeArray(*array, *target, work);
        }
        else
        {
            TakeScalar(*source, *target);
        }
    }
    return root;
}

} // namespace

tl::expected<ConfigNode, TomlMistake> ParseToml(std::string_view text, bool bOverride)
{
    try
    {
        return MakeTree(toml::parse(text), bOverride);
    }
    catch (const toml::parse_error& error)
    {
        return tl::unexpected<TomlMistake>(TomlMistake{error.source().begin.line, std::string(error.description())});
    }
}

} // namespace ACS::Apps
