#pragma once

#include "world/WorldEvent.hpp"
#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// What one job of a plan does on the floor.
struct FloorMove
{
    std::int32_t stepNo = 0;
    std::string jobID; ///< Empty: the step has no jobs, and is itself the move.
    /// Without a robotID. Ports of the alias (AMR.CP01) keep it, see WithRobot. An empty carrierID stands for any carrier.
    Sim::WorldEvent event;

    bool operator==(const FloorMove&) const = default;
};

/// What a plan means on the floor. All locations are canonical.
struct FloorPlan
{
    std::vector<FloorMove> moves; ///< In the order of execution.
    /// What its fixed places must hold before the plan begins; an empty carrierID stands for an empty place.
    std::vector<Sim::CarrierPlaced> carriers;
    std::vector<Sim::MemoryPlaced> memories; ///< The same for memory places, those of the plan's trays included.
    std::vector<std::string> claims;         ///< The stations that it works at, and its carriers.

    bool operator==(const FloorPlan&) const = default;
};

/// Actions on a set move its cover, Start pushes a button. Every other job with a `from` and a `to` moves a memory if both
/// are memory places, else a carrier.
[[nodiscard]] FloorPlan MakeFloorPlan(const Protocol::ExecutionPlan& plan);

/// The event as this robot causes it: it has the robotID, and the alias in its places is replaced.
[[nodiscard]] Sim::WorldEvent WithRobot(Sim::WorldEvent event, const std::string& robotID);

/// Whether the journal's event is the one that was expected, which may leave the carrier open.
[[nodiscard]] bool IsSameMove(const Sim::WorldEvent& expected, const Sim::WorldEvent& actual);

/// Whether a robot has moved something; docking and a person's hand are no moves.
[[nodiscard]] bool IsMove(const Sim::WorldEvent& event);

/// "CR01: TRAY_01 from A01.CP02.TP01 to CR01.TP01"
[[nodiscard]] std::string Describe(const Sim::WorldEvent& event);

} // namespace ACS::McsSim
