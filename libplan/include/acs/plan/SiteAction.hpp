#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Whether the robot performs an action each time that it uses the node or edge. Conditional: something that the map does not
/// state decides.
enum class EActionRequirement : std::uint8_t
{
    Optional,
    Conditional,
    Required,
};

/// What an action blocks: None nothing, Soft driving, Hard driving and all other actions.
enum class EActionBlocking : std::uint8_t
{
    None,
    Soft,
    Hard,
};

/// A parameter of an action of the map.
struct SiteActionParameter
{
    std::string key;      ///< As vehicles know it.
    Core::JsonText value; ///< Any JSON value but null.

    bool operator==(const SiteActionParameter&) const = default;
};

/// An action of the map on a node or an edge.
struct SiteAction
{
    std::string actionType;                                        ///< As vehicles know it.
    std::string description;                                       ///< May be empty.
    EActionRequirement requirement = EActionRequirement::Optional; ///< Only required ones are commanded.
    EActionBlocking blocking = EActionBlocking::None;              ///< blockingType of LIF.
    std::vector<SiteActionParameter> parameters;                   ///< In the order of the file.

    bool operator==(const SiteAction&) const = default;
};

} // namespace ACS::Planning
