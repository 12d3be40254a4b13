#pragma once

#include "dispatch/ReservedStations.hpp"
#include "robot/Fleet.hpp"
#include "traffic/VisitForecast.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Planning
{

/// Which stations will be taken when a plan's robot arrives there, during one pass over the queue. A plan that begins too early keeps
/// a robot waiting at a station, with a load, and other robots wait for that one.
class StationForecast
{
    const Fleet& _fleet;
    const VisitForecast& _visits;
    std::unordered_map<std::string_view, std::vector<std::size_t>>
        _robots;                ///< By station: those whose plans lead there.
    ReservedStations _reserved; ///< Of plans that were passed over.

public:
    /// Fleet and forecast must outlive it.
    StationForecast(const Fleet& fleet, const VisitForecast& visits);

    /// Whether a plan before it waits for one of its stations.
    [[nodiscard]] bool IsReserved(const ActivePlan& plan) const;
    /// Whether no other robot is expected at the stations of the plan's first steps when this robot is there, and the plan is not
    /// reserved.
    [[nodiscard]] bool CanBegin(const ActivePlan& plan, const Robot& robot) const;
    /// The robot has got the plan.
    void Add(const ActivePlan& plan, const Robot& robot);
    /// The plan does not begin now, and its stations are reserved.
    void PassOver(const ActivePlan& plan);
    /// A station of the plan's first steps to which other robots have plans.
    [[nodiscard]] std::optional<std::string_view> FindTakenOrNull(const ActivePlan& plan) const;
    /// The robots that have plans to the station.
    [[nodiscard]] std::vector<std::size_t> ListRobots(std::string_view stationID) const;

private:
    [[nodiscard]] bool IsExpected(const Robot& robot, std::string_view stationID, const Visit& visit) const;
};

} // namespace ACS::Planning
