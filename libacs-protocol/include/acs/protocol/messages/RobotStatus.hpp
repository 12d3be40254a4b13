#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Protocol
{

/// LR carries cassettes, CR handles trays and samples (section 3).
enum class ERobotType : std::uint8_t
{
    Logistics,
    Control,
};

/// Section 6.16.
enum class ERobotStatus : std::uint8_t
{
    Init,
    Disconnected,
    Manual,
    Idle,
    Moving,
    Arrival,
    Docking,
    UnDocking,
    Working,
    Charging,
    Error,
    Stopped,
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(ERobotType type);
/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(ERobotStatus status);

/// ACS to MCS: status, position or load of a robot changed (section 6.16). What does not apply is written as null.
struct RobotStatusUpdate
{
    std::string robotID;
    ERobotType robotType = ERobotType::Logistics;
    ERobotStatus robotStatus = ERobotStatus::Init;
    std::optional<std::string> position;                ///< A location, never coordinates.
    std::vector<std::optional<std::string>> carrierIDs; ///< One entry per port, null where the port is empty.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::string message;

    bool operator==(const RobotStatusUpdate&) const = default;
};

} // namespace ACS::Protocol
