#include "drivers/StateDefects.hpp"

#include <acs/core/ShortText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ACS::Acsd
{

std::vector<StateDefect> FindStateDefects(const Planning::StateChanged& state, const std::vector<std::string>& ports)
{
    std::vector<StateDefect> defects;
    if (!std::isfinite(state.x) || !std::isfinite(state.y) || !std::isfinite(state.theta))
    {
        defects.push_back({"pose", fmt::format("the pose {} {} {} is not finite", state.x, state.y, state.theta)});
    }
    if (!(state.batteryPercent >= 0 && state.batteryPercent <= 100)) // Also not a number.
    {
        defects.push_back({"battery", fmt::format("the battery {} % is not from 0 to 100", state.batteryPercent)});
    }
    if (!state.loads.has_value())
    {
        return defects;
    }
    const auto unknown = std::ranges::find_if(*state.loads, [&ports](const Planning::PortLoad& load) {
        return std::ranges::count(ports, load.port) == 0;
    });
    if (unknown != state.loads->end())
    {
        const std::string port = Core::ShortenText(unknown->port);
        defects.push_back({"loads", fmt::format("loads of the port '{}', which the robot does not have", port)});
    }
    return defects;
}

} // namespace ACS::Acsd
