// Lesson 13: reads a LIF file with the library's own reader and draws it. DecodeLIF checks the file as acsd does: what the
// picture shows is what acsd would drive on, and an error names the member that is wrong.
//
//     e13_lif_to_svg examples/site/site.lif.json site.svg [MAPID]      (without a MAPID the map of the first node)
//
// Nodes are circles, edges arrows along the line or the trajectory, stations squares at their docks. A browser shows the ids
// under the pointer. The lesson is longer than 150 lines because a picture needs each of these shapes.

#include <acs/core/ControlCharacter.hpp>
#include <acs/core/NurbsCurve.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/LifReader.hpp>
#include <acs/plan/SiteMap.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;

namespace
{

constexpr double PIXELS = 40; ///< Of a metre.
constexpr double MARGIN = 80; ///< Pixels.
constexpr double CURVE_STEP = 0.1;
constexpr std::size_t MAX_CURVE_POINTS = 200;

constexpr std::string_view STYLE = R"(<style>
polyline { fill: none; stroke: #4a78b5; marker-end: url(#arrow) } circle { fill: #4a78b5 }
rect { fill: none; stroke: #222 } text { font: 8px sans-serif; text-anchor: middle }
</style>
<marker id="arrow" markerWidth="6" markerHeight="6" refX="9" refY="3" orient="auto"><path d="M0,0 L6,3 L0,6 z"/></marker>
)";

/// An id comes from outside: it must not become markup of the SVG.
std::string Escape(std::string_view text)
{
    std::string escaped;
    for (const char letter : text)
    {
        const bool bMarkup = std::string_view("&<>\"").find(letter) != std::string_view::npos;
        const char shown = Core::IsControlCharacter(letter) ? '?' : letter;
        escaped += bMarkup ? fmt::format("&#{};", int{letter}) : std::string(1, shown);
    }
    return escaped;
}

/// The nodes of one map with their positions in the picture, where y grows downwards.
class Picture
{
    double _left = 0;
    double _top = 0;
    double _right = 0;
    double _bottom = 0;
    std::string _shapes;

public:
    Picture(const SiteMap& site, std::string_view mapID)
    {
        const std::vector<SiteNode>& nodes = site.GetNodes();
        const auto [left, right] = std::ranges::minmax(nodes, {}, &SiteNode::x);
        const auto [bottom, top] = std::ranges::minmax(nodes, {}, &SiteNode::y);
        std::tie(_left, _top, _right, _bottom) = std::tuple(left.x, top.y, right.x, bottom.y);
        const auto isDrawn = [mapID](const SiteNode& node) {
            return node.mapID == mapID;
        };
        for (const SiteEdge& edge : site.GetEdges())
        {
            const SiteNode& start = *site.FindNodeOrNull(edge.startNodeID); // A SiteMap is valid: its nodes exist.
            const SiteNode& end = *site.FindNodeOrNull(edge.endNodeID);
            if (isDrawn(start) && isDrawn(end)) // Otherwise it leads to another map.
            {
                DrawEdge(edge, start, end);
            }
        }
        for (const SiteNode& node : nodes)
        {
            if (isDrawn(node))
            {
                const std::string place = fmt::format(R"(cx="{:.2f}" cy="{:.2f}")", GetX(node.x), GetY(node.y));
                _shapes += fmt::format("<circle {} r=\"3\"><title>{}</title></circle>\n", place, Escape(node.nodeID));
            }
        }
        for (const SiteStation& station : site.GetStations())
        {
            for (const std::string& nodeID : station.nodeIDs)
            {
                const SiteNode& dock = *site.FindNodeOrNull(nodeID);
                if (isDrawn(dock))
                {
                    DrawDock(station.stationID, GetX(dock.x), GetY(dock.y));
                }
            }
        }
    }

    [[nodiscard]] std::string MakeSVG() const
    {
        const std::string size =
            fmt::format(R"(width="{:.0f}" height="{:.0f}")", GetX(_right) + MARGIN, GetY(_bottom) + MARGIN);
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" {}>\n{}{}</svg>\n", size, STYLE, _shapes);
    }

private:
    [[nodiscard]] double GetX(double x) const
    {
        return MARGIN + (x - _left) * PIXELS;
    }

    [[nodiscard]] double GetY(double y) const
    {
        return MARGIN + (_top - y) * PIXELS;
    }

    void DrawEdge(const SiteEdge& edge, const SiteNode& start, const SiteNode& end)
    {
        std::vector<Core::MapPoint> points{{start.x, start.y}, {end.x, end.y}};
        for (const SiteEdgeRule& rule : edge.rules) // One for each vehicle type.
        {
            if (rule.trajectory.has_value())
            {
                points = Core::NurbsCurve(*rule.trajectory).Sample(CURVE_STEP, MAX_CURVE_POINTS);
            }
        }
        _shapes += "<polyline points=\"";
        for (const Core::MapPoint& point : points)
        {
            _shapes += fmt::format("{:.2f},{:.2f} ", GetX(point.x), GetY(point.y));
        }
        _shapes += fmt::format("\"><title>{}</title></polyline>\n", Escape(edge.edgeID));
    }

    void DrawDock(std::string_view stationID, double x, double y)
    {
        _shapes += fmt::format(R"(<rect x="{:.2f}" y="{:.2f}" width="12" height="12"/>)", x - 6, y - 6);
        _shapes += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", x, y - 8, Escape(stationID));
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    if (argc < 3 || argc > 4)
    {
        fmt::print("Usage: e13_lif_to_svg LIF SVG [MAPID]\n");
        return 2;
    }
    std::ifstream file(arguments[1], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::string> warnings; // A trajectory that is invalid closes its edge for a vehicle type.
    const Core::Result<SiteMap> site = DecodeLIF(text, warnings);
    std::ranges::for_each(warnings, [](const std::string& warning) { fmt::print("{}\n", warning); });
    if (!site.has_value())
    {
        fmt::print("{}: {}\n", arguments[1], file ? Core::Describe(site.error()) : "cannot be read");
        return 1;
    }
    std::set<std::string> maps;
    std::ranges::for_each(site->GetNodes(), [&maps](const SiteNode& node) { maps.insert(node.mapID); });
    const std::string mapID = argc == 4 ? arguments[3] : site->GetNodes().front().mapID;
    if (!maps.contains(mapID))
    {
        fmt::print("{}: no map {}; its maps: {}\n", arguments[1], mapID, fmt::join(maps, ", "));
        return 1;
    }
    const std::string svg = Picture(*site, mapID).MakeSVG();
    std::ofstream picture(arguments[2]);
    picture << svg << std::flush;
    if (!picture)
    {
        fmt::print("{}: {}\n", arguments[2], std::generic_category().message(errno));
        return 1;
    }
    fmt::print("{}: {} nodes, {} edges\n", arguments[2], site->GetNodes().size(), site->GetEdges().size());
    return 0;
}
