#include "FloorVehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

double FloorVehicle::GetLegLength() const
{
    return drive->route.edges[index].length;
}

double FloorVehicle::GetLegDone(Core::SteadyTime now) const
{
    if (phase != EDrivePhase::OnLeg || bPaused)
    {
        return legDone;
    }
    const std::chrono::duration<double> driven = now - legTime;
    return std::min(1.0, legDone + driven.count() * speed / GetLegLength());
}

std::pair<double, double> FloorVehicle::GetPosition(const SiteMap& site, Core::SteadyTime now) const
{
    const SiteNode& node = *site.FindNodeOrNull(nodeID);
    if (phase != EDrivePhase::OnLeg)
    {
        return {node.x, node.y};
    }
    const RouteNode& next = drive->route.nodes[index + 1];
    const double done = GetLegDone(now);
    return {node.x + done * (next.x - node.x), node.y + done * (next.y - node.y)};
}

void FloorVehicle::ChangeSpeed(double metresPerSecond, bool bPause, Core::SteadyTime now)
{
    legDone = GetLegDone(now);
    legTime = now;
    speed = metresPerSecond;
    bPaused = bPause;
    ++generation;
}

std::optional<double> FloorVehicle::GetLegSecondsOrNull() const
{
    return phase == EDrivePhase::OnLeg && !bPaused ? std::optional((1 - legDone) * GetLegLength() / speed)
                                                   : std::nullopt;
}

std::string FloorVehicle::Describe() const
{
    std::string text = fmt::format("{} on {}", robotID, nodeID);
    if (drive.has_value())
    {
        const std::vector<RouteNode>& nodes = drive->route.nodes;
        text += fmt::format(" to {}, node {} of {} released", nodes.back().nodeID, index, drive->releasedCount);
        for (const RouteNode& node : nodes)
        {
            text += " " + node.nodeID;
        }
    }
    text += bPaused ? " paused" : "";
    text += bLost ? " lost" : "";
    return text;
}

} // namespace ACS::Testing
