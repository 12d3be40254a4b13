#include "OperatorSimulator.hpp"

#include <iterator>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

/// Once a second: by then a working disk has stored all that it was given, also what was delayed.
constexpr std::size_t POLLS_UNTIL_STORED = 15;

} // namespace

OperatorSimulator::OperatorSimulator(
    Timeline& timeline,
    Trace& trace,
    const ChanceSeed& seed,
    const Robots& robots,
    const CrashableStore& store,
    McsJudge& judge,
    ProcessSource getProcessOrNull)
    : _trace(trace),
      _chance(seed),
      _robots(robots),
      _store(store),
      _judge(judge),
      _getProcessOrNull(std::move(getProcessOrNull)),
      _behaviours(timeline)
{
}

void OperatorSimulator::Begin()
{
    _behaviours.Start(EBehaviour::Turn, _chance.GetBetween(1s, 60s), [this] { Turn(); });
    _behaviours.Start(EBehaviour::Poll, 1s, [this] { Poll(); });
}

void OperatorSimulator::BeginInterventions()
{
    _behaviours.Start(EBehaviour::Intervene, _chance.GetBetween(1s, 60s), [this] { Intervene(); });
    _behaviours.Start(EBehaviour::CheckBlocks, 200ms, [this] { CheckBlocks(); });
}

void OperatorSimulator::Intervene()
{
    if (AcsdProcess* const processOrNull = _getProcessOrNull(); processOrNull != nullptr)
    {
        ControlPlan(*processOrNull);
        ChangePriority(*processOrNull);
        ChangeBlocks(*processOrNull);
    }
    _behaviours.Start(EBehaviour::Intervene, _chance.GetBetween(1s, 30s), [this] { Intervene(); });
}

void OperatorSimulator::ControlPlan(AcsdProcess& process)
{
    using Planning::EPlanControl;
    const std::vector<Planning::PlanSummary> plans = process.GetEngine().GetActivePlans();
    if (plans.empty())
    {
        return;
    }
    const std::string& planID = plans[_chance.GetBelow(plans.size())].planID;
    const std::vector<EPlanControl> controls{
        EPlanControl::Pause,
        EPlanControl::Pause,
        EPlanControl::Resume,
        EPlanControl::Resume,
        EPlanControl::Resume,
        EPlanControl::Cancel,
        EPlanControl::Abort};
    const EPlanControl control = _chance.Pick(controls);
    _trace.Add("operator: {} of plan {}", GetText(control), planID);
    _judge.NoteControlledByOperator(planID);
    process.PushCommand(Planning::ControlPlan{control, planID, {}, 0, {}, Planning::EControlOrigin::Operator});
}

void OperatorSimulator::ChangePriority(AcsdProcess& process)
{
    const std::vector<Planning::PlanSummary> plans = process.GetEngine().GetActivePlans();
    if (!plans.empty())
    {
        const std::string& planID = plans[_chance.GetBelow(plans.size())].planID;
        const auto priority = static_cast<std::int32_t>(_chance.GetBelow(4));
        _trace.Add("operator: plan {} has the priority {}", planID, priority);
        process.PushCommand(Planning::SetPlanPriority{planID, priority, 0});
    }
}

void OperatorSimulator::ChangeBlocks(AcsdProcess& process)
{
    constexpr std::size_t MOST_BLOCKS = 3;
    const Planning::PlanEngine& engine = process.GetEngine();
    const std::vector<Planning::Block>& blocks = engine.GetBlocks();
    if (!blocks.empty() && (blocks.size() >= MOST_BLOCKS || _chance.IsHit(500)))
    {
        const Planning::Block& block = blocks[_chance.GetBelow(blocks.size())];
        _trace.Add("operator: {} {} is open", GetText(block.kind), block.id);
        process.PushCommand(Planning::UnblockPlace{block.kind, block.id, 0});
        return;
    }
    const Planning::SiteMap& site = engine.GetSite();
    Planning::BlockPlace command;
    command.kind = static_cast<Planning::EBlockKind>(_chance.GetBelow(3));
    command.id = site.GetNodes()[_chance.GetBelow(site.GetNodes().size())].nodeID;
    if (command.kind == Planning::EBlockKind::Edge)
    {
        command.id = site.GetEdges()[_chance.GetBelow(site.GetEdges().size())].edgeID;
    }
    else if (command.kind == Planning::EBlockKind::Station)
    {
        command.id = site.GetStations()[_chance.GetBelow(site.GetStations().size())].stationID;
    }
    _trace.Add("operator: {} {} is blocked", GetText(command.kind), command.id);
    process.PushCommand(command);
}

void OperatorSimulator::CheckBlocks()
{
    if (AcsdProcess* const processOrNull = _getProcessOrNull(); processOrNull != nullptr)
    {
        const Planning::PlanEngine& engine = processOrNull->GetEngine();
        std::map<std::string, std::set<std::string>> holders;
        for (const Planning::RobotRoute& route : engine.GetRobotRoutes())
        {
            for (const Planning::RouteNodeAhead& node : route.nodes)
            {
                if (node.bReserved)
                {
                    holders[node.nodeID].insert(route.robotID);
                }
            }
        }
        std::map<std::string, std::set<std::string>> granted;
        for (const Planning::Block& block : engine.GetBlocks())
        {
            if (block.kind != Planning::EBlockKind::Node)
            {
                continue;
            }
            const auto before = _granted.find(block.id);
            for (const std::string& robotID : holders[block.id])
            {
                if (before != _granted.end() && !before->second.contains(robotID))
                {
                    _trace.Violate("{} was granted node {}, which is blocked", robotID, block.id);
                }
            }
            granted.emplace(block.id, holders[block.id]);
        }
        _granted = std::move(granted);
    }
    _behaviours.Start(EBehaviour::CheckBlocks, 200ms, [this] { CheckBlocks(); });
}

void OperatorSimulator::RemoveBlocks() const
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    for (const Planning::Block& block :
         processOrNull == nullptr ? std::vector<Planning::Block>() : processOrNull->GetEngine().GetBlocks())
    {
        processOrNull->PushCommand(Planning::UnblockPlace{block.kind, block.id, 0});
    }
}

void OperatorSimulator::End()
{
    _behaviours.CancelAll();
}

void OperatorSimulator::OnStart()
{
    _resting.clear();
    _granted.clear();
    for (auto& [robotID, service] : _services)
    {
        if (std::exchange(service.polls, 0) >= POLLS_UNTIL_STORED)
        {
            _expected[robotID] = service.bInMaintenance;
        }
    }
}

/// Not for a disconnected robot: acsd would assume that it was carried away.
void OperatorSimulator::Turn()
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    if (processOrNull != nullptr)
    {
        const auto chosen = std::next(_robots.begin(), static_cast<std::ptrdiff_t>(_chance.GetBelow(_robots.size())));
        for (const Planning::RobotStatus& robot : processOrNull->GetEngine().GetRobotStatuses())
        {
            const bool bSeen = robot.status != Planning::ERobotStatus::Disconnected;
            if (robot.robotID == chosen->first && (robot.bInMaintenance || bSeen))
            {
                _trace.Add("operator: {} is {} service", robot.robotID, robot.bInMaintenance ? "in" : "out of");
                processOrNull->PushCommand(Planning::SetMaintenance{robot.robotID, !robot.bInMaintenance, 0});
                _expected.erase(robot.robotID);
                _services[robot.robotID].polls = 0;
            }
        }
    }
    _behaviours.Start(EBehaviour::Turn, _chance.GetBetween(1s, 40s), [this] { Turn(); });
}

void OperatorSimulator::Poll()
{
    AcsdProcess* const processOrNull = _getProcessOrNull();
    const std::vector<Planning::RobotStatus> statuses =
        processOrNull == nullptr ? std::vector<Planning::RobotStatus>() : processOrNull->GetEngine().GetRobotStatuses();
    for (const Planning::RobotStatus& robot : statuses)
    {
        CheckResting(robot);
        CheckService(robot);
    }
    _behaviours.Start(EBehaviour::Poll, 1s, [this] { Poll(); });
}

void OperatorSimulator::CheckResting(const Planning::RobotStatus& robot)
{
    const ISimulatedRobot& truth = *_robots.at(robot.robotID);
    const auto resting = _resting.find(robot.robotID);
    // Otherwise a drive may still be in transit to it.
    const bool bStands = robot.status == Planning::ERobotStatus::Stopped && truth.IsAtRest();
    if (!robot.bInMaintenance || truth.IsDisturbed())
    { // in manual mode it may be driven elsewhere
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

void OperatorSimulator::CheckService(const Planning::RobotStatus& robot)
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
    service = {robot.bInMaintenance, bSame ? service.polls + 1 : 0};
}

void OperatorSimulator::PutAllIntoService() const
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
