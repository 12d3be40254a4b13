#include "OperatorSimulator.hpp"

#include <iterator>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

/// One a second: by then whatever a disk that works was given is on it, also what had waited for it.
constexpr std::size_t LOOKS_UNTIL_STORED = 15;

} // namespace

OperatorSimulator::OperatorSimulator(
    Timeline& timeline,
    Trace& trace,
    const ChanceSeed& seed,
    const Robots& robots,
    const CrashableStore& store,
    ProcessSource getProcessOrNull)
    : _trace(trace),
      _dice(seed),
      _robots(robots),
      _store(store),
      _getProcessOrNull(std::move(getProcessOrNull)),
      _habits(timeline)
{
}

void OperatorSimulator::Begin()
{
    _habits.Start(EBehaviour::Turn, _dice.GetBetween(1s, 60s), [this] { Turn(); });
    _habits.Start(EBehaviour::Look, 1s, [this] { Look(); });
}

void OperatorSimulator::End()
{
    _habits.CancelAll();
}

void OperatorSimulator::OnStart()
{
    _resting.clear();
    for (auto& [robotID, service] : _services)
    {
        if (std::exchange(service.looks, 0) >= LOOKS_UNTIL_STORED)
        {
            _expected[robotID] = service.bInMaintenance;
        }
    }
}

/// Of one that is out of reach he does not say that it is out of service: acsd takes it for one that was carried away.
void OperatorSimulator::Turn()
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    if (processOrNull != nullptr)
    {
        const auto chosen = std::next(_robots.begin(), static_cast<std::ptrdiff_t>(_dice.GetBelow(_robots.size())));
        for (const Planning::RobotStatus& robot : processOrNull->GetEngine().GetRobotStatuses())
        {
            const bool bSeen = robot.status != Planning::ERobotStatus::Disconnected;
            if (robot.robotID == chosen->first && (robot.bInMaintenance || bSeen))
            {
                _trace.Tell("operator: {} is {} service", robot.robotID, robot.bInMaintenance ? "in" : "out of");
                processOrNull->PushCommand(Planning::SetMaintenance{robot.robotID, !robot.bInMaintenance, 0});
                _expected.erase(robot.robotID);
                _services[robot.robotID].looks = 0;
            }
        }
    }
    _habits.Start(EBehaviour::Turn, _dice.GetBetween(1s, 40s), [this] { Turn(); });
}

void OperatorSimulator::Look()
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    const std::vector<Planning::RobotStatus> statuses =
        processOrNull == nullptr ? std::vector<Planning::RobotStatus>() : processOrNull->GetEngine().GetRobotStatuses();
    for (const Planning::RobotStatus& robot : statuses)
    {
        LookAtRest(robot);
        LookAtService(robot);
    }
    _habits.Start(EBehaviour::Look, 1s, [this] { Look(); });
}

void OperatorSimulator::LookAtRest(const Planning::RobotStatus& robot)
{
    const ISimulatedRobot& truth = *_robots.at(robot.robotID);
    const auto resting = _resting.find(robot.robotID);
    // Else a drive may still be on its way to it.
    const bool bStands = robot.status == Planning::ERobotStatus::Stopped && truth.IsAtRest();
    if (!robot.bInMaintenance || truth.IsDisturbed())
    { // somebody who has it in hand may carry it elsewhere
        _resting.erase(robot.robotID);
    }
    else if (resting == _resting.end() && !robot.planID.has_value() && bStands)
    {
        _resting.emplace(robot.robotID, truth.GetNodeID());
    }
    else if (resting != _resting.end() && robot.planID.has_value())
    {
        _trace.Violate("{} is out of service and was assigned plan {}", robot.robotID, *robot.planID);
    }
    else if (resting != _resting.end() && resting->second != truth.GetNodeID())
    {
        _trace.Violate("{} is out of service and moves to {}", robot.robotID, truth.GetNodeID());
    }
}

void OperatorSimulator::LookAtService(const Planning::RobotStatus& robot)
{
    const auto expected = _expected.find(robot.robotID);
    if (expected != _expected.end() && expected->second != robot.bInMaintenance)
    {
        _trace.Violate(
            "{} is {} service after a restart, unlike before",
            robot.robotID,
            robot.bInMaintenance ? "out of" : "in");
    }
    if (expected != _expected.end())
    {
        _expected.erase(expected);
    }
    Service& service = _services[robot.robotID];
    const bool bSame = service.bInMaintenance == robot.bInMaintenance && !_store.bFails;
    service = {robot.bInMaintenance, bSame ? service.looks + 1 : 0};
}

void OperatorSimulator::GiveBack() const
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    const std::vector<Planning::RobotStatus> statuses =
        processOrNull == nullptr ? std::vector<Planning::RobotStatus>() : processOrNull->GetEngine().GetRobotStatuses();
    for (const Planning::RobotStatus& robot : statuses)
    {
        if (robot.bInMaintenance)
        {
            processOrNull->PushCommand(Planning::SetMaintenance{robot.robotID, false, 0});
        }
    }
}

} // namespace ACS::Simulation
