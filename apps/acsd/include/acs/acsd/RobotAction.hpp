#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// State of an instant action, with the words of VDA5050 (section 6.11), and Unknown.
enum class ERobotActionStatus : std::uint8_t
{
    Waiting,      ///< Sent; the robot has not begun it, or has not shown it yet.
    Initializing, ///< The robot prepares it.
    Running,      ///< The robot performs it.
    Paused,       ///< The robot has interrupted it.
    Finished,     ///< Done. The robot performs it no more.
    Failed,       ///< Not done. The robot performs it no more.
    Unknown,      ///< The robot does not show it, or no longer. A later change may follow.
};

/// Finished, Failed or Unknown.
[[nodiscard]] constexpr bool IsEnded(ERobotActionStatus status) noexcept
{
    return status >= ERobotActionStatus::Finished;
}

/// A value that an operator gives with an instant action.
struct RobotActionParameter
{
    std::string key;      ///< As the robot names it.
    Core::JsonText value; ///< Any JSON value but null.

    bool operator==(const RobotActionParameter&) const = default;
};

/// An instant action that an operator requests.
struct RobotActionRequest
{
    std::string actionType;                       ///< As the robot names it.
    std::vector<RobotActionParameter> parameters; ///< Each key once.

    bool operator==(const RobotActionRequest&) const = default;
};

/// A parameter of an instant action that a robot offers.
struct RobotParameterOffer
{
    std::string key; ///< RobotActionParameter::key.
    std::string
        valueType; ///< For people, and for acsctl, which sends a value of STRING as a string: STRING, NUMBER, BOOL, …
    bool bRequired = false; ///< The robot refuses the action without it.

    bool operator==(const RobotParameterOffer&) const = default;
};

/// An instant action that a robot offers.
struct RobotActionOffer
{
    std::string actionType;                      ///< RobotActionRequest::actionType.
    std::string description;                     ///< May be empty.
    std::vector<RobotParameterOffer> parameters; ///< Those that it can have.

    bool operator==(const RobotActionOffer&) const = default;
};

/// Why an instant action is not sent.
struct RobotActionRefusal
{
    bool bInvalid = false; ///< Wrong in itself (HTTP status 400). Otherwise the robot's state does not allow it (409).
    std::string sentence;  ///< What is wrong, and what is allowed.

    bool operator==(const RobotActionRefusal&) const = default;
};

/// What became of an instant action.
struct RobotActionChange
{
    std::string actionID;                                    ///< The result of IRobotActions::Request.
    ERobotActionStatus status = ERobotActionStatus::Waiting; ///< The new one.
    std::string resultDescription;                           ///< The result, or why it failed; may be empty.

    bool operator==(const RobotActionChange&) const = default;
};

} // namespace ACS::Acsd
