#include "config/CorridorConfig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

void ReadCorridors(const Apps::ConfigSection& site, std::optional<Planning::SiteMap>& map)
{
    constexpr double WIDEST = 100; // metres
    const std::vector<Apps::ConfigSection> tables = site.GetSectionList("corridors");
    std::vector<Planning::SiteEdge> edges = map.has_value() ? map->GetEdges() : std::vector<Planning::SiteEdge>();
    for (const Apps::ConfigSection& table : tables)
    {
        const std::string edgeID = table.GetString("edge");
        Planning::SiteCorridor corridor;
        corridor.leftWidth = table.GetNumber("left", 0, WIDEST);
        corridor.rightWidth = table.GetNumber("right", 0, WIDEST);
        corridor.bContour = table.GetWord("ref", {"KINEMATICCENTER", "CONTOUR"}, "KINEMATICCENTER") == "CONTOUR";
        const auto edge = std::ranges::find(edges, edgeID, &Planning::SiteEdge::edgeID);
        if (edge == edges.end())
        {
            if (map.has_value())
            {
                table.AddError("edge", fmt::format("the map has no edge {}", Core::QuoteForError(edgeID)));
            }
            continue;
        }
        if (edge->corridor.has_value())
        {
            table.AddError("edge", fmt::format("{} has a corridor already", edgeID));
        }
        edge->corridor = corridor;
    }
    if (map.has_value() && !tables.empty())
    {
        map = *Planning::SiteMap::Create(map->GetNodes(), std::move(edges), map->GetStations());
    }
}

} // namespace ACS::Acsd
