#include "robot/ActiveDrive.hpp"

#include <algorithm>

namespace ACS::Planning
{

bool ActiveDrive::IsCancelling() const noexcept
{
    return cancellation == ECancellation::Awaited;
}

void ActiveDrive::StopAwaitingCancellation() noexcept
{
    cancellation = IsCancelling() ? ECancellation::Late : cancellation;
}

bool ActiveDrive::IsAtBaseEnd() const noexcept
{
    return passed + 1 >= releasedCount && releasedCount < nodes.size();
}

bool ActiveDrive::IsApproaching() const noexcept
{
    return passed + 2 >= nodes.size();
}

std::size_t ActiveDrive::CountReachable(const SiteMap& site, std::string_view vehicleTypeID, ELoad present) const
{
    if (present == load)
    {
        return nodes.size();
    }
    const auto closed = std::find_if(
        route.edges.begin() + static_cast<std::ptrdiff_t>(grantedCount - 1),
        route.edges.end(),
        [&site, vehicleTypeID, present](const RouteEdge& edge) {
            const auto found = std::ranges::find(site.GetEdges(), edge.edgeID, &SiteEdge::edgeID);
            return !found->FindRuleOrNull(vehicleTypeID)->IsPermitted(present);
        });
    return static_cast<std::size_t>(closed - route.edges.begin()) + 1;
}

const std::string& ActiveDrive::GetNextNodeID() const
{
    return route.nodes[std::min(passed + 1, route.nodes.size() - 1)].nodeID;
}

} // namespace ACS::Planning
