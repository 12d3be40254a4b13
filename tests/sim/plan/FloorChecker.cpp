#include "FloorChecker.hpp"

#include "world/WorldEventCodec.hpp"
#include <acs/core/Overloaded.hpp>

#include <utility>
#include <variant>

namespace ACS::Simulation
{

namespace
{

constexpr std::string_view ALIAS = "AMR.";

std::string NameRobot(const std::string& robotID, const std::string& place)
{
    return place.starts_with(ALIAS) ? robotID + "." + place.substr(ALIAS.size()) : place;
}

bool IsOfRobot(const std::string& robotID, std::string_view place)
{
    return place.starts_with(robotID + ".");
}

/// Empty: the operator, or a robot that moves nothing.
std::string GetMover(const Sim::WorldEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [](const Sim::RobotDocked&) { return std::string(); },
            [](const Sim::CarrierPlaced&) { return std::string(); },
            [](const Sim::MemoryPlaced&) { return std::string(); },
            [](const auto& moved) {
                return moved.robotID;
            }},
        event);
}

} // namespace

std::optional<Sim::WorldEvent> MakeMoveOrNull(const std::string& robotID, const Planning::StartJob& job)
{
    const std::string from = job.from.value_or(std::string());
    const std::string to = job.to.value_or(std::string());
    if (job.action == "MemoryPickAndPlace")
    {
        return Sim::MemoryMoved{robotID, from, to};
    }
    if (job.action == "OpenSetCover" || job.action == "CloseSetCover")
    {
        return Sim::CoverMoved{robotID, job.position, job.action == "CloseSetCover"};
    }
    if (!from.empty() && !to.empty())
    {
        return Sim::CarrierMoved{robotID, {}, from, to}; // with any carrier that is there
    }
    return std::nullopt;
}

FloorChecker::FloorChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling)
    : _trace(trace),
      _site(site),
      _handling(handling)
{
}

void FloorChecker::NotePlan(const Protocol::ExecutionPlan& plan)
{
    for (const Protocol::PlanStep& step : plan.steps)
    {
        for (std::size_t i = 0; i < step.jobs.size(); ++i)
        {
            const Protocol::PlanJob& job = step.jobs[i];
            const std::string carrierID = i < step.carrierIDs.size() ? step.carrierIDs[i] : std::string();
            _demands[{plan.planID, step.stepNo, job.jobID}] = {step.action, step.position, job.from, job.to, carrierID};
        }
        if (step.jobs.empty())
        {
            _demands[{plan.planID, step.stepNo, {}}] = {step.action, step.position, {}, {}, {}};
        }
    }
}

void FloorChecker::OnPlaced(const std::string& robotID, std::string_view nodeID)
{
    const Planning::SiteStation* const stationOrNull = _site.FindStationAtOrNull(nodeID);
    ActByHand(Sim::RobotDocked{
        robotID,
        stationOrNull == nullptr ? std::vector<std::string>() : std::vector<std::string>{stationOrNull->stationID}});
}

void FloorChecker::OnJobBegun(const std::string& robotID, const JobKey& key)
{
    _current[robotID] = key;
    const std::optional<Sim::WorldEvent> demanded = MakeDemandedOrNull(robotID, key);
    if (!demanded.has_value())
    {
        return;
    }
    std::visit(
        Core::Overloaded{
            [this, &key](const Sim::CarrierMoved& moved) { Prepare(moved, std::get<0>(key)); },
            [this](const Sim::MemoryMoved& moved) { Prepare(moved); },
            [](const auto&) { /* nothing is in the way of a cover */ }},
        *demanded);
}

void FloorChecker::OnJobEnded(const std::string& robotID)
{
    _current.erase(robotID);
}

bool FloorChecker::IsMoved(const JobKey& key) const
{
    const std::optional<Sim::WorldEvent> demanded = MakeDemandedOrNull({}, key);
    const bool bCarrier = demanded.has_value() && std::holds_alternative<Sim::CarrierMoved>(*demanded);
    const bool bPretended = !demanded.has_value() || (_handling == EHandling::Carriers && !bCarrier);
    return bPretended || _moved.contains(key);
}

void FloorChecker::RemoveCarriers(const std::vector<std::string>& ports)
{
    for (const std::string& port : ports)
    {
        ActByHand(Sim::CarrierPlaced{{}, port});
    }
}

/// From the plan, independent of the command to the robot.
std::optional<Sim::WorldEvent> FloorChecker::MakeDemandedOrNull(const std::string& robotID, const JobKey& key) const
{
    const auto found = _demands.find(key);
    if (found == _demands.end())
    {
        return std::nullopt;
    }
    const Demand& demand = found->second;
    Planning::StartJob job;
    job.action = demand.action;
    job.position = demand.position;
    job.from = NameRobot(robotID, demand.from);
    job.to = NameRobot(robotID, demand.to);
    std::optional<Sim::WorldEvent> demanded = MakeMoveOrNull(robotID, job);
    if (demanded.has_value() && std::holds_alternative<Sim::CarrierMoved>(*demanded))
    {
        std::get<Sim::CarrierMoved>(*demanded).carrierID = demand.carrierID;
    }
    return demanded;
}

/// The carrier is placed once: a second load finds what the first one has left.
void FloorChecker::Prepare(const Sim::CarrierMoved& demanded, const std::string& planID)
{
    if (IsOfRobot(demanded.robotID, demanded.from))
    {
        ActByHand(Sim::CarrierPlaced{{}, demanded.to});
        return;
    }
    if (_carriers.try_emplace(demanded.carrierID, planID).second)
    {
        ActByHand(Sim::CarrierPlaced{demanded.carrierID, demanded.from});
    }
    const std::optional<std::string> left = _world.GetCarrierOrNull(demanded.to);
    if (left.has_value() && _carriers.at(*left) != planID)
    {
        _trace.Add("{} is removed from {}: its plan is finished", *left, demanded.to);
        ActByHand(Sim::CarrierPlaced{{}, demanded.to});
    }
}

void FloorChecker::Prepare(const Sim::MemoryMoved& demanded)
{
    ActByHand(Sim::MemoryPlaced{demanded.from, Sim::EMemory::Occupied});
    ActByHand(Sim::MemoryPlaced{demanded.to, Sim::EMemory::Empty});
}

void FloorChecker::ActByHand(const Sim::WorldEvent& event)
{
    Report(event, _world.Act(event));
}

/// The text is built only for a printed trace, because there are many.
void FloorChecker::Report(const Sim::WorldEvent& event, const Core::Result<void>& done) const
{
    if (_trace.IsPrinting())
    {
        _trace.Add(
            "floor: {} {}",
            Sim::EncodeWorldEvent(event),
            done.has_value() ? "done" : "refused: " + Core::Describe(done.error()));
    }
}

Core::Result<void> FloorChecker::Act(const Sim::WorldEvent& event)
{
    const std::string robotID = GetMover(event);
    if (!robotID.empty())
    {
        Check(robotID, event);
    }
    Core::Result<void> done = _world.Act(event);
    Report(event, done);
    if (!robotID.empty() && !done.has_value())
    {
        _trace.Violate(
            "{} received a command that is impossible on the floor: {}",
            robotID,
            Core::Describe(done.error()));
    }
    else if (const auto current = _current.find(robotID); current != _current.end() && ++_moved[current->second] > 1)
    {
        const auto& [planID, stepNo, jobID] = current->second;
        _trace.Violate("job {} of plan {} moved something twice", jobID, planID);
    }
    return done;
}

void FloorChecker::Check(const std::string& robotID, const Sim::WorldEvent& event)
{
    const auto current = _current.find(robotID);
    Sim::WorldEvent found = event;
    if (auto* const movedOrNull = std::get_if<Sim::CarrierMoved>(&found); movedOrNull != nullptr)
    {
        movedOrNull->carrierID = _world.GetCarrierOrNull(movedOrNull->from).value_or(std::string());
    }
    if (current == _current.end())
    {
        _trace.Violate("{} moves something without a job: {}", robotID, Sim::EncodeWorldEvent(found));
        return;
    }
    const auto& [planID, stepNo, jobID] = current->second;
    const std::optional<Sim::WorldEvent> demanded = MakeDemandedOrNull(robotID, current->second);
    if (demanded != found)
    {
        _trace.Violate(
            "{} executes job {} of plan {} with {}, but the plan specifies {}",
            robotID,
            jobID,
            planID,
            Sim::EncodeWorldEvent(found),
            demanded.has_value() ? Sim::EncodeWorldEvent(*demanded) : "nothing");
    }
}

std::optional<std::string> FloorChecker::GetCarrierOrNull(std::string_view place)
{
    return _world.GetCarrierOrNull(place);
}

std::optional<std::string> FloorChecker::GetPlaceOrNull(std::string_view carrierID)
{
    return _world.GetPlaceOrNull(carrierID);
}

Sim::EMemory FloorChecker::GetMemory(std::string_view place)
{
    return _world.GetMemory(place);
}

bool FloorChecker::IsCovered(std::string_view set)
{
    return _world.IsCovered(set);
}

std::vector<Sim::WorldEvent> FloorChecker::TakeEvents()
{
    return _world.TakeEvents();
}

} // namespace ACS::Simulation
