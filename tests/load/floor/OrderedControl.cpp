#include "OrderedControl.hpp"

#include <algorithm>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

OrderedControl::OrderedControl(const Floor& floor, std::size_t vehicles)
    : IRuleControl(floor, vehicles),
      _holders(floor.site.GetNodes().size())
{
    for (std::size_t i = 0; i < vehicles; ++i)
    {
        _holders[GetVehicle(i).node] = i;
    }
}

bool OrderedControl::TryTakePlan(const Vehicle& /*vehicle*/, const Plan& /*plan*/)
{
    return true;
}

std::size_t OrderedControl::Grant(const Vehicle& vehicle)
{
    constexpr std::size_t AHEAD = 6; ///< As many nodes as the engine grants at most.
    const std::size_t robot = GetIndex(vehicle);
    std::size_t granted = vehicle.granted;
    while (granted < std::min(vehicle.route.size(), vehicle.passed + 1 + AHEAD))
    {
        std::optional<std::size_t>& holder = _holders[vehicle.route[granted]];
        if (holder.has_value() && holder != robot)
        {
            break;
        }
        holder = robot;
        ++granted;
    }
    return granted;
}

void OrderedControl::OnPassed(const Vehicle& vehicle)
{
    _holders[vehicle.route[vehicle.passed - 1]].reset();
}

} // namespace ACS::Testing
