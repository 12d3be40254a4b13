#include "controller/ControllerFaults.hpp"

#include "api/ApiAnswers.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <string>
#include <utility>

namespace ACS::OpenStreamSim
{

ControllerFaults::ControllerFaults(VirtualController& controller, IFaultHost& host, Core::Logger logger, Core::Now now)
    : _controller(controller),
      _host(host),
      _logger(std::move(logger)),
      _silentUntil(now.steady),
      _now(now)
{
    ControllerMachine& machine = _controller.GetMachine(now);
    machine.SetProgramJudge([this](int number, bool bAtStart) { return ShouldFail(number, bAtStart); });
    machine.SetRelayJudge([this] { return ShouldStoreWrongValue(); });
}

bool ControllerFaults::TryAdd(const Fault& fault, Core::Now now)
{
    AdvanceAll(now);
    if (_board.CountFaults() >= FaultBoard::MAX_FAULTS)
    {
        return false;
    }
    _board.Add(fault, now.steady, _changes);
    Finish();
    return true;
}

std::size_t ControllerFaults::End(std::optional<EFaultKind> kindOrNull, Core::Now now)
{
    AdvanceAll(now);
    const std::size_t count = _board.End(kindOrNull, "ended by command", _changes);
    Finish();
    if (kindOrNull.value_or(EFaultKind::Mode) == EFaultKind::Mode)
    {
        _silentUntil = now.steady; // the silence after a turn of the mode switch ends too
    }
    return count;
}

void ControllerFaults::Advance(Core::Now now)
{
    // One after the other, each at its time: a stop that is over by now has halted the program nevertheless.
    for (auto next = _board.GetNextTimeOrNull(); next.has_value() && *next <= now.steady;
         next = _board.GetNextTimeOrNull())
    {
        const Core::Duration late = now.steady - std::max(*next, _now.steady);
        _now = Core::Now{now.steady - late, now.wall - std::chrono::duration_cast<Core::WallTime::duration>(late)};
        static_cast<void>(_controller.GetMachine(_now)); // A program that has ended by then is not affected.
        _board.OnTime(_now.steady, _changes);
        ApplyChanges();
    }
    _now = now;
    Finish();
}

void ControllerFaults::AdvanceAll(Core::Now now)
{
    Advance(now);
    static_cast<void>(_controller.GetMachine(now));
}

void ControllerFaults::OnTimer(Core::Now now)
{
    _wakeAt.reset();
    AdvanceAll(now);
    ScheduleWakeUp();
}

void ControllerFaults::Finish()
{
    ApplyChanges();
    ScheduleWakeUp();
}

void ControllerFaults::ScheduleWakeUp()
{
    std::optional<Core::SteadyTime> next = _board.GetNextTimeOrNull();
    const std::optional<Core::SteadyTime> programEnd = _controller.GetNextTimeOrNull();
    if (programEnd.has_value())
    {
        next = std::min(next.value_or(*programEnd), *programEnd);
    }
    if (next != _wakeAt)
    {
        _wakeAt = next;
        _host.WakeAt(next);
    }
}

void ControllerFaults::ApplyChanges()
{
    while (!_changes.empty())
    {
        for (const FaultChange& change : std::exchange(_changes, {}))
        {
            if (change.bBegun)
            {
                _logger.Info("fault begins", {{"fault", change.fault.text}});
            }
            else
            {
                _logger.Info("fault ended", {{"fault", change.fault.text}, {"reason", change.reason}});
            }
            Apply(change);
        }
    }
}

void ControllerFaults::Apply(const FaultChange& change)
{
    switch (change.fault.kind)
    {
        case EFaultKind::Drop:
            _host.DropSessions();
            break;
        case EFaultKind::Mode:
            TurnModeSwitch(change.fault);
            break;
        case EFaultKind::EmergencyStop:
            _controller.GetMachine(_now).HoldEmergencyStop(_board.IsActive(EFaultKind::EmergencyStop));
            break;
        case EFaultKind::ProtectiveStop:
            _controller.GetMachine(_now).HoldProtectiveStop(_board.IsActive(EFaultKind::ProtectiveStop));
            break;
        case EFaultKind::MotorOff:
            _controller.GetMachine(_now).SwitchMotorOff();
            break;
        case EFaultKind::Silence:
        case EFaultKind::Hole:
        case EFaultKind::Slow:
        case EFaultKind::Refuse:
        case EFaultKind::ProgramFails:
        case EFaultKind::WrongValue:
            break;
        default:
            assert(false && "unhandled EFaultKind");
            break;
    }
}

void ControllerFaults::TurnModeSwitch(const Fault& fault)
{
    ControllerMachine& machine = _controller.GetMachine(_now);
    const bool bRemote = !_board.IsActive(EFaultKind::Mode);
    if (machine.IsRemote() != bRemote)
    {
        machine.TurnModeSwitch(bRemote);
        _silentUntil = std::max(_silentUntil, _now.steady + fault.silence);
    }
}

/// Called within a call of the controller, when a program begins or is about to finish.
bool ControllerFaults::ShouldFail(int number, bool bAtStart)
{
    if (bAtStart)
    {
        _board.OnPlace(std::to_string(number), _now.steady, _changes);
        Finish();
    }
    const Fault* const fault = _board.FindOrNull(EFaultKind::ProgramFails, [bAtStart](const Fault& candidate) {
        return candidate.bAtStart == bAtStart;
    });
    if (fault == nullptr)
    {
        return false;
    }
    _board.Use(*fault, _changes);
    Finish();
    return true;
}

/// Called within a call of the controller, when a client writes a relay.
bool ControllerFaults::ShouldStoreWrongValue()
{
    const Fault* const fault = _board.FindOrNull(EFaultKind::WrongValue);
    if (fault == nullptr)
    {
        return false;
    }
    _board.Use(*fault, _changes);
    Finish();
    return true;
}

bool ControllerFaults::IsSilent() const
{
    return _board.IsActive(EFaultKind::Silence) || _board.IsActive(EFaultKind::Hole) || _now.steady < _silentUntil;
}

std::optional<OpenStream::ApiResponse> ControllerFaults::UseRefusalOrNull()
{
    const Fault* const fault = _board.FindOrNull(EFaultKind::Refuse);
    if (fault == nullptr)
    {
        return std::nullopt;
    }
    OpenStream::ApiResponse response = Succeed(ErrorAnswer{fault->code, "refused by an injected fault"});
    response.status = fault->status;
    _board.Use(*fault, _changes);
    Finish();
    return response;
}

Core::Duration ControllerFaults::GetDelay(EFaultSide side) const
{
    const Fault* const fault = _board.FindOrNull(EFaultKind::Slow, [side](const Fault& candidate) {
        return candidate.side == side || candidate.side == EFaultSide::Both;
    });
    return fault == nullptr ? Core::Duration::zero() : fault->time;
}

} // namespace ACS::OpenStreamSim
