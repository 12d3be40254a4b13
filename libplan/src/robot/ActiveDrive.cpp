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

const std::string& ActiveDrive::GetNextNodeID() const
{
    return route.nodes[std::min(passed + 1, route.nodes.size() - 1)].nodeID;
}

} // namespace ACS::Planning
