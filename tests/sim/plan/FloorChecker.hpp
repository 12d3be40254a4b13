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

/// Which moves the robots of a world make on the floor. The others they only pretend.
enum class EHandling : std::uint8_t
{
    Carriers,
    Everything,
};

/// The floor on which the simulated robots act. Each move is compared with what the plan demands of the job that the robot
/// does. People bring the carrier or memory of a job when a robot begins the job, and clear the target, by what the plan
/// demands and not by what the robot was commanded.
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
    std::map<std::string, JobKey> _current;       ///< By robot: the job that it does.
    std::map<JobKey, std::size_t> _moved;         ///< How often the robots have made the move of the job.
    std::map<std::string, std::string> _carriers; ///< PlanIDs, by carriers that were brought.

public:
    FloorChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling);

    void NotePlan(const Protocol::ExecutionPlan& plan);

    /// A robot that does not report it itself stands on the node, and reaches the station there; an empty nodeID: it drives.
    void OnPlaced(const std::string& robotID, std::string_view nodeID);
    void OnJobBegun(const std::string& robotID, const JobKey& key);
    void OnJobEnded(const std::string& robotID);

    /// Whether the carrier or memory of the job was brought to its `to`, or its cover moved. True of a job for which the robots
    /// of this world move nothing.
    [[nodiscard]] bool IsMoved(const JobKey& key) const;

    /// By the operator.
    void TakeCarriersOff(const std::vector<std::string>& ports);

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

/// What a robot does that is commanded so; nullopt where the action moves nothing.
[[nodiscard]] std::optional<Sim::WorldEvent> MakeMoveOrNull(const std::string& robotID, const Planning::StartJob& job);

} // namespace ACS::Simulation
