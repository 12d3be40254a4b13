#include "RadioRobot.hpp"

#include "RobotConnection.hpp"

#include <utility>

namespace ACS::Simulation
{

RadioRobot::RadioRobot(
    Timeline& timeline,
    Trace& trace,
    WorkChecker& workChecker,
    const Seeds& seeds,
    const std::string& robotID,
    const std::string& nodeID,
    bool bFaulty)
    : _timeline(timeline),
      _robot(timeline, trace, workChecker, seeds.robot, robotID, nodeID),
      _radio(timeline, _robot, seeds.radio)
{
    constexpr std::size_t REJECT_CHANCE = 40;
    constexpr std::size_t FAIL_CHANCE = 60;
    _robot.rejectChance = bFaulty ? REJECT_CHANCE : 0;
    _robot.failChance = bFaulty ? FAIL_CHANCE : 0;
}

std::unique_ptr<IRobotConnection> RadioRobot::MakeConnection(std::uint64_t number, EventHandler handler)
{
    return std::make_unique<RobotConnection>(_timeline, _radio, number, std::move(handler));
}

void RadioRobot::SetReachable(bool bReachable)
{
    _radio.SetUp(bReachable);
}

bool RadioRobot::IsReachable() const
{
    return _radio.IsUp();
}

void RadioRobot::Disturb()
{
    _robot.Disturb();
}

void RadioRobot::Recover()
{
    _robot.Recover();
}

bool RadioRobot::IsDisturbed() const
{
    return _robot.IsDisturbed();
}

/// It has no sensors for what it carries.
void RadioRobot::OnFloorChanged()
{
}

void RadioRobot::Forget()
{
    _robot.Forget();
}

void RadioRobot::Calm()
{
    _robot.rejectChance = 0;
    _robot.failChance = 0;
}

std::string RadioRobot::GetNodeID() const
{
    return _robot.GetSnapshot().state.lastNodeID;
}

bool RadioRobot::IsAtRest() const
{
    const RobotSnapshot& truth = _robot.GetSnapshot();
    return !truth.state.bPaused && truth.activeDriveID.empty() && truth.activeCommandID.empty();
}

/// A query brings it to the present time.
bool RadioRobot::IsWorkUnderWay() const
{
    return false;
}

} // namespace ACS::Simulation
