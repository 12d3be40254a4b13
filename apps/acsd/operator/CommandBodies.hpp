#pragma once

#include <acs/acsd/RobotAction.hpp>
#include <acs/core/Result.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Of a reason that an operator gives.
inline constexpr std::size_t MOST_REASON_BYTES = 500;
/// Of an instant action, and of one of its keys.
inline constexpr std::size_t MOST_ACTION_NAME_BYTES = 200;
/// Of the parameters of an instant action together, keys and values.
inline constexpr std::size_t MOST_PARAMETER_BYTES = 8'000;

/// No members: of commands that have no body, or {}.
struct EmptyBody
{
};

/// {"reason":"text"}
struct ReasonBody
{
    std::string reason;
};

/// {"priority":5}
struct PriorityBody
{
    std::int32_t priority = 0;
};

/// {"outcome":"done"}
struct ResolveBody
{
    std::string outcome;
};

/// {"on":true}
struct MaintenanceBody
{
    bool bOn = false;
};

/// {"carrierIds":["C_01",null]}
struct CarriersBody
{
    std::vector<std::optional<std::string>> carrierIDs;
};

/// {"x":1.0,"mapId":"floor"}
struct ActionParametersBody
{
    std::vector<RobotActionParameter> values;
};

/// {"actionType":"initPosition","parameters":{"x":1.0},"reason":"moved by hand"}
struct ActionBody
{
    std::string actionType;
    ActionParametersBody parameters;
    std::string reason;
};

/// {"robotId":"LR01","errorCode":"ACS-1004"}
struct ClearBody
{
    std::string robotID;
    std::string errorCode;
    std::optional<std::string> planID;
    std::optional<std::string> jobID;
};

/// {"kind":"edge","id":"E_01","reason":"forklift"}
struct BlockBody
{
    std::string kind;
    std::string placeID;
    std::string reason;
};

/// {"kind":"edge","id":"E_01"}
struct UnblockBody
{
    std::string kind;
    std::string placeID;
};

/// Reads the body of a command. An empty text is an empty object; unknown and repeated members are errors. The error has the JSON
/// path. Defined for the bodies above.
template <typename TBody>
[[nodiscard]] Core::Result<TBody> ReadBody(std::string_view text);

} // namespace ACS::Acsd
