#include "CellSite.hpp"

#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Load::CellSite
{
namespace
{

constexpr std::size_t CELLS_IN_A_ROW = 10;
constexpr double METRES_APART = 1.5; ///< Between the nodes of a ring.
constexpr double SPUR_METRES = 1.0;
constexpr double CELL_WIDTH = 12.0;
constexpr double CELL_HEIGHT = 8.0;

struct Place
{
    double x = 0.0;
    double y = 0.0;
};

// The ring goes round in this order; the spurs lie under its lower nodes and over its upper ones.
constexpr std::array RING{Place{0, 0}, Place{1, 0}, Place{2, 0}, Place{2, 1}, Place{1, 1}, Place{0, 1}};
constexpr std::size_t BOTTOM_LEFT = 0;
constexpr std::size_t SOURCE_NODE = 1;
constexpr std::size_t BOTTOM_RIGHT = 2;
constexpr std::size_t TOP_RIGHT = 3;
constexpr std::size_t TARGET_NODE = 4;
constexpr std::size_t TOP_LEFT = 5;

Place GetCorner(std::size_t cell)
{
    const std::size_t column = (cell - 1) % CELLS_IN_A_ROW;
    const std::size_t row = (cell - 1) / CELLS_IN_A_ROW;
    return {CELL_WIDTH * static_cast<double>(column), CELL_HEIGHT * static_cast<double>(row)};
}

Place GetPlace(std::size_t cell, std::size_t ringNode)
{
    const Place corner = GetCorner(cell);
    return {corner.x + METRES_APART * RING[ringNode].x, corner.y + METRES_APART * RING[ringNode].y};
}

std::string GetNode(std::size_t cell, std::size_t ringNode)
{
    return fmt::format("N{:04}-{}", cell, ringNode);
}

std::string GetDock(const std::string& stationID)
{
    return "D-" + stationID;
}

/// The way from the ring to a station.
struct Spur
{
    std::string stationID;
    std::size_t ringNode = 0;
};

std::vector<Spur> ListSpurs(std::size_t cell, std::size_t parking)
{
    std::vector<Spur> spurs{{GetSource(cell), SOURCE_NODE}, {GetTarget(cell), TARGET_NODE}};
    for (std::size_t number = 1; number <= parking; ++number)
    {
        spurs.push_back({GetParking(cell, number), number == 1 ? BOTTOM_RIGHT : TOP_RIGHT});
    }
    return spurs;
}

Place GetDockPlace(std::size_t cell, const Spur& spur)
{
    const Place place = GetPlace(cell, spur.ringNode);
    return {place.x, RING[spur.ringNode].y > 0 ? place.y + SPUR_METRES : place.y - SPUR_METRES};
}

using Edge = std::pair<std::string, std::string>;

void AddBothWays(const std::string& one, const std::string& other, std::vector<Edge>& edges)
{
    edges.emplace_back(one, other);
    edges.emplace_back(other, one);
}

std::vector<Edge> MakeEdges(std::size_t cells, std::size_t parking)
{
    std::vector<Edge> edges;
    for (std::size_t cell = 1; cell <= cells; ++cell)
    {
        for (std::size_t i = 0; i < RING.size(); ++i)
        {
            edges.emplace_back(GetNode(cell, i), GetNode(cell, (i + 1) % RING.size()));
        }
        for (const Spur& spur : ListSpurs(cell, parking))
        {
            AddBothWays(GetNode(cell, spur.ringNode), GetDock(spur.stationID), edges);
        }
        const bool bHasRight = cell % CELLS_IN_A_ROW != 0 && cell < cells;
        if (bHasRight)
        {
            edges.emplace_back(GetNode(cell, BOTTOM_RIGHT), GetNode(cell + 1, BOTTOM_LEFT));
            edges.emplace_back(GetNode(cell + 1, TOP_LEFT), GetNode(cell, TOP_RIGHT));
        }
        const bool bHasAbove = cell + CELLS_IN_A_ROW <= cells;
        if (bHasAbove)
        {
            AddBothWays(GetNode(cell, TOP_LEFT), GetNode(cell + CELLS_IN_A_ROW, BOTTOM_LEFT), edges);
        }
    }
    return edges;
}

void WriteMember(Json::JsonWriter& writer, std::string_view key, std::string_view value)
{
    writer.Key(key);
    writer.WriteString(value);
}

void WriteVehicleType(Json::JsonWriter& writer, std::string_view key)
{
    writer.Key(key);
    writer.BeginArray();
    writer.BeginObject();
    WriteMember(writer, "vehicleTypeId", VEHICLE_TYPE);
    writer.EndObject();
    writer.EndArray();
}

void WriteNode(Json::JsonWriter& writer, const std::string& nodeID, Place place)
{
    writer.BeginObject();
    WriteMember(writer, "nodeId", nodeID);
    WriteMember(writer, "mapId", "floor-1");
    writer.Key("nodePosition");
    writer.BeginObject();
    writer.Key("x");
    writer.WriteNumber(place.x);
    writer.Key("y");
    writer.WriteNumber(place.y);
    writer.EndObject();
    WriteVehicleType(writer, "vehicleTypeNodeProperties");
    writer.EndObject();
}

void WriteNodes(Json::JsonWriter& writer, std::size_t cells, std::size_t parking)
{
    writer.Key("nodes");
    writer.BeginArray();
    for (std::size_t cell = 1; cell <= cells; ++cell)
    {
        for (std::size_t i = 0; i < RING.size(); ++i)
        {
            WriteNode(writer, GetNode(cell, i), GetPlace(cell, i));
        }
        for (const Spur& spur : ListSpurs(cell, parking))
        {
            WriteNode(writer, GetDock(spur.stationID), GetDockPlace(cell, spur));
        }
    }
    writer.EndArray();
}

void WriteEdges(Json::JsonWriter& writer, std::size_t cells, std::size_t parking)
{
    writer.Key("edges");
    writer.BeginArray();
    for (const Edge& edge : MakeEdges(cells, parking))
    {
        writer.BeginObject();
        WriteMember(writer, "edgeId", edge.first + ">" + edge.second);
        WriteMember(writer, "startNodeId", edge.first);
        WriteMember(writer, "endNodeId", edge.second);
        WriteVehicleType(writer, "vehicleTypeEdgeProperties");
        writer.EndObject();
    }
    writer.EndArray();
}

void WriteStations(Json::JsonWriter& writer, std::size_t cells, std::size_t parking)
{
    writer.Key("stations");
    writer.BeginArray();
    for (std::size_t cell = 1; cell <= cells; ++cell)
    {
        for (const Spur& spur : ListSpurs(cell, parking))
        {
            writer.BeginObject();
            WriteMember(writer, "stationId", spur.stationID);
            writer.Key("interactionNodeIds");
            writer.BeginArray();
            writer.WriteString(GetDock(spur.stationID));
            writer.EndArray();
            writer.EndObject();
        }
    }
    writer.EndArray();
}

} // namespace

std::string WriteLIF(std::size_t cells, std::size_t parking)
{
    assert(parking <= MOST_PARKING);
    std::string text;
    Json::JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("metaInformation");
    writer.BeginObject();
    WriteMember(writer, "projectIdentification", "cells");
    WriteMember(writer, "creator", "acsd_robots_load");
    WriteMember(writer, "exportTimestamp", "2026-01-01T00:00:00Z");
    WriteMember(writer, "lifVersion", "1.0.0");
    writer.EndObject();
    writer.Key("layouts");
    writer.BeginArray();
    writer.BeginObject();
    WriteMember(writer, "layoutId", "cells");
    WriteMember(writer, "layoutVersion", "1");
    WriteNodes(writer, cells, parking);
    WriteEdges(writer, cells, parking);
    WriteStations(writer, cells, parking);
    writer.EndObject();
    writer.EndArray();
    writer.EndObject();
    return text;
}

std::string GetSource(std::size_t cell)
{
    return fmt::format("A{:02}.CP01", cell);
}

std::string GetTarget(std::size_t cell)
{
    return fmt::format("A{:02}.CP02", cell);
}

std::string GetParking(std::size_t cell, std::size_t number)
{
    return fmt::format("A{:02}.PK{:02}", cell, number);
}

std::string GetParkingNode(std::size_t cell, std::size_t number)
{
    return GetDock(GetParking(cell, number));
}

std::size_t GetNeighbour(std::size_t cell)
{
    return cell % 2 == 0 ? cell - 1 : cell + 1;
}

std::string GetStartNode(std::size_t cell)
{
    return GetDock(GetTarget(cell));
}

} // namespace ACS::Load::CellSite
