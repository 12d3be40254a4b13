#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// JSON of an event. Of a JobCheckChanged only whether there is a check.
[[nodiscard]] std::string EncodeRobotEvent(const Planning::RobotEvent& event);

/// Reads what EncodeRobotEvent wrote. A JobCheckChanged has no check: see HasJobCheck.
[[nodiscard]] Core::Result<Planning::RobotEvent> DecodeRobotEvent(std::string_view text);

/// Whether the text is that of a JobCheckChanged with a check.
[[nodiscard]] bool HasJobCheck(std::string_view text);

} // namespace ACS::Acsd
