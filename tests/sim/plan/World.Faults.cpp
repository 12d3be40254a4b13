#include "World.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

// The faults of a run, until the last one.

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

/// All work must be finished within this time after the last fault.
constexpr std::chrono::hours SETTLING_LIMIT{2};

/// As those of World.cpp: whether the operator intervenes.
constexpr std::uint64_t INTERVENTION_PART = 307;

} // namespace

void World::CutOffSometime()
{
    if (_process != nullptr)
    {
        _process->CutOff();
    }
    _behaviours.Start(EBehaviour::Partition, _faultChance.GetBetween(5s, 90s), [this] { CutOffSometime(); });
}

void World::StopSometime()
{
    if (_process != nullptr)
    {
        _process->Stop();
    }
    _behaviours.Start(EBehaviour::Stop, _leaseChance.GetBetween(20s, 200s), [this] { StopSometime(); });
}

void World::BeginFaults()
{
    _behaviours.Start(EBehaviour::EndFaults, _scenario.faultsEnd, [this] { EndFaults(); });
    if (_scenario.Has(EFault::Disk))
    {
        _behaviours.Start(EBehaviour::Disk, _faultChance.GetBetween(1s, 60s), [this] { TurnDisk(); });
    }
    if (_scenario.Has(EFault::Link))
    {
        _behaviours.Start(EBehaviour::Link, _faultChance.GetBetween(0s, 20s), [this] { TurnLink(); });
    }
    if (_scenario.Has(EFault::Controls))
    {
        _behaviours.Start(EBehaviour::Operator, _faultChance.GetBetween(5s, 90s), [this] { Operate(); });
    }
    if (_scenario.bMaintenance)
    {
        _operator.Begin();
    }
    if (_scenario.Has(EFault::Controls) && ChanceModel({_scenario.seed, INTERVENTION_PART}).IsHit(300))
    {
        _operator.BeginInterventions();
    }
    if (_scenario.Has(EFault::Crashes))
    {
        _behaviours.Start(EBehaviour::Crash, _faultChance.GetBetween(1s, 120s), [this] { CrashSometime(); });
    }
    if (_scenario.Has(EFault::Radio) && _scenario.HasVehicles())
    {
        _behaviours.Start(EBehaviour::Broker, _faultChance.GetBetween(10s, 200s), [this] { TurnBroker(); });
    }
    if (_scenario.bShared && _scenario.Has(EFault::Partitions))
    {
        _behaviours.Start(EBehaviour::Partition, _faultChance.GetBetween(5s, 90s), [this] { CutOffSometime(); });
        _behaviours.Start(EBehaviour::Stop, _leaseChance.GetBetween(20s, 200s), [this] { StopSometime(); });
    }
    for (const auto& [robotID, robot] : _robots)
    {
        if (_scenario.Has(EFault::Robots))
        {
            _robotBehaviours.Start(robotID, _robotChance.GetBetween(5s, 120s), [this, id = robotID] { TurnRobot(id); });
        }
        if (_scenario.Has(EFault::Radio))
        {
            _radioBehaviours.Start(robotID, _robotChance.GetBetween(1s, 90s), [this, id = robotID] { TurnRadio(id); });
        }
    }
}

void World::EndFaults()
{
    _trace.Add("no more faults from now on");
    _bSettling = true;
    _deadline = _timeline.GetNow().steady + SETTLING_LIMIT;
    for (const EBehaviour behaviour :
         {EBehaviour::Disk,
          EBehaviour::Link,
          EBehaviour::Operator,
          EBehaviour::Crash,
          EBehaviour::Broker,
          EBehaviour::Partition,
          EBehaviour::Stop})
    {
        _behaviours.Cancel(behaviour);
    }
    _robotBehaviours.CancelAll();
    _radioBehaviours.CancelAll();
    _operator.End();
    _store.bFails = false;
    _broker.Calm();
    _network.SetReachable(true);
    _network.SetSlow(false);
    for (const auto& [robotID, robot] : _robots)
    {
        if (robot->IsDisturbed())
        {
            robot->Recover();
        }
        robot->Calm();
        robot->SetReachable(true);
    }
    if (_process != nullptr)
    {
        _process->EndCrashes();
    }
    _mcs.BeginSettling();
    Watch();
}

void World::TurnDisk()
{
    _store.bFails = !_store.bFails;
    _trace.Add("disk {}", _store.bFails ? "fails" : "works");
    _behaviours.Start(
        EBehaviour::Disk,
        _store.bFails ? _faultChance.GetBetween(100ms, 15s) : _faultChance.GetBetween(1s, 60s),
        [this] { TurnDisk(); });
}

void World::TurnLink()
{
    const std::size_t kind = _faultChance.GetBelow(4);
    _network.SetSlow(kind == 1);
    _network.SetReachable(kind != 2);
    if (kind != 1)
    {
        _network.Cut();
    }
    _behaviours.Start(EBehaviour::Link, _faultChance.GetBetween(100ms, 30s), [this] { TurnLink(); });
}

/// The operator switches the TSC.
void World::Operate()
{
    if (_process != nullptr)
    {
        const bool bPause = _process->GetEngine().GetTscState() == Planning::ETscState::Auto;
        _trace.Add("operator: TSC {}", bPause ? "pause" : "resume");
        _process->PushCommand(Planning::ControlTSC{bPause, 0});
    }
    ResolveJobs();
    ClearRejections();
    _behaviours.Start(EBehaviour::Operator, _faultChance.GetBetween(1s, 60s), [this] { Operate(); });
}

void World::CrashSometime()
{
    if (_process != nullptr)
    {
        _process->Crash("at a random time");
    }
    _behaviours.Start(EBehaviour::Crash, _faultChance.GetBetween(1s, 120s), [this] { CrashSometime(); });
}

void World::TurnBroker()
{
    _broker.Restart();
    _behaviours.Start(EBehaviour::Broker, _faultChance.GetBetween(10s, 200s), [this] { TurnBroker(); });
}

void World::TurnRobot(const std::string& robotID)
{
    ISimulatedRobot& robot = *_robots.at(robotID);
    if (robot.IsDisturbed())
    {
        robot.Recover();
    }
    else if (_robotChance.IsHit(150))
    {
        robot.Forget();
    }
    else
    {
        robot.Disturb();
    }
    const Core::Duration span =
        robot.IsDisturbed() ? _robotChance.GetBetween(1s, 40s) : _robotChance.GetBetween(10s, 150s);
    _robotBehaviours.Start(robotID, span, [this, robotID] { TurnRobot(robotID); });
}

void World::TurnRadio(const std::string& robotID)
{
    ISimulatedRobot& robot = *_robots.at(robotID);
    robot.SetReachable(!robot.IsReachable());
    _trace.Add("{} is {}", robotID, robot.IsReachable() ? "reachable" : "unreachable");
    const Core::Duration span =
        robot.IsReachable() ? _robotChance.GetBetween(1s, 90s) : _robotChance.GetBetween(10ms, 30s);
    _radioBehaviours.Start(robotID, span, [this, robotID] { TurnRadio(robotID); });
}

/// The operator checks each unresolved job and resolves it.

} // namespace ACS::Simulation
