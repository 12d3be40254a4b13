#pragma once

#include "AcsdTimer.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// "Dispatch", "DriveStall LR01", or "acsd.Status" for a timer of the core.
[[nodiscard]] std::string DescribeTimer(const AcsdTimer& timer);

/// JSON of a timer without its robot, and when it was due; nullopt: it was not running.
[[nodiscard]] std::string EncodeTimer(const AcsdTimer& timer, std::optional<Core::SteadyTime> dueOrNull);

/// Reads the timer of what EncodeTimer wrote. Accepts any text.
[[nodiscard]] Core::Result<AcsdTimer> DecodeTimer(std::string_view text, const std::string& robotID);

} // namespace ACS::Acsd
