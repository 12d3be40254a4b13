#include "FleetSite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr std::size_t COLUMNS = 10;
constexpr std::size_t ROWS = 8;
constexpr std::size_t HOMES = 36;
constexpr double PITCH = 3;  ///< Metres between lanes.
constexpr double SPUR = 1.5; ///< Metres from a lane to a dock.

SiteNode MakeNode(std::string nodeID, double x, double y)
{
    return {std::move(nodeID), x, y, "floor", {{"lr-base", std::nullopt}}};
}

SiteEdge MakeEdge(const std::string& from, const std::string& to)
{
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr-base";
    rule.maxSpeed = 1;
    return {from + ">" + to, from, to, {rule}};
}

std::string MakeLaneID(std::size_t column, std::size_t row)
{
    return fmt::format("L{:02}{:02}", column, row);
}

} // namespace

/// Rows are alternately one-way, except the first and the last; columns are two-way. A third of the docks is on dead
/// ends of three nodes on the left and the right, which a vehicle leaves by the route by which it came.
SiteMap MakeFleetSite(bool bLoadRestrictions)
{
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> stations;
    const auto join = [&edges](const std::string& from, const std::string& to, bool bBothWays) {
        edges.push_back(MakeEdge(from, to));
        if (bBothWays)
        {
            edges.push_back(MakeEdge(to, from));
        }
    };
    std::vector<std::pair<std::string, std::pair<double, double>>> spots; // Where docks are.
    for (std::size_t row = 0; row < ROWS; ++row)
    {
        for (std::size_t column = 0; column < COLUMNS; ++column)
        {
            const std::string lane = MakeLaneID(column, row);
            const double x = PITCH * static_cast<double>(column);
            const double y = PITCH * static_cast<double>(row);
            nodes.push_back(MakeNode(lane, x, y));
            spots.push_back({lane, {x + SPUR, y + SPUR}}); // the middle between four lanes
            const bool bBothWays = row == 0 || row + 1 == ROWS;
            if (column > 0)
            {
                const std::string left = MakeLaneID(column - 1, row);
                join(row % 2 == 0 ? left : lane, row % 2 == 0 ? lane : left, bBothWays);
            }
            if (row > 0)
            {
                join(MakeLaneID(column, row - 1), lane, true);
                for (SiteEdge& edge : std::span(edges).last(bLoadRestrictions && column % 4 >= 2 ? 2 : 0))
                {
                    edge.rules.front().loadRestriction = SiteLoadRestriction{column % 4 == 2, column % 4 == 3};
                }
            }
        }
        for (const bool bLeft : {true, false})
        {
            std::string last = MakeLaneID(bLeft ? 0 : COLUMNS - 1, row);
            for (std::size_t depth = 1; depth <= 3 && row % 4 == 1; ++depth)
            {
                const std::string lane = fmt::format("E{}{}{}", bLeft ? "L" : "R", row, depth);
                const double offset = PITCH * static_cast<double>(depth);
                const double x = bLeft ? -offset : PITCH * static_cast<double>(COLUMNS - 1) + offset;
                const double y = PITCH * static_cast<double>(row);
                nodes.push_back(MakeNode(lane, x, y));
                join(last, lane, true);
                spots.push_back({lane, {x, y + SPUR}});
                last = lane;
            }
        }
    }
    // Alternately places and parking positions all over the floor; all docks of dead ends are places.
    std::stable_partition(spots.begin(), spots.end(), [](const auto& spot) { return spot.first.front() == 'E'; });
    for (std::size_t i = 0; i < FLEET_PLACES + HOMES; ++i)
    {
        const bool bPlace = i < FLEET_PLACES;
        // Steps of 29 visit each spot once, because the two numbers have no common divisor.
        const std::size_t deadEnds = 12;
        const std::size_t spot = i < deadEnds ? i : deadEnds + (i * 29) % (COLUMNS * ROWS);
        const auto& [lane, position] = spots[spot];
        const std::string stationID =
            bPlace ? fmt::format("A01.CP{:02}", i + 1) : fmt::format("CHG{:02}", i + 1 - FLEET_PLACES);
        nodes.push_back(MakeNode("D-" + stationID, position.first, position.second));
        join(lane, "D-" + stationID, true);
        stations.push_back({stationID, {"D-" + stationID}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), std::move(stations));
}

EngineOptions MakeFleetEngineOptions(std::size_t vehicles)
{
    EngineOptions options;
    options.maximumPlans = 1'000;
    for (std::size_t i = 0; i < vehicles; ++i)
    {
        const std::string robotID = fmt::format("LR{:02}", i + 1);
        const std::string home = fmt::format("CHG{:02}", i + 1);
        options.robots.push_back(
            {*Core::RobotID::Parse(robotID),
             ERobotType::LR,
             "lr-base",
             "D-" + home,
             home,
             *Core::ParseLocationRange(robotID + ".CP01"),
             {},
             {}});
    }
    return options;
}

} // namespace ACS::Testing
