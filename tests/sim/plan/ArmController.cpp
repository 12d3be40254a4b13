#include "ArmController.hpp"

#include "ArmPrograms.hpp"
#include "openstream-sim/controller/ControllerMachine.hpp"
#include "openstream-sim/programs/PlaceTemplate.hpp"
#include "openstream-sim/programs/RelayName.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

constexpr std::string_view START_PATH = "/project/robot/start";
constexpr std::string_view STOP_PATH = "/project/robot/stop";
constexpr OpenStreamSim::RelayBlock COUNTER_BLOCK{OpenStreamSim::ERelayBus::None, 0, OpenStreamSim::ERelayArea::M};
constexpr std::chrono::milliseconds POLL_INTERVAL = 200ms;
/// No message is in transit for longer.
constexpr std::chrono::seconds LONGEST_WAY = 10s;

OpenStreamSim::PlaceTemplates MakeTemplates(const std::vector<std::string>& texts)
{
    OpenStreamSim::PlaceTemplates templates;
    for (const std::string& text : texts)
    {
        templates.push_back(*OpenStreamSim::PlaceTemplate::Parse(text));
    }
    return templates;
}

OpenStreamSim::ProgramWork MakeWork(const ArmProgramTexts& program)
{
    if (!program.openedSet.empty())
    {
        return OpenStreamSim::CoverWork{MakeTemplates({program.openedSet}), false};
    }
    return OpenStreamSim::TransferWork{MakeTemplates(program.from), MakeTemplates(program.to)};
}

OpenStreamSim::Fault MakeFault(OpenStreamSim::EFaultKind kind)
{
    OpenStreamSim::Fault fault;
    fault.kind = kind;
    fault.bOnce = kind == OpenStreamSim::EFaultKind::MotorOff || kind == OpenStreamSim::EFaultKind::Drop;
    return fault;
}

} // namespace

ArmController::Machine::Machine(
    const OpenStreamSim::ControllerOptions& options,
    OpenStreamSim::IFaultHost& host,
    Core::Now now)
    : controller(options, now, Core::Logger()),
      faults(controller, host, Core::Logger(), now),
      service(controller, faults, OpenStreamSim::EFaultSide::Stream)
{
}

ArmController::ArmController(
    const Dependencies& around,
    const Seeds& seeds,
    std::string robotID,
    bool bFaulty,
    std::function<bool()> isDriving)
    : _around(around),
      _chance(seeds.controller),
      _clientRandom({seeds.network.seed, seeds.network.part + 50}),
      _network(around.timeline, around.trace, seeds.network, std::nullopt),
      _robotID(std::move(robotID)),
      _bFaulty(bFaulty),
      _isDriving(std::move(isDriving)),
      _behaviours(around.timeline)
{
    _network.Listen(*this);
    SwitchOn();
}

ArmController::~ArmController() = default;

/// With an empty memory.
void ArmController::SwitchOn()
{
    OpenStreamSim::ControllerOptions options;
    for (const auto& [action, program] : GetArmPrograms())
    {
        OpenStreamSim::ProgramSpec spec;
        spec.duration = std::chrono::milliseconds(_chance.GetBetween(500, _chance.IsHit(200) ? 20'000 : 5'000));
        spec.echo = OpenStreamSim::ParseRelayNameOrNull(program.inputs.front().first);
        spec.work = MakeWork(program);
        options.programs[static_cast<int>(program.program)] = spec;
    }
    options.robotID = _robotID;
    options.world = &_around.workChecker.GetFloor();
    OpenStreamSim::IFaultHost& host = *this;
    _machine = std::make_unique<Machine>(options, host, _around.timeline.GetNow());
    _seen = {};
    _running.clear();
    _bHaltedByFault = false;
}

TextNetwork& ArmController::GetNetwork() noexcept
{
    return _network;
}

Core::IRandom& ArmController::GetClientRandom() noexcept
{
    return _clientRandom;
}

bool ArmController::Is(EMutation mutation) const noexcept
{
    return _around.mutation == mutation;
}

void ArmController::NoteStartSent(Protocol::ConnectionID connection, const std::string& commandID)
{
    _starts[connection].push_back(commandID);
    _lastStartAt = _around.timeline.GetNow().steady;
}

void ArmController::AddToTrace(const std::string& text) const
{
    _around.trace.Add("acsd receives: {} {}", _robotID, text);
}

std::string ArmController::TakeStart(Protocol::ConnectionID connection)
{
    std::deque<std::string>& starts = _starts[connection];
    if (starts.empty())
    {
        return {};
    }
    std::string commandID = std::move(starts.front());
    starts.pop_front();
    return commandID;
}

OpenStreamSim::ControllerMachine& ArmController::GetMachine()
{
    return _machine->controller.GetMachine(_around.timeline.GetNow());
}

ArmController::Counters ArmController::ReadCounters()
{
    const OpenStreamSim::RelayMemory& relays = GetMachine().GetRelays();
    return {
        relays.ReadS32(COUNTER_BLOCK, OpenStreamSim::STARTED_BYTE),
        relays.ReadS32(COUNTER_BLOCK, OpenStreamSim::FINISHED_BYTE),
        relays.ReadS32(COUNTER_BLOCK, OpenStreamSim::FAILED_BYTE)};
}

/// Reads the counters. A program that has begun since the last call has begun for this command.
void ArmController::Poll(const std::string& startedFor)
{
    const Counters before = std::exchange(_seen, ReadCounters());
    if (_seen.started != before.started)
    {
        _running = startedFor;
        _bHaltedByFault = false;
        const Planning::StartJob* const jobOrNull = _around.workChecker.FindCommandOrNull(_running);
        if (jobOrNull == nullptr)
        {
            _around.trace.Violate("the arm of {} starts a program without a job", _robotID);
            return;
        }
        CheckProgram(*jobOrNull);
        _around.workChecker.OnJobBegun(_robotID, *jobOrNull);
    }
    const Planning::StartJob* const jobOrNull = _around.workChecker.FindCommandOrNull(_running);
    if (_seen.finished != before.finished && jobOrNull != nullptr)
    {
        _around.workChecker.OnJobFinished(_robotID, *jobOrNull);
    }
    if (_seen.failed != before.failed)
    {
        _around.trace.Add("{} aborts its program", _robotID);
    }
    if (_seen.finished != before.finished || _seen.failed != before.failed)
    {
        _running.clear();
    }
    WatchProgram();
}

void ArmController::WatchProgram()
{
    if (!GetMachine().IsPlaying())
    {
        return;
    }
    if (_isDriving())
    {
        _around.trace.Violate("{} drives while its arm executes a job", _robotID);
    }
    _behaviours.Start(EBehaviour::Poll, POLL_INTERVAL, [this] { Poll({}); });
}

void ArmController::CheckProgram(const Planning::StartJob& job)
{
    const int program = GetMachine().GetProgram();
    if (program != static_cast<int>(GetArmPrograms().at(job.action).program))
    {
        _around.trace.Violate(
            "the arm of {} executes {} with program {}, the program of another action",
            _robotID,
            job.action,
            program);
    }
}

void ArmController::Call(
    Protocol::ConnectionID connection,
    const OpenStream::ApiRequest& request,
    OpenStream::ApiResponse& response)
{
    const bool bControl = request.method != OpenStream::EApiMethod::Get;
    const bool bStart = bControl && request.path == START_PATH;
    const std::string commandID = bStart ? TakeStart(connection) : std::string();
    Poll({});
    if (bControl && _bFaulty && _chance.IsHit(15))
    {
        Inject(MakeFault(OpenStreamSim::EFaultKind::Refuse));
    }
    if (bStart && _bFaulty && _chance.IsHit(30))
    {
        OpenStreamSim::Fault failure = MakeFault(OpenStreamSim::EFaultKind::ProgramFails);
        failure.bAtStart = _chance.IsHit(300);
        Inject(failure);
    }
    _machine->service.Call(request, _around.timeline.GetNow(), response);
    if (bControl && _bFaulty && _chance.IsHit(80))
    {
        response.delay += _chance.GetBetween(300ms, 1'500ms); // longer than acsd waits for the answer
    }
    if (bControl)
    {
        _around.trace.Add("{} answers {}: {}", _robotID, request.path, response.status);
        _bStopAsked = request.path == STOP_PATH || (_bStopAsked && !(bStart && response.IsSuccess()));
    }
    Poll(commandID);
}

void ArmController::Inject(const OpenStreamSim::Fault& fault)
{
    static_cast<void>(_machine->faults.TryAdd(fault, _around.timeline.GetNow()));
}

void ArmController::DropSessions()
{
    for (const auto& [id, connection] : _connections)
    {
        connection->Drop();
    }
    _behaviours.Post(0ms, [this] {
        std::erase_if(_connections, [](const auto& entry) { return entry.second->IsEnded(); });
    });
}

void ArmController::WakeAt(std::optional<Core::SteadyTime> timeOrNull)
{
    _behaviours.Cancel(EBehaviour::Wake);
    if (timeOrNull.has_value())
    {
        _behaviours.Start(EBehaviour::Wake, *timeOrNull - _around.timeline.GetNow().steady, [this] {
            _machine->faults.Advance(_around.timeline.GetNow());
        });
    }
}

void ArmController::OnOpened(Protocol::ConnectionID connection)
{
    ArmConnection::Handlers handlers{
        [this, connection](const OpenStream::ApiRequest& request, OpenStream::ApiResponse& response) {
            Call(connection, request, response);
        },
        [this] { _machine->service.StopControl(_around.timeline.GetNow()); },
        [this, connection] {
            return std::ranges::any_of(_connections, [connection](const auto& entry) {
                return entry.first != connection && entry.second->HasControl();
            });
        },
        [this, connection] {
            _behaviours.Post(0ms, [this, connection] { _connections.erase(connection); });
        }};
    const auto [made, bNew] = _connections.emplace(
        connection,
        std::make_unique<ArmConnection>(_around.timeline, _network, connection, std::move(handlers)));
    made->second->Start();
}

void ArmController::OnText(Protocol::ConnectionID connection, const std::string& text)
{
    // The outcome of a START is unknown: it is neither failed nor sent again.
    const bool bControl = text.find("\"CONTROL\"") != std::string::npos;
    const std::size_t chance = text.find(START_PATH) != std::string::npos ? 150 : 50;
    const bool bCut = bControl && _around.bBadRadio && !_bCalm && _chance.IsHit(chance);
    if (bCut)
    {
        _network.Cut();
    }
    if (bCut && _chance.IsHit(500))
    {
        if (text.find(START_PATH) != std::string::npos && _chance.IsHit(300))
        {
            RunByHand();
        }
        return; // lost; otherwise its answer continues
    }
    if (const auto found = _connections.find(connection); found != _connections.end())
    {
        _around.trace.Add("acsd -> arm of {} {}", _robotID, std::string_view(text).substr(0, text.find('\n')));
        found->second->OnText(text);
    }
}

void ArmController::OnClosed(Protocol::ConnectionID connection, const std::string& /*reason*/)
{
    if (const auto found = _connections.find(connection); found != _connections.end())
    {
        found->second->OnPeerClosed();
    }
}

void ArmController::SetReachable(bool bReachable)
{
    _bReachable = bReachable;
    _network.SetSlow(_chance.IsHit(300) && !_bCalm);
    UpdateNetwork();
}

void ArmController::UpdateNetwork()
{
    _network.SetReachable(_bReachable && _bPowered);
    if (!_bReachable || !_bPowered)
    {
        _network.Cut();
    }
}

void ArmController::Disturb()
{
    using OpenStreamSim::EFaultKind;
    constexpr std::array KINDS{
        EFaultKind::Silence,
        EFaultKind::Drop,
        EFaultKind::Slow,
        EFaultKind::Mode,
        EFaultKind::EmergencyStop,
        EFaultKind::ProtectiveStop,
        EFaultKind::MotorOff};
    OpenStreamSim::Fault fault = MakeFault(KINDS.at(_chance.GetBelow(KINDS.size())));
    fault.time = _chance.GetBetween(50ms, 1'500ms);
    fault.silence = fault.kind == EFaultKind::Mode ? _chance.GetBetween(0ms, 3s) : Core::Duration::zero();
    _around.trace.Add("the arm of {} has a fault: {}", _robotID, static_cast<int>(fault.kind));
    Poll({});
    const bool bPlayed = GetMachine().IsPlaying();
    Inject(fault);
    _bHaltedByFault = _bHaltedByFault || (bPlayed && !GetMachine().IsPlaying());
}

void ArmController::Recover()
{
    _around.trace.Add("the arm of {} has recovered", _robotID);
    static_cast<void>(_machine->faults.End(std::nullopt, _around.timeline.GetNow()));
    SetRight();
}

/// At the panel the motor is switched on, and a halted program is continued or aborted.
void ArmController::SetRight()
{
    static_cast<void>(GetMachine().SwitchMotorOn());
    _behaviours.Start(EBehaviour::Hand, 1500ms, [this] {
        Poll({});
        OpenStreamSim::ControllerMachine& machine = GetMachine();
        if (!std::exchange(_bHaltedByFault, false) || _running.empty() || _bStopAsked || machine.IsPlaying())
        {
            return;
        }
        const bool bGoesOn = _chance.IsHit(700);
        _around.trace.Add("the program of {} is {} by hand", _robotID, bGoesOn ? "continued" : "aborted");
        if (!bGoesOn || machine.StartProgram() != OpenStreamSim::EApiError::None)
        {
            machine.ResetTasks();
        }
        Poll({});
    });
}

/// At the panel a program of the site is run, which moves nothing and has its own number.
void ArmController::RunByHand()
{
    constexpr std::uint32_t OWN_NUMBER = 0;
    Poll({});
    if (GetMachine().IsPlaying() || !_running.empty())
    {
        return;
    }
    _around.trace.Add("the arm of {} runs a program by hand", _robotID);
    OpenStreamSim::RelayMemory& relays = GetMachine().GetRelays();
    relays.WriteU32(COUNTER_BLOCK, OpenStreamSim::ECHO_BYTE, OWN_NUMBER);
    relays.WriteU32(COUNTER_BLOCK, OpenStreamSim::STARTED_BYTE, static_cast<std::uint32_t>(_seen.started) + 1U);
    relays.WriteU32(COUNTER_BLOCK, OpenStreamSim::FINISHED_BYTE, static_cast<std::uint32_t>(_seen.finished) + 1U);
    _seen = ReadCounters();
}

void ArmController::Restart()
{
    Poll({});
    const bool bForgets = _chance.IsHit(500);
    _around.trace.Add("the arm of {} loses its power{}", _robotID, bForgets ? " and its memory" : "");
    _bPowered = false;
    DropSessions();
    UpdateNetwork();
    if (bForgets)
    {
        _behaviours.Cancel(EBehaviour::Wake);
        SwitchOn();
    }
    else
    {
        _bHaltedByFault = _bHaltedByFault || GetMachine().IsPlaying();
        GetMachine().SwitchMotorOff();
    }
    _behaviours.Start(EBehaviour::Power, _chance.GetBetween(1s, 8s), [this] {
        _bPowered = true;
        UpdateNetwork();
        SetRight();
    });
}

void ArmController::Calm()
{
    _bFaulty = false;
    _bCalm = true;
    _network.SetSlow(false);
    static_cast<void>(_machine->faults.End(std::nullopt, _around.timeline.GetNow()));
    SetRight();
}

bool ArmController::IsPlaying()
{
    return GetMachine().IsPlaying();
}

bool ArmController::IsWorkUnderWay()
{
    Poll({});
    const bool bMayCome = _around.timeline.GetNow().steady - _lastStartAt < LONGEST_WAY;
    return GetMachine().IsPlaying() || _bHaltedByFault || bMayCome;
}

} // namespace ACS::Simulation
