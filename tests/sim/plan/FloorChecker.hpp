#pragma once

#include "Trace.hpp"
#include "world/MemoryWorld.hpp"
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace ACS::Simulation
{

/// A job by its names in the plan: planID, stepNo and jobID, which is empty in a step without jobs.
using JobKey = std::tuple<std::string, std::int32_t, std::string>;

/// Which moves the robots of a run make on the floor. They only simulate the others.
enum class EHandling : std::uint8_t
{
    Carriers,
    Everything,
};

/// The floor of the simulated robots. Compares each move with the plan's job that the robot does. When a robot begins a
/// job, places its carrier or memory and clears the target, as the plan specifies and independent of the robot's
/// command.
class FloorChecker final : public Sim::IWorld
{
    struct Demand
    {
        std::string action;
        std::string position;
        std::string from; ///< May name the robot "AMR"; empty: none.
        std::string to;
        std::string carrierID; ///< Empty: none.
    };

    Trace& _trace;
    const Planning::SiteMap& _site;
    EHandling _handling;
    Sim::MemoryWorld _world;
    std::map<JobKey, Demand> _demands;
    std::map<std::string, JobKey> _current;       ///< The job that each robot does, by robot.
    std::map<JobKey, std::size_t> _moved;         ///< How often the robots have made the move of the job.
    std::map<std::string, std::string> _carriers; ///< PlanIDs, by carriers that were placed.

public:
    FloorChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling);

    void NotePlan(const Protocol::ExecutionPlan& plan);

    /// Sets the node of a robot that does not report it itself, where it reaches the station; empty nodeID: it drives.
    void OnPlaced(const std::string& robotID, std::string_view nodeID);
    void OnJobBegun(const std::string& robotID, const JobKey& key);
    void OnJobEnded(const std::string& robotID);

    /// Whether the carrier or memory of the job was brought to its `to`, or its cover moved. True of a job for which
    /// the robots of this world move nothing.
    [[nodiscard]] bool IsMoved(const JobKey& key) const;

    /// Removed by the operator.
    void RemoveCarriers(const std::vector<std::string>& ports);

    [[nodiscard]] Core::Result<void> Act(const Sim::WorldEvent& event) override;
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override;
    [[nodiscard]] Sim::EMemory GetMemory(std::string_view place) override;
    [[nodiscard]] bool IsCovered(std::string_view set) override;
    [[nodiscard]] std::vector<Sim::WorldEvent> TakeEvents() override;

private:
    [[nodiscard]] std::optional<Sim::WorldEvent> MakeDemandedOrNull(const std::string& robotID, const JobKey& key)
        const;
    void Check(const std::string& robotID, const Sim::WorldEvent& event);
    void Prepare(const Sim::CarrierMoved& demanded, const std::string& planID);
    void Prepare(const Sim::MemoryMoved& demanded);
    void ActByHand(const Sim::WorldEvent& event);
    void Report(const Sim::WorldEvent& event, const Core::Result<void>& done) const;
};

/// The move of a robot with this command; nullopt: the action moves nothing.
[[nodiscard]] std::optional<Sim::WorldEvent> MakeMoveOrNull(const std::string& robotID, const Planning::StartJob& job);

} // namespace ACS::Simulation
