#pragma once

#include "ChanceModel.hpp"
#include "EFault.hpp"
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Simulation
{

using FaultSet = std::bitset<FAULT_COUNT>;

/// The kind of all robots of a run.
enum class ERobotKind : std::uint8_t
{
    Memory,  ///< RadioRobot
    Vda5050, ///< VehicleRobot
    Arms,    ///< VehicleRobot; a CR is an ArmRobot.
};

/// "memory", "vda5050" or "arms".
[[nodiscard]] std::string_view GetText(ERobotKind kind);

/// What one seed makes of a run: the floor, the robots, the options, the faults and their duration.
struct Scenario
{
    std::uint64_t seed = 0;
    FaultSet faults; ///< By EFault.
    ERobotKind robots = ERobotKind::Memory;
    bool bMaintenance = false; ///< An operator takes robots out of service and puts them back.
    bool bShared = false;      ///< The store has a lease, and a standby takes over.
    bool bBatteries = false;   ///< Vehicles have to charge; robots in memory never have to.
    std::string siteName;
    std::vector<Planning::SiteNode> nodes;
    std::vector<Planning::SiteEdge> edges;
    std::vector<Planning::SiteStation> stations;
    Planning::EngineOptions options;
    std::vector<std::string> cassettePlaces; ///< Where an LR loads and unloads.
    std::vector<std::string> trayPlaces;     ///< Where a CR does.
    std::vector<std::string> sets;
    std::size_t planCount = 0;
    std::chrono::seconds faultsEnd{0};

    [[nodiscard]] bool Has(EFault fault) const
    {
        return faults.test(static_cast<std::size_t>(fault));
    }

    /// Whether its robots or their bases are VDA5050 vehicles.
    [[nodiscard]] bool HasVehicles() const
    {
        return robots != ERobotKind::Memory;
    }

    /// Cannot fail: the generated map is valid.
    [[nodiscard]] Planning::SiteMap MakeSite() const;
};

/// What the command line demands of all runs; nullopt: it is drawn from the seed.
struct ScenarioDemands
{
    FaultSet without;
    std::optional<ERobotKind> robots;
    std::optional<bool> bShared;
};

/// The same for the same seed.
[[nodiscard]] Scenario MakeScenario(std::uint64_t seed, const ScenarioDemands& demands);

/// A plan that a robot of the scenario can do.
[[nodiscard]] Protocol::ExecutionPlan MakeGoodPlan(
    const Scenario& scenario,
    ChanceModel& chance,
    const std::string& planID);

/// A plan that must be refused, each time for another reason.
[[nodiscard]] Protocol::ExecutionPlan MakeBadPlan(
    const Scenario& scenario,
    ChanceModel& chance,
    const std::string& planID);

} // namespace ACS::Simulation
