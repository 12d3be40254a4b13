#include "Floor.hpp"
#include "FloorBuilder.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

Floor MakeLaneFloor()
{
    constexpr std::size_t LENGTH = 20; ///< Nodes.
    FloorBuilder builder;
    std::vector<std::string> parking;
    std::vector<std::string> places;
    for (std::size_t i = 0; i < LENGTH; ++i)
    {
        const std::string lane = fmt::format("L{:02}", i);
        const double x = FLOOR_PITCH * static_cast<double>(i);
        builder.AddNode(lane, x, 0);
        if (i > 0)
        {
            builder.AddLane(fmt::format("L{:02}", i - 1), lane, true);
        }
        places.push_back(fmt::format("A01.CP{:02}", i + 1));
        builder.AddDock(lane, places.back(), x, FLOOR_SPUR);
        if (i % 2 == 0)
        {
            parking.push_back(fmt::format("CHG{:02}", parking.size() + 1));
            builder.AddDock(lane, parking.back(), x, -FLOOR_SPUR);
        }
    }
    return {"lane with bays", builder.Build(), parking, {{places, places, 1}}};
}

} // namespace ACS::Testing
