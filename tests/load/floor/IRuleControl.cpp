#include "IRuleControl.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

IRuleControl::IRuleControl(const Floor& floor, std::size_t vehicles)
    : _site(floor.site),
      _router(floor.site)
{
    for (std::size_t i = 0; i < vehicles; ++i)
    {
        Vehicle& vehicle = _vehicles.emplace_back();
        vehicle.robotID = fmt::format("LR{:02}", i + 1);
        vehicle.home = GetDock(floor.parking.at(i));
        vehicle.node = vehicle.home;
    }
}

void IRuleControl::Submit(Plan plan, std::uint64_t /*number*/, Core::Now /*now*/, EngineActions& out)
{
    _queue.push_back(std::move(plan));
    Run(out);
}

void IRuleControl::OnEvent(const std::string& robotID, const RobotEvent& event, Core::Now /*now*/, EngineActions& out)
{
    Vehicle& vehicle = *std::ranges::find(_vehicles, robotID, &Vehicle::robotID);
    std::visit(
        Core::Overloaded{
            [this, &vehicle](const NodePassed& passed) {
                if (vehicle.drive.has_value() && passed.nodeID != _site.GetNodes()[vehicle.node].nodeID)
                {
                    ++vehicle.passed;
                    vehicle.node = vehicle.route[vehicle.passed];
                    OnPassed(vehicle);
                }
            },
            [&vehicle](const Arrived& /*arrived*/) { vehicle.drive.reset(); },
            [&vehicle, &out](const JobFinished& /*job*/) { EndJob(vehicle, out); },
            [](const auto& /*other*/) {
            }},
        event);
    Run(out);
}

void IRuleControl::EndJob(Vehicle& vehicle, EngineActions& out)
{
    vehicle.bWorks = false;
    ++vehicle.step;
    if (vehicle.step == vehicle.plan->steps.size())
    {
        Report(vehicle, EPlanState::Completed, out);
        vehicle.plan.reset();
    }
}

void IRuleControl::Report(const Vehicle& vehicle, EPlanState state, EngineActions& out)
{
    SendReport report;
    report.entry.report = PlanReport{vehicle.plan->planID, state, {}};
    out.emplace_back(std::move(report));
}

void IRuleControl::OnTimer(const EngineTimer& /*timer*/, Core::Now /*now*/, EngineActions& /*out*/)
{
}

void IRuleControl::OnStored(Core::Now /*now*/, EngineActions& /*out*/)
{
}

void IRuleControl::OnReportSent(std::uint64_t /*sequence*/, Core::Now /*now*/, EngineActions& /*out*/)
{
}

std::optional<std::string> IRuleControl::GetRobotIDOrNull(const std::string& planID) const
{
    const auto found = _robotIDs.find(planID);
    return found == _robotIDs.end() ? std::nullopt : std::optional(found->second);
}

const SiteMap& IRuleControl::GetSite() const noexcept
{
    return _site;
}

std::size_t IRuleControl::CountVehicles() const noexcept
{
    return _vehicles.size();
}

std::size_t IRuleControl::GetIndex(const Vehicle& vehicle) const
{
    return static_cast<std::size_t>(&vehicle - _vehicles.data());
}

const IRuleControl::Vehicle& IRuleControl::GetVehicle(std::size_t index) const
{
    return _vehicles[index];
}

std::size_t IRuleControl::GetDock(const std::string& stationID) const
{
    return *_site.FindNodeIndexOrNull(MakeDockID(stationID));
}

std::vector<std::size_t> IRuleControl::FindRoute(std::size_t from, std::size_t to) const
{
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    const std::optional<Route> route = _router.FindRouteOrNull(FLEET_TYPE, nodes[from].nodeID, nodes[to].nodeID);
    std::vector<std::size_t> indices;
    for (const RouteNode& node : route->nodes)
    {
        indices.push_back(*_site.FindNodeIndexOrNull(node.nodeID));
    }
    return indices;
}

void IRuleControl::Run(EngineActions& out)
{
    Assign(out);
    for (Vehicle& vehicle : _vehicles)
    {
        Move(vehicle, out);
    }
}

void IRuleControl::Assign(EngineActions& out)
{
    for (auto plan = _queue.begin(); plan != _queue.end();)
    {
        Vehicle* const nearestOrNull = FindNearestOrNull(*plan);
        if (nearestOrNull == nullptr)
        {
            return;
        }
        if (!TryTakePlan(*nearestOrNull, *plan))
        {
            ++plan;
            continue;
        }
        nearestOrNull->plan = std::move(*plan);
        nearestOrNull->step = 0;
        _robotIDs[nearestOrNull->plan->planID] = nearestOrNull->robotID;
        Report(*nearestOrNull, EPlanState::InProgress, out);
        plan = _queue.erase(plan);
    }
}

IRuleControl::Vehicle* IRuleControl::FindNearestOrNull(const Plan& plan)
{
    std::vector<std::size_t> starts;
    for (const Vehicle& vehicle : _vehicles)
    {
        if (!vehicle.plan.has_value() && !vehicle.drive.has_value())
        {
            starts.push_back(vehicle.node);
        }
    }
    const std::optional<QuickestStart> start =
        _router.FindQuickestStartOrNull(FLEET_TYPE, ELoad::Unknown, starts, GetDock(plan.steps.front().position));
    const auto nearest = std::ranges::find_if(_vehicles, [&start](const Vehicle& vehicle) {
        return start.has_value() && !vehicle.plan.has_value() && !vehicle.drive.has_value()
            && vehicle.node == start->nodeIndex;
    });
    return nearest == _vehicles.end() ? nullptr : &*nearest;
}

void IRuleControl::Move(Vehicle& vehicle, EngineActions& out)
{
    if (vehicle.bWorks)
    {
        return;
    }
    if (vehicle.drive.has_value())
    {
        Extend(vehicle, out);
        return;
    }
    const std::size_t target =
        vehicle.plan.has_value() ? GetDock(vehicle.plan->steps[vehicle.step].position) : vehicle.home;
    if (target != vehicle.node)
    {
        BeginDrive(vehicle, target, out);
    }
    else if (vehicle.plan.has_value())
    {
        const Step& step = vehicle.plan->steps[vehicle.step];
        StartJob job;
        job.planID = vehicle.plan->planID;
        job.stepNo = step.stepNo;
        job.jobID = step.jobs.front().jobID;
        out.emplace_back(CommandRobot{vehicle.robotID, job});
        vehicle.bWorks = true;
    }
}

void IRuleControl::BeginDrive(Vehicle& vehicle, std::size_t target, EngineActions& out)
{
    vehicle.route = FindRoute(vehicle.node, target);
    vehicle.passed = 0;
    vehicle.granted = 1;
    vehicle.granted = Grant(vehicle);
    if (vehicle.granted <= 1)
    {
        return;
    }
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    Drive drive;
    ++_driveCount;
    drive.driveID = fmt::format("D{}", _driveCount);
    drive.route = *_router.FindRouteOrNull(FLEET_TYPE, nodes[vehicle.node].nodeID, nodes[target].nodeID);
    drive.releasedCount = std::min(vehicle.granted, vehicle.route.size() - 1);
    vehicle.drive = drive;
    out.emplace_back(CommandRobot{vehicle.robotID, std::move(drive)});
}

void IRuleControl::Extend(Vehicle& vehicle, EngineActions& out)
{
    vehicle.granted = std::max(vehicle.granted, Grant(vehicle));
    if (vehicle.granted > vehicle.drive->releasedCount)
    {
        vehicle.drive->releasedCount = vehicle.granted;
        out.emplace_back(CommandRobot{vehicle.robotID, ExtendDrive{vehicle.drive->driveID, vehicle.granted}});
    }
}

} // namespace ACS::Testing
