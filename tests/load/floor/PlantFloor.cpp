#include "Floor.hpp"
#include "FloorBuilder.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr std::size_t AISLES = 6;  ///< Across, alternately up and down.
constexpr std::size_t LENGTH = 10; ///< Nodes of an aisle.
constexpr double AISLE_PITCH = 9;  ///< Metres between two aisles.

std::string MakeID(std::size_t aisle, std::size_t node)
{
    return fmt::format("P{}{:02}", aisle, node);
}

/// A node in the middle between two aisles, at one of their ends.
std::string MakeEndID(std::size_t aisle, bool bTop, std::size_t part)
{
    return fmt::format("{}{}{}", bTop ? "T" : "B", aisle, part);
}

/// The lanes at the ends of the aisles are two-way.
void AddEnds(FloorBuilder& builder, std::size_t aisle)
{
    for (const bool bTop : {false, true})
    {
        const std::size_t end = bTop ? LENGTH - 1 : 0;
        std::string last = MakeID(aisle - 1, end);
        const auto [x, y] = builder.GetPosition(last);
        for (std::size_t part = 1; part <= 2; ++part)
        {
            const std::string next = MakeEndID(aisle, bTop, part);
            builder.AddNode(next, x + FLOOR_PITCH * static_cast<double>(part), y);
            builder.AddLane(last, next, true);
            last = next;
        }
        builder.AddLane(last, MakeID(aisle, end), true);
    }
}

} // namespace

Floor MakePlantFloor()
{
    FloorBuilder builder;
    std::vector<std::string> parking;
    for (std::size_t aisle = 0; aisle < AISLES; ++aisle)
    {
        for (std::size_t i = 0; i < LENGTH; ++i)
        {
            builder.AddNode(
                MakeID(aisle, i),
                AISLE_PITCH * static_cast<double>(aisle),
                FLOOR_PITCH * static_cast<double>(i));
            if (i > 0)
            {
                const bool bUp = aisle % 2 == 0;
                builder.AddLane(MakeID(aisle, bUp ? i - 1 : i), MakeID(aisle, bUp ? i : i - 1), false);
            }
        }
        if (aisle > 0)
        {
            AddEnds(builder, aisle);
        }
    }
    const auto add =
        [&builder](std::vector<std::string>& list, std::string stationID, const std::string& lane, bool bLeft) {
            const auto [x, y] = builder.GetPosition(lane);
            builder.AddDock(lane, stationID, x + (bLeft ? -FLOOR_SPUR : FLOOR_SPUR), y);
            list.push_back(std::move(stationID));
        };
    std::vector<std::string> racks;
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::vector<std::string> shipping;
    for (std::size_t i = 1; i + 1 < LENGTH; ++i)
    {
        // Two aisles of racks, three of production lines, one of shipping; parking positions on the other sides.
        add(racks, fmt::format("A01.CP{:02}", racks.size() + 1), MakeID(0, i), true);
        add(racks, fmt::format("A01.CP{:02}", racks.size() + 1), MakeID(1, i), true);
        add(parking, fmt::format("CHG{:02}", parking.size() + 1), MakeID(0, i), false);
        add(parking, fmt::format("CHG{:02}", parking.size() + 1), MakeID(1, i), false);
        add(parking, fmt::format("CHG{:02}", parking.size() + 1), MakeID(4, i), true);
        if (i % 2 == 0)
        {
            for (std::size_t line = 2; line < 5; ++line)
            {
                std::vector<std::string>& list = i < LENGTH / 2 ? inputs : outputs;
                const char* const area = i < LENGTH / 2 ? "A02" : "A03";
                add(list, fmt::format("{}.CP{:02}", area, list.size() + 1), MakeID(line, i), false);
            }
        }
        if (i % 3 == 0)
        {
            add(shipping, fmt::format("A04.CP{:02}", shipping.size() + 1), MakeID(AISLES - 1, i), false);
        }
    }
    return {
        "plant",
        builder.Build(),
        parking,
        {{racks, inputs, 4}, {outputs, racks, 2}, {outputs, shipping, 2}, {racks, shipping, 1}}};
}

} // namespace ACS::Testing
