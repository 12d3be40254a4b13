#include "common/TomlTree.hpp"

#include <toml++/toml.h>

#include <utility>

namespace ACS::Apps
{

namespace
{

ConfigNode MakeNodeRecursive(const toml::node& source, bool bOverride);

ConfigNode::Table MakeTableRecursive(const toml::table& source, bool bOverride)
{
    ConfigNode::Table table;
    for (const auto& [key, value] : source)
    {
        table.emplace(std::string(key.str()), std::make_unique<ConfigNode>(MakeNodeRecursive(value, bOverride)));
    }
    return table;
}

ConfigNode::Array MakeArrayRecursive(const toml::array& source, bool bOverride)
{
    ConfigNode::Array array;
    for (const toml::node& value : source)
    {
        array.push_back(std::make_unique<ConfigNode>(MakeNodeRecursive(value, bOverride)));
    }
    return array;
}

/// As deep as the parser of toml++ allows (256).
ConfigNode MakeNodeRecursive(const toml::node& source, bool bOverride)
{
    ConfigNode node;
    node.bOverride = bOverride;
    node.line = source.source().begin.line;
    if (const toml::table* const table = source.as_table())
    {
        node.value = MakeTableRecursive(*table, bOverride);
    }
    else if (const toml::array* const array = source.as_array())
    {
        node.value = MakeArrayRecursive(*array, bOverride);
    }
    else if (const auto* const string = source.as_string())
    {
        node.value = string->get();
    }
    else if (const auto* const integer = source.as_integer())
    {
        node.value = integer->get();
    }
    else if (const auto* const number = source.as_floating_point())
    {
        node.value = number->get();
    }
    else if (const auto* const boolean = source.as_boolean())
    {
        node.value = boolean->get();
    }
    else
    {
        node.value = ConfigNode::Other{};
    }
    return node;
}

} // namespace

tl::expected<ConfigNode, TomlMistake> ParseToml(std::string_view text, bool bOverride)
{
    try
    {
        return MakeNodeRecursive(toml::parse(text), bOverride);
    }
    catch (const toml::parse_error& error)
    {
        return tl::unexpected<TomlMistake>(TomlMistake{error.source().begin.line, std::string(error.description())});
    }
}

} // namespace ACS::Apps
