#include "Floor.hpp"
#include "FloorBuilder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

using Point = std::pair<int, int>; ///< Metres.

/// What examples/site/site.lif.json has, with more parking positions: a loop, a lane through its middle, two lanes across. Stations by
/// the point of the lane and the side.
class DocumentPlan
{
    static constexpr int WEST = 3;
    static constexpr int EAST = 37;
    static constexpr int SOUTH = 4;
    static constexpr int MIDDLE = 10;
    static constexpr int NORTH = 16;
    static constexpr int UP = 19;
    static constexpr int DOWN = 21;
    static constexpr int STEP = 2; ///< Most metres between two nodes.
    static constexpr double SPUR = 1.2;

    struct Dock
    {
        std::string stationID;
        Point lane;
        Point side;
    };

    FloorBuilder _builder;
    std::vector<Dock> _docks;
    std::vector<std::string> _parking;
    std::vector<std::string> _stocker;
    std::vector<std::string> _ports;
    std::vector<std::string> _sets;

public:
    DocumentPlan()
    {
        for (int i = 0; i < 6; ++i)
        {
            AddDock(_stocker, fmt::format("ST01.CP{:02}", i + 1), {24 + 2 * i, SOUTH}, {0, -1});
        }
        AddArea("A01", "A11", 5);
        AddArea("A02", "A12", 23);
        for (int i = 0; i < 7; ++i)
        {
            AddParking({5 + 2 * i, SOUTH}, {0, -1});
            AddParking({5 + 2 * i, NORTH}, {0, 1});
            AddParking({23 + 2 * i, NORTH}, {0, 1});
        }
        for (int i = 0; i < 3; ++i)
        {
            AddParking({WEST, 14 - 2 * i}, {-1, 0});
        }
    }

    [[nodiscard]] Floor Build()
    {
        AddLane({WEST, SOUTH}, {EAST, SOUTH});
        AddLane({EAST, SOUTH}, {EAST, NORTH});
        AddLane({EAST, NORTH}, {WEST, NORTH});
        AddLane({WEST, NORTH}, {WEST, SOUTH});
        AddLane({WEST, MIDDLE}, {EAST, MIDDLE});
        AddLane({UP, SOUTH}, {UP, NORTH});
        AddLane({DOWN, NORTH}, {DOWN, SOUTH});
        for (const Dock& dock : _docks)
        {
            const double x = dock.lane.first + SPUR * dock.side.first;
            const double y = dock.lane.second + SPUR * dock.side.second;
            _builder.AddDock(MakeID(dock.lane), dock.stationID, x, y);
        }
        return {
            "document's area twice",
            _builder.Build(),
            _parking,
            {{_stocker, _ports, 2}, {_ports, _sets, 3}, {_sets, _ports, 3}, {_ports, _stocker, 2}}};
    }

private:
    static std::string MakeID(Point point)
    {
        return fmt::format("N{:02}{:02}", point.first, point.second);
    }

    void AddDock(std::vector<std::string>& list, std::string stationID, Point lane, Point side)
    {
        list.push_back(stationID);
        _docks.push_back({std::move(stationID), lane, side});
    }

    /// The sets are named like ports, because a transport goes from port to port.
    void AddArea(const std::string& area, const std::string& sets, int x)
    {
        for (int i = 0; i < 6; ++i)
        {
            AddDock(_ports, fmt::format("{}.CP{:02}", area, i + 1), {x + 2 * i + 1, MIDDLE}, {0, -1});
        }
        for (int i = 0; i < 12; ++i)
        {
            const Point lane(x + 2 * (i % 6), i < 6 ? NORTH : MIDDLE);
            AddDock(_sets, fmt::format("{}.CP{:02}", sets, i + 1), lane, {0, i < 6 ? -1 : 1});
        }
    }

    void AddParking(Point lane, Point side)
    {
        AddDock(_parking, fmt::format("CHG{:02}", _parking.size() + 1), lane, side);
    }

    void AddLane(Point from, Point to)
    {
        const auto isBetween = [from, to](Point point) {
            const auto [west, east] = std::minmax(from.first, to.first);
            const auto [south, north] = std::minmax(from.second, to.second);
            return west <= point.first && point.first <= east && south <= point.second && point.second <= north;
        };
        std::set<Point> stops{from, to};
        for (const int x : {WEST, UP, DOWN, EAST})
        {
            for (const int y : {SOUTH, MIDDLE, NORTH})
            {
                stops.insert({x, y});
            }
        }
        std::ranges::for_each(_docks, [&stops](const Dock& dock) { stops.insert(dock.lane); });
        std::erase_if(stops, [&isBetween](Point stop) { return !isBetween(stop); });
        std::vector<Point> points(stops.begin(), stops.end());
        if (to < from)
        {
            std::ranges::reverse(points);
        }
        Point last = points.front();
        _builder.AddNode(MakeID(last), last.first, last.second);
        for (const Point& stop : points)
        {
            while (last != stop)
            {
                const auto move = [](int here, int there) {
                    return here + std::clamp(there - here, -STEP, STEP);
                };
                const Point next(move(last.first, stop.first), move(last.second, stop.second));
                _builder.AddNode(MakeID(next), next.first, next.second);
                _builder.AddLane(MakeID(last), MakeID(next), false);
                last = next;
            }
        }
    }
};

} // namespace

Floor MakeDocumentFloor()
{
    return DocumentPlan().Build();
}

} // namespace ACS::Testing
