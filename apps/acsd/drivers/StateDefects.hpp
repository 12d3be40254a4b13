#pragma once

#include <acs/plan/RobotEvent.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A value of a state that the engine ignores.
struct StateDefect
{
    std::string_view kind; ///< For the rate limit of the log.
    std::string reason;
};

/// The values of the state that the engine ignores, for the author of the driver.
[[nodiscard]] std::vector<StateDefect> FindStateDefects(
    const Planning::StateChanged& state,
    const std::vector<std::string>& ports);

} // namespace ACS::Acsd
