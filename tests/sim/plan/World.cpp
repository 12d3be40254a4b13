#include "World.hpp"

#include "ArmRobot.hpp"
#include "mcs/ReportMapper.hpp"
#include "RadioRobot.hpp"
#include "VehicleRobot.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

constexpr std::chrono::seconds WATCH_INTERVAL{1};

/// The streams of the seed's random numbers.
constexpr std::uint64_t NETWORK_PART = 101;
constexpr std::uint64_t PROCESS_PART = 301;
constexpr std::uint64_t OWN_RANDOM_PART = 302;
constexpr std::uint64_t FAULT_PART = 303;
constexpr std::uint64_t ROBOT_PART = 304;
constexpr std::uint64_t BROKER_PART = 305;
constexpr std::uint64_t OPERATOR_PART = 306;
constexpr std::uint64_t LEASE_PART = 308;
constexpr std::uint64_t FIRST_ROBOT_PART = 400;
constexpr std::uint64_t FIRST_RADIO_PART = 500;
constexpr std::uint64_t FIRST_ARM_PART = 600;
constexpr std::uint64_t FIRST_ARM_NETWORK_PART = 700;
constexpr std::uint64_t FIRST_TROUBLE_PART = 800;

EHandling GetHandling(ERobotKind robots)
{
    return robots == ERobotKind::Vda5050 ? EHandling::Carriers : EHandling::Everything;
}

} // namespace

World::World(Scenario scenario, EMutation mutation, bool bPrinting, RecordingHandler onRecording)
    : _scenario(std::move(scenario)),
      _mutation(mutation),
      _trace(_timeline, bPrinting),
      _chance({_scenario.seed, PROCESS_PART}),
      _ownRandom({_scenario.seed, OWN_RANDOM_PART}),
      _faultChance({_scenario.seed, FAULT_PART}),
      _robotChance({_scenario.seed, ROBOT_PART}),
      _leaseChance({_scenario.seed, LEASE_PART}),
      _store(mutation != EMutation::EpochNotChecked),
      _site(_scenario.MakeSite()),
      _workChecker(_trace, _site, GetHandling(_scenario.robots)),
      _judge(_trace, _store, _workChecker),
      _network(_timeline, _trace, {_scenario.seed, NETWORK_PART}, TextNames{"acsd", "MCS"}),
      _mcs(_timeline, _trace, _network, _judge, _workChecker, _scenario),
      _broker(_timeline, _trace, {_scenario.seed, BROKER_PART}, _scenario.Has(EFault::Radio)),
      _behaviours(_timeline),
      _robotBehaviours(_timeline),
      _radioBehaviours(_timeline),
      _operator(
          _timeline,
          _trace,
          {_scenario.seed, OPERATOR_PART},
          _robots,
          _store,
          _judge,
          [this] { return _process.get(); }),
      _onRecording(std::move(onRecording))
{
}

std::vector<std::string> World::Run()
{
    _trace.Add(
        "seed {}: {}, {} robots, {} plans",
        _scenario.seed,
        _scenario.siteName,
        _scenario.options.robots.size(),
        _scenario.planCount);
    AddRobots();
    if (_scenario.bShared)
    {
        BeStandby();
    }
    else
    {
        StartAcsd(0, nullptr);
    }
    _mcs.Begin();
    BeginFaults();
    while (!_bDone && _trace.GetViolations().empty() && _timeline.TryStep())
    {
    }
    return _trace.GetViolations();
}

std::size_t World::GetStarts() const noexcept
{
    return _starts;
}

Core::Duration World::GetAge() const
{
    return _timeline.GetAge();
}

void World::AddRobots()
{
    std::uint64_t number = 0;
    for (const Planning::RobotOptions& options : _scenario.options.robots)
    {
        const std::string& robotID = options.robotID.GetText();
        const std::string nodeID = options.startNodeID.value_or(std::string());
        const ChanceSeed seed{_scenario.seed, FIRST_ROBOT_PART + number};
        const ChanceSeed radioSeed{_scenario.seed, FIRST_RADIO_PART + number};
        const bool bFaulty = _scenario.Has(EFault::Robots);
        const VehicleRobot::Dependencies around{
            _timeline,
            _trace,
            _workChecker,
            _broker,
            _site,
            _scenario.bBatteries,
            _mutation,
            _scenario.Has(EFault::Radio),
            options,
            _scenario.robots == ERobotKind::Arms};
        if (_scenario.robots == ERobotKind::Arms && options.type == Planning::ERobotType::CR)
        {
            const ArmController::Seeds armSeeds{
                {_scenario.seed, FIRST_ARM_PART + number},
                {_scenario.seed, FIRST_ARM_NETWORK_PART + number}};
            const ArmRobot::Seeds seeds{seed, armSeeds, {_scenario.seed, FIRST_TROUBLE_PART + number}};
            _robots.emplace(robotID, std::make_unique<ArmRobot>(around, seeds, robotID, nodeID, bFaulty));
        }
        else if (_scenario.HasVehicles())
        {
            _robots.emplace(robotID, std::make_unique<VehicleRobot>(around, seed, robotID, nodeID, bFaulty));
        }
        else
        {
            const RadioRobot::Seeds seeds{seed, radioSeed};
            _robots.emplace(
                robotID,
                std::make_unique<RadioRobot>(_timeline, _trace, _workChecker, seeds, robotID, nodeID, bFaulty));
        }
        ++number;
    }
}

void World::StartAcsd(std::uint64_t epoch, std::unique_ptr<SimulatedLease> leaseOrNull)
{
    ++_starts;
    _former = std::move(_process); // null, unless it ignores the end of its lease
    _operator.OnStart();
    BringIntoReach();
    const AcsdProcess::Dependencies around{
        _timeline,
        _trace,
        _chance,
        _ownRandom,
        _store,
        _network,
        _robots,
        _workChecker,
        _scenario,
        _mutation,
        _starts,
        epoch,
        _onRecording ? _onRecording(_starts) : Acsd::CoreRecorder::RecordHandler()};
    _process = std::make_unique<AcsdProcess>(
        around,
        std::move(leaseOrNull),
        [this, number = _starts] { OnCrash(number); },
        [this] { _judge.CheckKept(); });
    if (_bSettling)
    {
        _process->EndCrashes();
    }
    _process->Begin();
    _judge.CheckKept();
}

/// The position of a robot that drove while the disk failed is unknown until it reports.
void World::BringIntoReach()
{
    constexpr std::chrono::seconds UNTIL_TOLD = 40s;
    for (const auto& [robotID, robot] : _robots)
    {
        const std::vector<Planning::RobotWorkChanged>& works = _store.GetState().robotWorks;
        const auto work = std::ranges::find(works, robotID, &Planning::RobotWorkChanged::robotID);
        const bool bStored = work == works.end() || std::ranges::count(work->nodeIDs, robot->GetNodeID()) > 0;
        if (bStored || _bSettling || !_scenario.Has(EFault::Radio))
        {
            continue;
        }
        _trace.Add("{} is made reachable: its position is not stored", robotID);
        robot->SetReachable(true);
        _radioBehaviours.Start(robotID, UNTIL_TOLD, [this, robotID = robotID] { TurnRadio(robotID); });
    }
}

/// It is still on the stack: it is destroyed when the stack is empty.
void World::OnCrash(std::uint64_t number)
{
    if (_scenario.bShared) // the standby takes over
    {
        _behaviours.Post(0ms, [this, number] {
            for (std::unique_ptr<AcsdProcess>* const process : {&_process, &_former})
            {
                if (*process != nullptr && (*process)->GetNumber() == number)
                {
                    process->reset();
                }
            }
        });
        return;
    }
    _behaviours.Post(0ms, [this] { _process.reset(); });
    _behaviours.Start(EBehaviour::Restart, _faultChance.GetBetween(1ms, _faultChance.IsHit(300) ? 30s : 2s), [this] {
        StartAcsd(0, nullptr);
    });
}

/// There is always one standby, which becomes the leader when it has taken the lease.
void World::BeStandby()
{
    const SimulatedLease::Dependencies around{_timeline, _trace, _leaseChance, _store, _scenario};
    _standby = std::make_unique<SimulatedLease>(around, [this](std::uint64_t epoch) {
        StartAcsd(epoch, std::move(_standby));
        BeStandby();
    });
    _standby->Start();
}

void World::ResolveJobs()
{
    const std::vector<Planning::Alarm> alarms =
        _process == nullptr ? std::vector<Planning::Alarm>() : _process->GetEngine().GetActiveAlarms();
    for (const Planning::Alarm& alarm : alarms)
    {
        if (alarm.errorCode != "ACS-1008" || !alarm.planID.has_value() || _robots.at(alarm.robotID)->IsWorkUnderWay())
        {
            continue;
        }
        const std::string jobID = alarm.jobID.value_or(std::string());
        const WorkChecker::JobTruth truth = _workChecker.GetTruth(*alarm.planID, alarm.stepNo.value_or(0), jobID);
        const Planning::EJobResolution other = truth.begun == 0 && _faultChance.IsHit(700)
            ? Planning::EJobResolution::Again
            : Planning::EJobResolution::Failed;
        const Planning::EJobResolution answer = truth.finished > 0 ? Planning::EJobResolution::Done : other;
        _trace.Add("operator: job {} of {} {}", jobID, *alarm.planID, GetText(answer));
        if (answer == Planning::EJobResolution::Failed)
        {
            _judge.NoteFailedByOperator(*alarm.planID);
        }
        _process->PushCommand(Planning::ResolveJob{*alarm.planID, jobID, answer, 0});
    }
}

/// The operator has checked each robot that rejects its drives, and lets it try again.
void World::ClearRejections()
{
    const std::vector<Planning::Alarm> alarms =
        _process == nullptr ? std::vector<Planning::Alarm>() : _process->GetEngine().GetActiveAlarms();
    for (const Planning::Alarm& alarm : alarms)
    {
        if (alarm.errorCode == "ACS-1012")
        {
            _process->PushCommand(Planning::ClearAlarms{alarm.robotID, alarm.errorCode, {}, {}, 0});
        }
    }
}

/// Whether all work is finished; after the time limit, what is not.
void World::Watch()
{
    ResolveJobs();
    ClearRejections();
    if (_process != nullptr && _process->GetEngine().GetTscState() != Planning::ETscState::Auto)
    {
        _process->PushCommand(Planning::ControlTSC{false, 0});
    }
    _operator.PutAllIntoService();
    _operator.RemoveBlocks();
    RemoveCarriers();
    const std::string unrest = DescribeUnrest();
    if (unrest.empty())
    {
        _bDone = true;
        return;
    }
    if (_timeline.GetNow().steady >= _deadline)
    {
        _trace.Violate("not finished in time after the last fault: {}", unrest);
        return;
    }
    _behaviours.Start(EBehaviour::Watch, WATCH_INTERVAL, [this] { Watch(); });
}

/// A plan that did not complete may have left its carrier on a robot, and other robots wait for it: the operator
/// removes it.
void World::RemoveCarriers()
{
    if (_process == nullptr)
    {
        return;
    }
    const Planning::PlanEngine& engine = _process->GetEngine();
    const bool bAnyWaits = std::ranges::any_of(engine.GetActivePlans(), [](const Planning::PlanSummary& plan) {
        return plan.state == Planning::EPlanState::Pending;
    });
    for (const Planning::RobotStatus& robot : engine.GetRobotStatuses())
    {
        const std::vector<std::optional<std::string>> empty(robot.carrierIDs.size());
        const ISimulatedRobot& body = *_robots.at(robot.robotID);
        const bool bStill = body.IsAtRest() && !body.IsWorkUnderWay();
        if (bAnyWaits && bStill && !robot.planID.has_value() && robot.carrierIDs != empty)
        {
            _trace.Add("operator: removes the carriers from {}", robot.robotID);
            _process->PushCommand(Planning::SetCarriers{robot.robotID, empty, 0});
            _workChecker.GetFloor().RemoveCarriers(GetPorts(robot.robotID));
            _robots.at(robot.robotID)->OnFloorChanged();
        }
    }
}

std::vector<std::string> World::GetPorts(std::string_view robotID) const
{
    std::vector<std::string> ports;
    for (const Planning::RobotOptions& robot : _scenario.options.robots)
    {
        for (const Core::Location& port : robot.ports)
        {
            if (robot.robotID.GetText() == robotID)
            {
                ports.push_back(port.GetText());
            }
        }
    }
    return ports;
}

std::string World::DescribeUnrest() const
{
    if (_process == nullptr)
    {
        return "acsd is not running";
    }
    const Planning::PlanEngine& engine = _process->GetEngine();
    std::string text = _judge.DescribeOwed();
    if (!engine.GetBlocks().empty())
    {
        text += "blocks are set; ";
    }
    if (!_mcs.IsSettled())
    {
        text += "the MCS waits for Acks; ";
    }
    if (_judge.GetTscStateOrNull() != Protocol::ETscState::Auto)
    {
        text += "the TSC state known to the MCS is not Auto; ";
    }
    std::vector<Protocol::ErrorReport> alarms;
    for (const Planning::Alarm& alarm : engine.GetActiveAlarms())
    {
        alarms.push_back(Acsd::MakeErrorReport(alarm, true));
    }
    if (!std::ranges::is_permutation(alarms, _judge.GetAlarms()))
    {
        text += fmt::format("the MCS lists {} alarms, acsd {}; ", _judge.GetAlarms().size(), alarms.size());
    }
    for (const Planning::PlanSummary& plan : engine.GetActivePlans())
    {
        text += fmt::format("plan {} is {}; ", plan.planID, GetText(plan.state));
    }
    if (!engine.GetUnacknowledged().empty() || !_store.GetState().outbox.empty())
    {
        text += "the outbox is not empty; ";
    }
    for (const Planning::RobotStatus& status : engine.GetRobotStatuses())
    {
        const ISimulatedRobot& robot = *_robots.at(status.robotID);
        const auto seen = _judge.GetStatuses().find(status.robotID);
        if (status.status != Planning::ERobotStatus::Idle && status.status != Planning::ERobotStatus::Charging)
        {
            text += fmt::format("{} is {}; ", status.robotID, GetText(status.status));
        }
        if (!robot.IsAtRest())
        {
            text += fmt::format("{} is still moving or working; ", status.robotID);
        }
        if (seen == _judge.GetStatuses().end() || seen->second != Acsd::MakeStatusUpdate(status))
        {
            text += fmt::format("the status of {} known to the MCS is out of date; ", status.robotID);
        }
        const auto options = std::ranges::find_if(_scenario.options.robots, [&status](const auto& candidate) {
            return candidate.robotID.GetText() == status.robotID;
        });
        if (robot.GetNodeID() != options->startNodeID)
        {
            text += fmt::format("{} is on {}, not at its parking position; ", status.robotID, robot.GetNodeID());
        }
    }
    return text;
}

} // namespace ACS::Simulation
