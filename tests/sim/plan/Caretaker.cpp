#include "Caretaker.hpp"

#include <iterator>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

Caretaker::Caretaker(
    Timeline& timeline,
    Trace& trace,
    const DiceSeed& seed,
    const Robots& robots,
    ProcessSource getProcessOrNull)
    : _trace(trace),
      _dice(seed),
      _robots(robots),
      _getProcessOrNull(std::move(getProcessOrNull)),
      _habits(timeline)
{
}

void Caretaker::Begin()
{
    _habits.Start(EHabit::Turn, _dice.GetBetween(1s, 60s), [this] { Turn(); });
    _habits.Start(EHabit::Look, 1s, [this] { Look(); });
}

void Caretaker::End()
{
    _habits.CancelAll();
}

void Caretaker::OnStart()
{
    _resting.clear();
}

/// Of one that is out of reach he does not say that it is out of service: acsd takes it for one that was carried away.
void Caretaker::Turn()
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
            }
        }
    }
    _habits.Start(EHabit::Turn, _dice.GetBetween(1s, 40s), [this] { Turn(); });
}

void Caretaker::Look()
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    const std::vector<Planning::RobotStatus> statuses =
        processOrNull == nullptr ? std::vector<Planning::RobotStatus>() : processOrNull->GetEngine().GetRobotStatuses();
    for (const Planning::RobotStatus& robot : statuses)
    {
        const ISimulatedRobot& truth = *_robots.at(robot.robotID);
        const auto resting = _resting.find(robot.robotID);
        // Else a drive may still be on its way to it.
        const bool bStands = robot.status == Planning::ERobotStatus::Stopped && truth.IsAtRest();
        if (!robot.bInMaintenance)
        {
            _resting.erase(robot.robotID);
        }
        else if (resting == _resting.end() && !robot.planID.has_value() && bStands)
        {
            _resting.emplace(robot.robotID, truth.GetNodeID());
        }
        else if (resting != _resting.end() && robot.planID.has_value())
        {
            _trace.Violate("{} is out of service and has plan {}", robot.robotID, *robot.planID);
        }
        else if (resting != _resting.end() && resting->second != truth.GetNodeID())
        {
            _trace.Violate("{} is out of service and goes to {}", robot.robotID, truth.GetNodeID());
        }
    }
    _habits.Start(EHabit::Look, 1s, [this] { Look(); });
}

void Caretaker::GiveBack() const
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
