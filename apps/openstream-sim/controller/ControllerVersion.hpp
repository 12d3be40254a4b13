#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

/// The version of a controller's software, "70.04-00".
struct ControllerVersion
{
    int major = 70;
    int minor = 4;
    int patch = 0;

    auto operator<=>(const ControllerVersion&) const = default; // NOLINT(modernize-use-nullptr)
};

/// The first version that serves r_code and no longer motor_off and the reset of tasks.
inline constexpr ControllerVersion FIRST_WITH_R_CODE{60, 30, 0};
/// The first version with agility_mode of a trajectory, and its log.
inline constexpr ControllerVersion FIRST_WITH_AGILITY{70, 4, 0};
/// The first version with joint_traject_mode; joint_traject_init does not end a trajectory any more.
inline constexpr ControllerVersion FIRST_WITH_TRAJECTORY_MODE{70, 6, 0};

[[nodiscard]] std::optional<ControllerVersion> ParseControllerVersionOrNull(std::string_view text);
[[nodiscard]] std::string MakeText(const ControllerVersion& version);

} // namespace ACS::OpenStreamSim
