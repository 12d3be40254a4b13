#include "FleetWorld.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr double LEAST_GAP = 1; ///< Metres between two vehicles.
constexpr std::chrono::hours TIME_LIMIT{24 * 7};

Core::Duration ToDuration(double seconds)
{
    return std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(seconds * 1'000)));
}

} // namespace

FleetWorld::FleetWorld(const Floor& floor, const FleetOptions& options, std::unique_ptr<IFleetControl> control)
    : _options(options),
      _random(options.seed),
      _floor(floor),
      _site(floor.site),
      _transports(floor, options.seed, options.transports, options.priorities),
      _control(std::move(control))
{
    for (std::size_t i = 0; i < options.vehicles; ++i)
    {
        FloorVehicle& vehicle = _vehicles.emplace_back();
        vehicle.robotID = fmt::format("LR{:02}", i + 1);
        vehicle.nodeID = MakeDockID(_floor.parking.at(i));
        _indices.emplace(vehicle.robotID, i);
    }
    for (FloorVehicle& vehicle : _vehicles)
    {
        RaiseEvent(vehicle, LinkChanged{true});
        PublishState(vehicle);
    }
    DeliverEvents();
    if (options.bFaults)
    {
        Push(EHappening::Fault, 0, 0, std::chrono::seconds(10));
    }
}

std::uint64_t FleetWorld::GetRandom(std::uint64_t below)
{
    return _random.GetNext() % below;
}

void FleetWorld::Push(EHappening happening, std::size_t vehicle, std::uint64_t generation, Core::Duration delay)
{
    ++_order;
    _entries.push({_clock.GetNow().steady + delay, _order, happening, vehicle, {}, generation});
}

void FleetWorld::SubmitMore()
{
    while (_transports.HasMore() && _transports.CountOpen() < _options.plansAtOnce)
    {
        Plan plan = _transports.Submit(_clock.GetNow().steady);
        ++_submitted;
        EngineActions out;
        _control->Submit(std::move(plan), _submitted, _clock.GetNow(), out);
        Execute(out);
    }
}

bool FleetWorld::TryRun()
{
    const Core::SteadyTime end = _clock.GetNow().steady + TIME_LIMIT;
    SubmitMore();
    DeliverEvents();
    while (!_transports.IsDone())
    {
        if (_entries.empty() || _entries.top().time > end || !violations.empty())
        {
            return false;
        }
        const Entry entry = _entries.top();
        _entries.pop();
        _clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(entry.time - _clock.GetNow().steady));
        Happen(entry);
        DeliverEvents();
        CheckPlaces();
        SubmitMore();
        DeliverEvents();
    }
    return true;
}

void FleetWorld::Happen(const Entry& entry)
{
    FloorVehicle& vehicle = _vehicles[entry.vehicle];
    switch (entry.happening)
    {
        case EHappening::Engine:
            if (_timers[entry.timer] == entry.order)
            {
                EngineActions out;
                _control->OnTimer(entry.timer, _clock.GetNow(), out);
                Execute(out);
            }
            break;
        case EHappening::Accept:
            vehicle.phase = EDrivePhase::OnNode;
            RaiseEvent(vehicle, NodePassed{vehicle.drive->driveID, vehicle.nodeID});
            Continue(vehicle);
            break;
        case EHappening::Leg:
            if (vehicle.generation == entry.generation)
            {
                EndLeg(vehicle);
            }
            break;
        case EHappening::Job:
            vehicle.bLoaded = vehicle.jobID.ends_with("-1");
            RaiseEvent(vehicle, JobFinished{std::exchange(vehicle.jobID, {})});
            break;
        case EHappening::Fault:
            Fault();
            break;
        case EHappening::Recovery:
            Recover(vehicle);
            break;
        default:
            violations.emplace_back("no case for a happening");
            break;
    }
}

void FleetWorld::Execute(const EngineActions& actions)
{
    for (const EngineAction& action : actions)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans&) {
                    EngineActions released;
                    _control->OnStored(_clock.GetNow(), released);
                    Execute(released);
                },
                [this](const ReplyCommand& typed) {
                    if (!typed.bAccepted)
                    {
                        violations.push_back("refused: " + typed.message);
                    }
                },
                [this](const SendReport& typed) {
                    OnReport(typed.entry.report);
                    EngineActions out;
                    _control->OnReportSent(typed.entry.sequence, _clock.GetNow(), out);
                    Execute(out);
                },
                [this](const CommandRobot& typed) { Obey(_vehicles[_indices.at(typed.robotID)], typed.command); },
                [this](const StartEngineTimer& typed) {
                    ++_order;
                    _timers[typed.timer] = _order;
                    _entries.push(
                        {_clock.GetNow().steady + typed.delay, _order, EHappening::Engine, 0, typed.timer, 0});
                },
                [this](const CancelEngineTimer& typed) { _timers[typed.timer] = 0; },
                [](const auto&) {
                }},
            action);
    }
}

void FleetWorld::OnReport(const Report& report)
{
    const auto* planOrNull = std::get_if<PlanReport>(&report);
    if (planOrNull == nullptr)
    {
        return;
    }
    const std::string& planID = planOrNull->planID;
    if (planOrNull->state == EPlanState::InProgress)
    {
        const std::string robotID = _control->GetRobotIDOrNull(planID).value_or("");
        _transports.Begin(planID, _vehicles[_indices.at(robotID)].nodeID, _clock.GetNow().steady);
    }
    else if (planOrNull->state == EPlanState::Completed)
    {
        _transports.Complete(planID, _clock.GetNow().steady);
    }
    else
    {
        violations.push_back(fmt::format("{} is {}: {}", planID, GetText(planOrNull->state), planOrNull->message));
    }
}

void FleetWorld::Obey(FloorVehicle& vehicle, const RobotCommand& command)
{
    const auto number = static_cast<std::size_t>(&vehicle - _vehicles.data());
    if (vehicle.bLost)
    {
        violations.push_back(vehicle.robotID + " received a command while it was lost");
    }
    std::visit(
        Core::Overloaded{
            [this, &vehicle, number](const Drive& drive) {
                if (vehicle.drive.has_value() || drive.route.nodes.front().nodeID != vehicle.nodeID)
                {
                    violations.push_back(vehicle.robotID + " received a drive that it cannot begin");
                    return;
                }
                const ELoad load = vehicle.bLoaded ? ELoad::Loaded : ELoad::Empty;
                for (const RouteEdge& edge : drive.route.edges)
                {
                    const auto found = std::ranges::find(_site.GetEdges(), edge.edgeID, &SiteEdge::edgeID);
                    if (!found->rules.front().IsPermitted(load))
                    {
                        violations.push_back(vehicle.robotID + " must not use " + edge.edgeID + " with its load");
                    }
                }
                ++drives;
                vehicle.drive = drive;
                vehicle.index = 0;
                vehicle.phase = EDrivePhase::Sent;
                vehicle.bStopping = false;
                Push(EHappening::Accept, number, 0, std::chrono::milliseconds(50));
            },
            [this, &vehicle](const ExtendDrive& extend) {
                if (!vehicle.drive.has_value() || extend.driveID != vehicle.drive->driveID
                    || extend.releasedCount <= vehicle.drive->releasedCount)
                {
                    violations.push_back(vehicle.robotID + " received an extension that does not fit");
                    return;
                }
                vehicle.drive->releasedCount = extend.releasedCount;
                BeginLeg(vehicle);
            },
            [this, &vehicle](const CancelDrive& cancel) {
                if (vehicle.drive.has_value() && cancel.driveID == vehicle.drive->driveID)
                {
                    ++cancels;
                    vehicle.bStopping = true;
                    if (vehicle.phase == EDrivePhase::OnNode)
                    {
                        Stop(vehicle);
                    }
                }
            },
            [this, &vehicle, number](const StartJob& job) {
                vehicle.jobID = job.jobID;
                const Demand& demand = _transports.GetDemand(job.planID);
                const double seconds = job.stepNo == 1 ? demand.loadSeconds : demand.unloadSeconds;
                Push(EHappening::Job, number, 0, ToDuration(seconds));
            },
            [this, &vehicle](const auto&) {
                violations.push_back(vehicle.robotID + " received an unexpected command");
            }},
        command);
}

void FleetWorld::RaiseEvent(FloorVehicle& vehicle, RobotEvent event)
{
    if (vehicle.bLost)
    {
        vehicle.undelivered.push_back(std::move(event));
        return;
    }
    _raised.emplace_back(static_cast<std::size_t>(&vehicle - _vehicles.data()), std::move(event));
}

void FleetWorld::PublishState(FloorVehicle& vehicle)
{
    const auto [x, y] = vehicle.GetPosition(_site, _clock.GetNow().steady);
    StateChanged state;
    state.x = x;
    state.y = y;
    state.bPoseKnown = true;
    state.batteryPercent = 80;
    state.lastNodeID = vehicle.nodeID;
    state.bDriving = vehicle.phase == EDrivePhase::OnLeg && !vehicle.bPaused;
    state.bPaused = vehicle.bPaused;
    RaiseEvent(vehicle, std::move(state));
}

void FleetWorld::DeliverEvents()
{
    while (!_raised.empty())
    {
        const std::pair<std::size_t, RobotEvent> raised = std::move(_raised.front());
        _raised.pop_front();
        ++events;
        EngineActions out;
        _control->OnEvent(_vehicles[raised.first].robotID, raised.second, _clock.GetNow(), out);
        Execute(out);
    }
}

void FleetWorld::BeginLeg(FloorVehicle& vehicle)
{
    if (vehicle.phase != EDrivePhase::OnNode || vehicle.bPaused || vehicle.bStopping
        || vehicle.index + 1 >= vehicle.drive->releasedCount)
    {
        return;
    }
    vehicle.phase = EDrivePhase::OnLeg;
    vehicle.legDone = 0;
    vehicle.legTime = _clock.GetNow().steady;
    ChangeSpeed(vehicle, vehicle.speed, false);
}

void FleetWorld::ChangeSpeed(FloorVehicle& vehicle, double speed, bool bPaused)
{
    vehicle.ChangeSpeed(speed, bPaused, _clock.GetNow().steady);
    const std::optional<double> seconds = vehicle.GetLegSecondsOrNull();
    if (seconds.has_value())
    {
        Push(
            EHappening::Leg,
            static_cast<std::size_t>(&vehicle - _vehicles.data()),
            vehicle.generation,
            ToDuration(*seconds));
    }
}

void FleetWorld::EndLeg(FloorVehicle& vehicle)
{
    const Drive& drive = *vehicle.drive;
    ++vehicle.index;
    vehicle.nodeID = drive.route.nodes[vehicle.index].nodeID;
    vehicle.phase = EDrivePhase::OnNode;
    vehicle.legDone = 0;
    RaiseEvent(vehicle, NodePassed{drive.driveID, vehicle.nodeID});
    if (vehicle.index + 1 == drive.route.nodes.size())
    {
        RaiseEvent(vehicle, Arrived{drive.driveID});
        vehicle.drive.reset();
        vehicle.phase = EDrivePhase::None;
        PublishState(vehicle);
    }
    else
    {
        Continue(vehicle);
    }
}

/// On a node of its drive.
void FleetWorld::Continue(FloorVehicle& vehicle)
{
    if (vehicle.bStopping)
    {
        Stop(vehicle);
    }
    else
    {
        BeginLeg(vehicle);
    }
}

void FleetWorld::Stop(FloorVehicle& vehicle)
{
    const std::string driveID = vehicle.drive->driveID;
    vehicle.drive.reset();
    vehicle.phase = EDrivePhase::None;
    RaiseEvent(vehicle, DriveCancelled{driveID, vehicle.nodeID});
    PublishState(vehicle);
}

/// Begins or ends the fault of one vehicle; several may have one at the same time.
void FleetWorld::Fault()
{
    const std::size_t number = GetRandom(_vehicles.size());
    FloorVehicle& vehicle = _vehicles[number];
    const bool bWell = !vehicle.bPaused && !vehicle.bLost && vehicle.speed >= 1;
    if (bWell)
    {
        switch (GetRandom(3))
        {
            case 0:
                ChangeSpeed(vehicle, vehicle.speed, true);
                PublishState(vehicle);
                break;
            case 1:
                ChangeSpeed(vehicle, 0.25, false);
                break;
            default:
                RaiseEvent(vehicle, LinkChanged{false});
                vehicle.bLost = true;
                break;
        }
        Push(EHappening::Recovery, number, 0, std::chrono::seconds(5 + GetRandom(90)));
    }
    Push(EHappening::Fault, 0, 0, std::chrono::seconds(1 + GetRandom(15)));
}

void FleetWorld::Recover(FloorVehicle& vehicle)
{
    if (std::exchange(vehicle.bLost, false))
    {
        RaiseEvent(vehicle, LinkChanged{true});
        for (RobotEvent& event : std::exchange(vehicle.undelivered, {}))
        {
            RaiseEvent(vehicle, std::move(event));
        }
    }
    ChangeSpeed(vehicle, 1, false);
    PublishState(vehicle);
    BeginLeg(vehicle);
}

/// Checks the real positions: a node has at most one vehicle that is on it or drives from or to it, and the distance of
/// two vehicles is at least their size.
void FleetWorld::CheckPlaces()
{
    _onNode.clear();
    std::vector<std::pair<double, double>> positions;
    const auto occupy = [this](std::size_t number, const std::string& nodeID) {
        const auto [place, bNew] = _onNode.emplace(nodeID, number);
        if (!bNew)
        {
            violations.push_back(fmt::format(
                "{} and {} are on {}",
                _vehicles[place->second].robotID,
                _vehicles[number].robotID,
                nodeID));
        }
    };
    for (std::size_t i = 0; i < _vehicles.size(); ++i)
    {
        const FloorVehicle& vehicle = _vehicles[i];
        occupy(i, vehicle.nodeID);
        if (vehicle.phase == EDrivePhase::OnLeg)
        {
            occupy(i, vehicle.drive->route.nodes[vehicle.index + 1].nodeID);
        }
        const std::pair<double, double> position = vehicle.GetPosition(_site, _clock.GetNow().steady);
        for (std::size_t other = 0; other < i; ++other)
        {
            const double x = positions[other].first - position.first;
            const double y = positions[other].second - position.second;
            if (x * x + y * y < LEAST_GAP * LEAST_GAP)
            {
                violations.push_back(fmt::format("{} touches {}", vehicle.robotID, _vehicles[other].robotID));
            }
        }
        positions.push_back(position);
    }
}

const TransportLog& FleetWorld::GetTransports() const noexcept
{
    return _transports;
}

double FleetWorld::GetVirtualHours() const
{
    const std::chrono::duration<double, std::ratio<3'600>> hours =
        _clock.GetNow().steady - ManualClock().GetNow().steady;
    return hours.count();
}

std::string FleetWorld::Describe() const
{
    std::string text = fmt::format("{} of {} done", _transports.GetFinished().size(), _options.transports);
    for (const FloorVehicle& vehicle : _vehicles)
    {
        text += "\n" + vehicle.Describe();
        for (const std::string& planID : _transports.ListOpen())
        {
            if (_control->GetRobotIDOrNull(planID) == vehicle.robotID)
            {
                const Demand& demand = _transports.GetDemand(planID);
                text += fmt::format(" {} {}>{}", planID, demand.from, demand.to);
            }
        }
    }
    return text;
}

} // namespace ACS::Testing
