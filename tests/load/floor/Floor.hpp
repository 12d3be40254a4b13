#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// The vehicle type of every floor; it drives 1 m/s where the map gives no speed.
inline constexpr const char* FLEET_TYPE = "lr-base";

/// Transports from any of some stations to any other of some stations.
struct Flow
{
    std::vector<std::string> from;
    std::vector<std::string> to;
    std::uint64_t weight = 1; ///< Relative to the other flows.
};

/// A floor to drive on, and what is transported there.
struct Floor
{
    std::string name;
    Planning::SiteMap site;
    std::vector<std::string> parking; ///< Stations, one for each vehicle at most.
    std::vector<Flow> flows;
};

/// One transport: a carrier from one station to another.
struct Demand
{
    std::string from;
    std::string to;
    std::int32_t priority = 0;
    double loadSeconds = 0; ///< The time of the job at each station.
    double unloadSeconds = 0;
};

/// The node of a station.
[[nodiscard]] std::string MakeDockID(const std::string& stationID);

/// Rows are alternately one-way, except the first and the last; columns are two-way. A third of the docks is on dead
/// ends of three nodes on the left and the right, which a vehicle leaves by the route by which it came. With load restrictions
/// a quarter of the columns is for empty vehicles only, and a quarter for loaded ones.
[[nodiscard]] Floor MakeGridFloor(bool bLoadRestrictions);
/// One two-way lane. Stations and parking positions are in bays beside it, and vehicles pass each other only there.
[[nodiscard]] Floor MakeLaneFloor();
/// The layout of the MCS-ACS document, of which there are two areas: a stocker, and in each area cassette ports and sets, on one-way
/// lanes.
[[nodiscard]] Floor MakeDocumentFloor();
/// A store with racks, three production lines and shipping on one-way aisles. Few docks have much of the traffic.
[[nodiscard]] Floor MakePlantFloor();

/// The options of an engine for this number of vehicles, at most one for each parking position.
[[nodiscard]] Planning::EngineOptions MakeEngineOptions(const Floor& floor, std::size_t vehicles);

/// The same transports for each seed, with this number of priorities.
[[nodiscard]] std::vector<Demand> MakeDemands(
    const Floor& floor,
    std::uint64_t seed,
    std::size_t count,
    std::uint64_t priorities);

} // namespace ACS::Testing
