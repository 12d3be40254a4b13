#include "controller/ControllerMachine.hpp"

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

using FloatingDuration = std::chrono::duration<double, Core::Duration::period>;

constexpr int STEPS = 10;
constexpr std::string_view WAITING_STATEMENT = "wait di1";

} // namespace

ControllerMachine::ControllerMachine(const ControllerOptions& options, Core::Now now, Core::Logger logger)
    : _logger(std::move(logger)),
      _version(options.version),
      _robotModel(options.robotModel),
      _timeScale(options.timeScale),
      _startedAt(now.steady),
      _motor(options.motorOnTime, options.bMotorOn || options.bWaiting),
      _runner(options.programs, options.otherPrograms),
      _floorWork(options.world, options.robotID)
{
    Tool gripper;
    gripper.x = 120.0;
    gripper.z = 80.0;
    gripper.mass = 4.5;
    _settings.tools[0] = Tool{};
    _settings.tools[1] = gripper;
    if (options.bWaiting && _console.TryAdd(WAITING_STATEMENT))
    {
        _console.Start();
    }
}

void ControllerMachine::Advance(Core::Now now)
{
    const FloatingDuration real = now.steady - _startedAt;
    const Core::Duration before = _now;
    _now = std::chrono::duration_cast<Core::Duration>(real * _timeScale);
    _motor.Advance(_now);
    _console.Advance(before, _now, _arm, _relays);
    if (!_arm.TryAdvance(_now))
    {
        RaiseAlarm(EAlarm::AxisTooFast);
    }
    ProgramEvents events;
    _runner.Advance(_now, events);
    HandleEvents(std::move(events), _runner.GetDuration());
}

std::optional<Core::SteadyTime> ControllerMachine::GetNextTimeOrNull() const
{
    const std::optional<Core::Duration> end = _runner.GetEndOrNull();
    if (!end.has_value())
    {
        return std::nullopt;
    }
    // Rounded up, so that the program has ended at that time.
    return _startedAt + std::chrono::ceil<Core::Duration>(FloatingDuration(*end) / _timeScale);
}

void ControllerMachine::HandleEvents(ProgramEvents events, Core::Duration elapsed)
{
    for (ProgramEvent& event : events)
    {
        const std::string number = fmt::to_string(event.number);
        if (event.kind == EProgramEvent::Finished)
        {
            FinishWork(event);
        }
        switch (event.kind)
        {
            case EProgramEvent::Started:
                _logger.Info("program started", {{"program", number}});
                _arm.BeginProgram(_runner.GetDuration(), _now);
                BeginWork();
                Count(STARTED_BYTE);
                break;
            case EProgramEvent::Finished:
                _logger.Info("program finished", {{"program", number}});
                _arm.EndProgram(elapsed);
                Count(FINISHED_BYTE);
                _relays.WriteU32(PROGRAM_BLOCK, LAST_BYTE, static_cast<std::uint32_t>(event.number));
                break;
            case EProgramEvent::Failed:
                _logger.Warning("program failed", {{"program", number}});
                _arm.EndProgram(elapsed);
                Count(FAILED_BYTE);
                _relays.WriteU32(PROGRAM_BLOCK, LAST_BYTE, static_cast<std::uint32_t>(event.number));
                break;
            default:
                break;
        }
    }
}

void ControllerMachine::BeginWork()
{
    const ProgramSpec& spec = _runner.GetSpec();
    if (spec.echo.has_value())
    {
        const auto number = static_cast<std::int64_t>(_relays.Read(*spec.echo));
        _relays.WriteU32(PROGRAM_BLOCK, ECHO_BYTE, static_cast<std::uint32_t>(number));
    }
    _floorWork.Plan(spec.work, _relays);
}

void ControllerMachine::FinishWork(ProgramEvent& event)
{
    if (_shouldFail && _shouldFail(event.number, false))
    {
        event.kind = EProgramEvent::Failed;
        return;
    }
    const Core::Result<void> done = _floorWork.Finish();
    if (!done.has_value())
    {
        event.kind = EProgramEvent::Failed;
        _logger.Warning(
            "program could not do its work",
            {{"program", fmt::to_string(event.number)}, {"reason", Core::Describe(done.error())}});
    }
}

void ControllerMachine::Count(std::size_t byte)
{
    const auto counter = static_cast<std::uint32_t>(_relays.ReadS32(PROGRAM_BLOCK, byte));
    _relays.WriteU32(PROGRAM_BLOCK, byte, counter + 1);
}

void ControllerMachine::AbandonProgram()
{
    const Core::Duration elapsed = _runner.GetElapsed(_now);
    ProgramEvents events;
    _runner.Reset(events);
    HandleEvents(std::move(events), elapsed);
}

void ControllerMachine::RaiseAlarm(EAlarm alarm)
{
    _alarm = alarm;
    _logger.Warning("alarm", {{"number", fmt::to_string(static_cast<std::int32_t>(alarm))}});
}

ProgramProgress ControllerMachine::GetProgress() const
{
    return ProgramProgress{_runner.GetElapsed(_now), _runner.IsRunning()};
}

EApiError ControllerMachine::CheckMotion() const
{
    if (!_bRemote)
    {
        return EApiError::NotRemote;
    }
    return _motor.GetState() == EMotorState::On ? EApiError::None : EApiError::MotorOff;
}

EApiError ControllerMachine::SwitchMotorOn()
{
    if (!_bRemote)
    {
        return EApiError::NotRemote;
    }
    if (IsEmergencyStop())
    {
        return EApiError::EmergencyStop;
    }
    if (_stops.bSafeguardOpen)
    {
        return EApiError::ProtectiveStop;
    }
    _motor.SwitchOn(_now);
    return EApiError::None;
}

void ControllerMachine::SwitchMotorOff()
{
    HaltProgram();
    _motor.SwitchOff();
}

EApiError ControllerMachine::StartProgram()
{
    const EApiError error = CheckMotion();
    if (error != EApiError::None)
    {
        return error;
    }
    if (IsPlaying() || _arm.IsMoving(_now))
    {
        return EApiError::Playing;
    }
    if (_console.IsHalted() || (_runner.GetSelected() == 0 && !_console.IsEmpty()))
    {
        return StartConsole();
    }
    if (_runner.GetSelected() == 0)
    {
        return EApiError::NoProgram;
    }
    _bCursorMoved = true;
    ProgramEvents events;
    _runner.Start(_now, events);
    const bool bBegins = !events.empty(); // Else it continues after a stop.
    HandleEvents(std::move(events), {});
    if (bBegins && _shouldFail && _shouldFail(_runner.GetSelected(), true))
    {
        ResetTasks();
    }
    return EApiError::None;
}

EApiError ControllerMachine::ExecuteMove(std::string_view statement)
{
    const EApiError error = CheckMotion();
    if (error != EApiError::None)
    {
        return error;
    }
    if (IsPlaying() || _arm.IsMoving(_now))
    {
        return EApiError::Playing;
    }
    const std::optional<MoveStatement> move = ParseMoveOrNull(statement);
    if (!move.has_value())
    {
        return EApiError::Language;
    }
    AbandonProgram();
    const JointVector from = _arm.GetStates(_now, GetProgress()).position;
    _arm.BeginMove(move->target, ComputeMoveSeconds(*move, from), _now);
    return EApiError::None;
}

EApiError ControllerMachine::StartConsole()
{
    const EApiError error = CheckMotion();
    if (error != EApiError::None)
    {
        return error;
    }
    if (IsPlaying() || _arm.IsMoving(_now))
    {
        return EApiError::Playing;
    }
    if (_console.IsEmpty())
    {
        return EApiError::NoProgram;
    }
    AbandonProgram();
    _bCursorMoved = true;
    _logger.Info("console program started");
    _console.Start();
    return EApiError::None;
}

EApiError ControllerMachine::AddStatement(std::string_view statement)
{
    return _console.TryAdd(statement) ? EApiError::None : EApiError::Language;
}

void ControllerMachine::ClearConsole()
{
    ResetTasks();
    _console.Clear();
}

void ControllerMachine::ExitConsole()
{
    if (_console.IsRunning())
    {
        _arm.Stop(_now);
    }
    _console.Clear();
}

EApiError ControllerMachine::SelectProgram(int number)
{
    if (IsPlaying())
    {
        return EApiError::Playing;
    }
    if (_bCursorMoved)
    {
        return EApiError::BadCounter;
    }
    _console.Reset();
    const Core::Duration elapsed = _runner.GetElapsed(_now);
    ProgramEvents events;
    _runner.Select(number, events);
    HandleEvents(std::move(events), elapsed);
    return EApiError::None;
}

EApiError ControllerMachine::CheckSelection(bool bExternal) const
{
    if (bExternal != _bRemote)
    {
        return _bRemote ? EApiError::RemoteSelection : EApiError::LocalSelection;
    }
    return IsPlaying() ? EApiError::Playing : EApiError::None;
}

EApiError ControllerMachine::SetCursor(int index)
{
    if (IsPlaying())
    {
        return EApiError::TaskPlaying;
    }
    constexpr int BEGINNING = 1;
    if (index == BEGINNING)
    {
        _bCursorMoved = false;
    }
    return EApiError::None;
}

EApiError ControllerMachine::ReleaseWait()
{
    return _console.TryReleaseWait() ? EApiError::None : EApiError::NotInWait;
}

void ControllerMachine::StopProgram()
{
    HaltProgram();
    _bCursorMoved = true;
}

void ControllerMachine::HaltProgram()
{
    if (_runner.IsRunning())
    {
        _logger.Info("program stopped", {{"program", fmt::to_string(_runner.GetSelected())}});
        _runner.Stop(_now);
    }
    _console.Stop();
    _arm.Stop(_now);
}

void ControllerMachine::ResetTasks()
{
    HaltProgram();
    AbandonProgram();
    _console.Reset();
}

void ControllerMachine::ClearSelection()
{
    ProgramEvents events;
    _runner.Select(0, events);
    HandleEvents(std::move(events), {});
}

void ControllerMachine::PressEmergencyStop(bool bPressed)
{
    _stops.bPressed = bPressed;
    if (bPressed)
    {
        SwitchMotorOff();
    }
}

void ControllerMachine::HoldEmergencyStop(bool bHeld)
{
    _stops.bHeldPressed = bHeld;
    if (bHeld)
    {
        SwitchMotorOff();
    }
}

void ControllerMachine::TurnModeSwitch(bool bRemote)
{
    _bRemote = bRemote;
    if (!bRemote)
    {
        HaltProgram();
    }
}

void ControllerMachine::HoldProtectiveStop(bool bHeld)
{
    _stops.bSafeguardOpen = bHeld;
    if (bHeld)
    {
        SwitchMotorOff();
    }
}

void ControllerMachine::SetProgramJudge(ProgramJudge shouldFail)
{
    _shouldFail = std::move(shouldFail);
}

void ControllerMachine::SetRelayJudge(RelayJudge storesWrongValue)
{
    _storesWrongValue = std::move(storesWrongValue);
}

Core::Result<void> ControllerMachine::WriteRelay(const RelayName& name, double value)
{
    Core::Result<void> written = _relays.Write(name, value);
    if (written.has_value() && _storesWrongValue && _storesWrongValue())
    {
        return _relays.Write(name, value > 0.0 ? value - 1.0 : 1.0);
    }
    return written;
}

RelayMemory& ControllerMachine::GetRelays() noexcept
{
    return _relays;
}

ControllerSettings& ControllerMachine::GetSettings() noexcept
{
    return _settings;
}

const ControllerVersion& ControllerMachine::GetVersion() const noexcept
{
    return _version;
}

const std::string& ControllerMachine::GetRobotModel() const noexcept
{
    return _robotModel;
}

bool ControllerMachine::IsRemote() const noexcept
{
    return _bRemote;
}

bool ControllerMachine::IsEmergencyStop() const noexcept
{
    return _stops.bPressed || _stops.bHeldPressed;
}

bool ControllerMachine::IsPlaying() const noexcept
{
    return _runner.IsRunning() || _console.IsRunning();
}

EMotorState ControllerMachine::GetMotorState() const noexcept
{
    return _motor.GetState();
}

int ControllerMachine::GetProgram() const noexcept
{
    return _runner.GetSelected();
}

int ControllerMachine::GetStep() const noexcept
{
    if (_runner.IsAtBeginning())
    {
        return 0;
    }
    return 1 + static_cast<int>(_runner.GetElapsed(_now) * (STEPS - 1) / _runner.GetDuration());
}

JointStates ControllerMachine::GetJointStates() const
{
    JointStates states = _arm.GetStates(_now, GetProgress());
    for (double& velocity : states.velocity)
    {
        velocity *= _timeScale;
    }
    return states;
}

} // namespace ACS::OpenStreamSim
