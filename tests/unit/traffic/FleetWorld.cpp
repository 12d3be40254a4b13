#include "FleetWorld.hpp"

#include "FleetSite.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
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

FleetWorld::FleetWorld(const FleetOptions& options)
    : _options(options),
      _random(options.seed),
      _site(MakeFleetSite(options.bLoadRestrictions)),
      _router(_site),
      _engine(MakeFleetEngineOptions(options.vehicles), _site, _random)
{
    const EngineOptions engineOptions = MakeFleetEngineOptions(options.vehicles);
    for (const RobotOptions& robot : engineOptions.robots)
    {
        Vehicle& vehicle = _vehicles.emplace_back();
        vehicle.robotID = robot.robotID.GetText();
        vehicle.nodeID = *robot.startNodeID;
        _indices.emplace(vehicle.robotID, _vehicles.size() - 1);
    }
    for (Vehicle& vehicle : _vehicles)
    {
        RaiseEvent(vehicle, LinkChanged{true});
        PublishState(vehicle);
    }
    RaiseTold();
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
    while (_submitted < _options.transports && _submitted - completed - failed < _options.plansAtOnce)
    {
        ++_submitted;
        const std::string planID = fmt::format("P{}", _submitted);
        const std::uint64_t from = GetRandom(FLEET_PLACES);
        const std::uint64_t to = (from + 1 + GetRandom(FLEET_PLACES - 1)) % FLEET_PLACES;
        const std::string fromID = fmt::format("A01.CP{:02}", from + 1);
        const std::string toID = fmt::format("A01.CP{:02}", to + 1);
        Plan plan{
            planID,
            "",
            static_cast<std::int32_t>(GetRandom(3)),
            {{1, "CassetteLoad", fromID, {"C"}, {{planID + "-1", fromID, "AMR.CP01"}}},
             {2, "CassetteUnload", toID, {"C"}, {{planID + "-2", "AMR.CP01", toID}}}}};
        _plans.emplace(planID, plan);
        EngineActions out;
        _engine.Handle(SubmitPlan{std::move(plan), _submitted}, _clock.GetNow(), out);
        Execute(out);
    }
}

bool FleetWorld::TryRun()
{
    const Core::SteadyTime end = _clock.GetNow().steady + TIME_LIMIT;
    SubmitMore();
    RaiseTold();
    while (completed + failed < _options.transports)
    {
        if (_entries.empty() || _entries.top().time > end || !violations.empty())
        {
            return false;
        }
        const Entry entry = _entries.top();
        _entries.pop();
        _clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(entry.time - _clock.GetNow().steady));
        Happen(entry);
        RaiseTold();
        CheckPlaces();
        SubmitMore();
        RaiseTold();
    }
    return true;
}

void FleetWorld::Happen(const Entry& entry)
{
    Vehicle& vehicle = _vehicles[entry.vehicle];
    switch (entry.happening)
    {
        case EHappening::Engine:
            if (_timers[entry.timer] == entry.order)
            {
                EngineActions out;
                _engine.OnTimer(entry.timer, _clock.GetNow(), out);
                Execute(out);
            }
            break;
        case EHappening::Accept:
            vehicle.bAccepted = true;
            RaiseEvent(vehicle, NodePassed{vehicle.drive->driveID, vehicle.nodeID});
            BeginLeg(vehicle);
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
                    _engine.OnStored({}, _clock.GetNow(), released);
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
                    _engine.Handle(MessageAcknowledged{typed.entry.sequence}, _clock.GetNow(), out);
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
        const Plan& plan = _plans.at(planID);
        const std::string robotID = _engine.GetPlanOrNull(planID)->robotID.value_or("");
        const std::string first = "D-" + plan.steps[0].position;
        Transport transport;
        transport.begin = _clock.GetNow().steady;
        transport.idealSeconds = GetSeconds(_vehicles[_indices.at(robotID)].nodeID, first)
            + GetSeconds(first, "D-" + plan.steps[1].position);
        _running[planID] = transport;
        return;
    }
    if (planOrNull->state == EPlanState::Completed)
    {
        ++completed;
        const std::chrono::duration<double> taken = _clock.GetNow().steady - _running.at(planID).begin;
        _slowdowns.push_back(taken.count() / _running.at(planID).idealSeconds);
    }
    else
    {
        ++failed;
        violations.push_back(fmt::format("{} is {}: {}", planID, GetText(planOrNull->state), planOrNull->message));
    }
    _running.erase(planID);
}

void FleetWorld::Obey(Vehicle& vehicle, const RobotCommand& command)
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
                vehicle.bAccepted = false;
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
                    if (!vehicle.bMoving && vehicle.bAccepted)
                    {
                        Stop(vehicle);
                    }
                }
            },
            [this, &vehicle, number](const StartJob& job) {
                vehicle.jobID = job.jobID;
                Push(EHappening::Job, number, 0, std::chrono::seconds(3 + GetRandom(8)));
            },
            [this, &vehicle](const auto&) {
                violations.push_back(vehicle.robotID + " received an unexpected command");
            }},
        command);
}

void FleetWorld::RaiseEvent(Vehicle& vehicle, RobotEvent event)
{
    if (vehicle.bLost)
    {
        vehicle.untold.push_back(std::move(event));
        return;
    }
    _raised.emplace_back(static_cast<std::size_t>(&vehicle - _vehicles.data()), std::move(event));
}

void FleetWorld::PublishState(Vehicle& vehicle)
{
    const auto [x, y] = GetPosition(vehicle);
    StateChanged state;
    state.x = x;
    state.y = y;
    state.bPoseKnown = true;
    state.batteryPercent = 80;
    state.lastNodeID = vehicle.nodeID;
    state.bDriving = vehicle.bMoving && !vehicle.bPaused;
    state.bPaused = vehicle.bPaused;
    RaiseEvent(vehicle, std::move(state));
}

void FleetWorld::RaiseTold()
{
    while (!_raised.empty())
    {
        const std::pair<std::size_t, RobotEvent> raised = std::move(_raised.front());
        _raised.pop_front();
        ++events;
        EngineActions out;
        _engine.Handle(_vehicles[raised.first].robotID, raised.second, _clock.GetNow(), out);
        Execute(out);
    }
}

void FleetWorld::BeginLeg(Vehicle& vehicle)
{
    if (!vehicle.drive.has_value() || !vehicle.bAccepted || vehicle.bMoving || vehicle.bPaused || vehicle.bStopping
        || vehicle.index + 1 >= vehicle.drive->releasedCount)
    {
        return;
    }
    vehicle.bMoving = true;
    vehicle.legDone = 0;
    vehicle.legTime = _clock.GetNow().steady;
    ChangeSpeed(vehicle, vehicle.speed, false);
}

/// Takes effect at the present point of the leg.
void FleetWorld::ChangeSpeed(Vehicle& vehicle, double speed, bool bPaused)
{
    vehicle.legDone = GetLegDone(vehicle);
    vehicle.legTime = _clock.GetNow().steady;
    vehicle.speed = speed;
    vehicle.bPaused = bPaused;
    ++vehicle.generation;
    if (vehicle.bMoving && !bPaused)
    {
        const double seconds = (1 - vehicle.legDone) * GetLegLength(vehicle) / speed;
        Push(
            EHappening::Leg,
            static_cast<std::size_t>(&vehicle - _vehicles.data()),
            vehicle.generation,
            ToDuration(seconds));
    }
}

void FleetWorld::EndLeg(Vehicle& vehicle)
{
    const Drive& drive = *vehicle.drive;
    ++vehicle.index;
    vehicle.nodeID = drive.route.nodes[vehicle.index].nodeID;
    vehicle.bMoving = false;
    vehicle.legDone = 0;
    RaiseEvent(vehicle, NodePassed{drive.driveID, vehicle.nodeID});
    if (vehicle.index + 1 == drive.route.nodes.size())
    {
        RaiseEvent(vehicle, Arrived{drive.driveID});
        vehicle.drive.reset();
        PublishState(vehicle);
    }
    else if (vehicle.bStopping)
    {
        Stop(vehicle);
    }
    else
    {
        BeginLeg(vehicle);
    }
}

void FleetWorld::Stop(Vehicle& vehicle)
{
    const std::string driveID = vehicle.drive->driveID;
    vehicle.drive.reset();
    RaiseEvent(vehicle, DriveCancelled{driveID, vehicle.nodeID});
    PublishState(vehicle);
}

/// Begins or ends the fault of one vehicle; several may have one at the same time.
void FleetWorld::Fault()
{
    const std::size_t number = GetRandom(_vehicles.size());
    Vehicle& vehicle = _vehicles[number];
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

void FleetWorld::Recover(Vehicle& vehicle)
{
    if (std::exchange(vehicle.bLost, false))
    {
        RaiseEvent(vehicle, LinkChanged{true});
        for (RobotEvent& event : std::exchange(vehicle.untold, {}))
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
        const Vehicle& vehicle = _vehicles[i];
        occupy(i, vehicle.nodeID);
        if (vehicle.bMoving)
        {
            occupy(i, vehicle.drive->route.nodes[vehicle.index + 1].nodeID);
        }
        const std::pair<double, double> position = GetPosition(vehicle);
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

double FleetWorld::GetLegLength(const Vehicle& vehicle)
{
    return vehicle.drive->route.edges[vehicle.index].length;
}

double FleetWorld::GetLegDone(const Vehicle& vehicle) const
{
    if (!vehicle.bMoving || vehicle.bPaused)
    {
        return vehicle.legDone;
    }
    const std::chrono::duration<double> driven = _clock.GetNow().steady - vehicle.legTime;
    return std::min(1.0, vehicle.legDone + driven.count() * vehicle.speed / GetLegLength(vehicle));
}

std::pair<double, double> FleetWorld::GetPosition(const Vehicle& vehicle) const
{
    const SiteNode& node = *_site.FindNodeOrNull(vehicle.nodeID);
    if (!vehicle.bMoving)
    {
        return {node.x, node.y};
    }
    const RouteNode& next = vehicle.drive->route.nodes[vehicle.index + 1];
    const double done = GetLegDone(vehicle);
    return {node.x + done * (next.x - node.x), node.y + done * (next.y - node.y)};
}

/// The time on an empty floor, with the mean duration of a job.
double FleetWorld::GetSeconds(const std::string& from, const std::string& to) const
{
    constexpr double JOB_SECONDS = 6.5;
    return _router.FindRouteOrNull("lr-base", from, to)->travelSeconds + JOB_SECONDS;
}

double FleetWorld::GetMeanSlowdown() const
{
    return std::accumulate(_slowdowns.begin(), _slowdowns.end(), 0.0) / static_cast<double>(_slowdowns.size());
}

double FleetWorld::GetVirtualHours() const
{
    const std::chrono::duration<double, std::ratio<3'600>> hours =
        _clock.GetNow().steady - ManualClock().GetNow().steady;
    return hours.count();
}

std::string FleetWorld::Describe() const
{
    std::string text = fmt::format("{} of {} done", completed, _options.transports);
    const std::vector<RobotStatus> statuses = _engine.GetRobotStatuses();
    for (std::size_t i = 0; i < _vehicles.size(); ++i)
    {
        const Vehicle& vehicle = _vehicles[i];
        text += fmt::format("\n{} {} on {}", vehicle.robotID, GetText(statuses[i].status), vehicle.nodeID);
        if (vehicle.drive.has_value())
        {
            const std::vector<RouteNode>& nodes = vehicle.drive->route.nodes;
            text += fmt::format(
                " to {}, node {} of {} released",
                nodes.back().nodeID,
                vehicle.index,
                vehicle.drive->releasedCount);
            for (const RouteNode& node : nodes)
            {
                text += " " + node.nodeID;
            }
        }
        if (statuses[i].planID.has_value())
        {
            const Plan& plan = _plans.at(*statuses[i].planID);
            text += fmt::format(" {} {}>{}", plan.planID, plan.steps[0].position, plan.steps[1].position);
        }
        text += vehicle.bPaused ? " paused" : "";
        text += vehicle.bLost ? " lost" : "";
    }
    return text;
}

} // namespace ACS::Testing
