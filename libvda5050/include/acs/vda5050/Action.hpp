#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// What an action blocks (section 6.12): None nothing, Soft driving, Hard driving and all other actions.
enum class EBlockingType : std::uint8_t
{
    None,
    Soft,
    Hard,
};

/// A parameter of an action (section 6.6.6).
struct ActionParameter
{
    std::string key;
    Core::JsonText value; ///< Any JSON value but null.

    bool operator==(const ActionParameter&) const = default;
};

/// An action on a node, on an edge, or an instant action (section 6.6.6).
struct Action
{
    std::string actionType;
    std::string actionID; ///< Unique; the key of its state.
    std::string actionDescription;
    EBlockingType blockingType = EBlockingType::None;
    std::vector<ActionParameter> actionParameters;

    bool operator==(const Action&) const = default;
};

/// The parameter with this key; null if there is none.
[[nodiscard]] ACS_API const ActionParameter* FindParameterOrNull(const Action& action, std::string_view key);

/// The predefined actions of 2.x (section 6.8.1); PredefinedActions.hpp has their scopes and parameters.
namespace ActionTypes
{
inline constexpr std::string_view CANCEL_ORDER = "cancelOrder";
inline constexpr std::string_view START_PAUSE = "startPause";
inline constexpr std::string_view STOP_PAUSE = "stopPause";
inline constexpr std::string_view STATE_REQUEST = "stateRequest";
inline constexpr std::string_view FACTSHEET_REQUEST = "factsheetRequest";
inline constexpr std::string_view START_CHARGING = "startCharging";
inline constexpr std::string_view STOP_CHARGING = "stopCharging";
inline constexpr std::string_view INIT_POSITION = "initPosition";
inline constexpr std::string_view ENABLE_MAP = "enableMap";
inline constexpr std::string_view DOWNLOAD_MAP = "downloadMap";
inline constexpr std::string_view DELETE_MAP = "deleteMap";
inline constexpr std::string_view LOG_REPORT = "logReport";
inline constexpr std::string_view PICK = "pick";
inline constexpr std::string_view DROP = "drop";
inline constexpr std::string_view DETECT_OBJECT = "detectObject";
inline constexpr std::string_view FINE_POSITIONING = "finePositioning";
inline constexpr std::string_view WAIT_FOR_TRIGGER = "waitForTrigger";
} // namespace ActionTypes

} // namespace ACS::VDA5050
