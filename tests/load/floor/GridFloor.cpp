#include "Floor.hpp"
#include "FloorBuilder.hpp"

#include <fmt/format.h>

#include <algorithm>
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
constexpr std::size_t PLACES = 40;
constexpr std::size_t PARKING = 36;
constexpr std::size_t DEPTH = 3; ///< Nodes of a dead end.

/// A node of a lane, and where its dock is.
struct Spot
{
    std::string laneID;
    double x = 0;
    double y = 0;
};

std::string MakeLaneID(std::size_t column, std::size_t row)
{
    return fmt::format("L{:02}{:02}", column, row);
}

void AddLanes(FloorBuilder& builder, std::size_t column, std::size_t row, bool bLoadRestrictions)
{
    const std::string lane = MakeLaneID(column, row);
    builder.AddNode(lane, FLOOR_PITCH * static_cast<double>(column), FLOOR_PITCH * static_cast<double>(row));
    if (column > 0)
    {
        const std::string left = MakeLaneID(column - 1, row);
        const bool bRight = row % 2 == 0;
        builder.AddLane(bRight ? left : lane, bRight ? lane : left, row == 0 || row + 1 == ROWS);
    }
    if (row > 0)
    {
        builder.AddLane(MakeLaneID(column, row - 1), lane, true);
        if (bLoadRestrictions && column % 4 >= 2)
        {
            builder.Restrict(2, SiteLoadRestriction{column % 4 == 2, column % 4 == 3});
        }
    }
}

void AddDeadEnd(FloorBuilder& builder, bool bLeft, std::size_t row, std::vector<Spot>& spots)
{
    std::string last = MakeLaneID(bLeft ? 0 : COLUMNS - 1, row);
    for (std::size_t depth = 1; depth <= DEPTH; ++depth)
    {
        const std::string lane = fmt::format("E{}{}{}", bLeft ? "L" : "R", row, depth);
        const double offset = FLOOR_PITCH * static_cast<double>(depth);
        const double x = bLeft ? -offset : FLOOR_PITCH * static_cast<double>(COLUMNS - 1) + offset;
        const double y = FLOOR_PITCH * static_cast<double>(row);
        builder.AddNode(lane, x, y);
        builder.AddLane(last, lane, true);
        spots.push_back({lane, x, y + FLOOR_SPUR});
        last = lane;
    }
}

} // namespace

Floor MakeGridFloor(bool bLoadRestrictions)
{
    FloorBuilder builder;
    std::vector<Spot> spots;
    for (std::size_t row = 0; row < ROWS; ++row)
    {
        for (std::size_t column = 0; column < COLUMNS; ++column)
        {
            AddLanes(builder, column, row, bLoadRestrictions);
            const auto [x, y] = builder.GetPosition(MakeLaneID(column, row));
            spots.push_back({MakeLaneID(column, row), x + FLOOR_SPUR, y + FLOOR_SPUR}); // the middle between four lanes
        }
        if (row % 4 == 1)
        {
            AddDeadEnd(builder, true, row, spots);
            AddDeadEnd(builder, false, row, spots);
        }
    }
    // Alternately places and parking positions all over the floor; all docks of dead ends are places.
    const auto lanes =
        std::stable_partition(spots.begin(), spots.end(), [](const Spot& spot) { return spot.laneID.front() == 'E'; });
    const auto deadEnds = static_cast<std::size_t>(lanes - spots.begin());
    std::vector<std::string> parking;
    std::vector<std::string> places;
    for (std::size_t i = 0; i < PLACES + PARKING; ++i)
    {
        // Steps of 29 visit each spot once, because the two numbers have no common divisor.
        const Spot& spot = spots[i < deadEnds ? i : deadEnds + (i * 29) % (COLUMNS * ROWS)];
        const bool bPlace = i < PLACES;
        const std::string stationID =
            bPlace ? fmt::format("A01.CP{:02}", i + 1) : fmt::format("CHG{:02}", i + 1 - PLACES);
        builder.AddDock(spot.laneID, stationID, spot.x, spot.y);
        (bPlace ? places : parking).push_back(stationID);
    }
    return {bLoadRestrictions ? "grid with loads" : "grid", builder.Build(), parking, {{places, places, 1}}};
}

} // namespace ACS::Testing
