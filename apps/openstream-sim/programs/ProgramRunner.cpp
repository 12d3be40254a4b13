#include "programs/ProgramRunner.hpp"

#include <cassert>
#include <utility>

namespace ACS::OpenStreamSim
{

ProgramRunner::ProgramRunner(std::map<int, ProgramSpec> programs, ProgramSpec otherPrograms)
    : _programs(std::move(programs)),
      _otherPrograms(std::move(otherPrograms))
{
}

void ProgramRunner::Abandon(ProgramEvents& out)
{
    if (_phase != EPhase::AtBeginning)
    {
        out.push_back(ProgramEvent{EProgramEvent::Failed, _selected});
    }
    _phase = EPhase::AtBeginning;
    _elapsed = {};
}

void ProgramRunner::Select(int number, ProgramEvents& out)
{
    assert(_phase != EPhase::Running);
    Abandon(out);
    _selected = number;
    const auto found = _programs.find(number);
    _spec = found == _programs.end() ? _otherPrograms : found->second;
}

void ProgramRunner::Start(Core::Duration now, ProgramEvents& out)
{
    assert(_phase != EPhase::Running && _selected != 0);
    if (_phase == EPhase::AtBeginning)
    {
        out.push_back(ProgramEvent{EProgramEvent::Started, _selected});
    }
    _phase = EPhase::Running;
    _resumedAt = now;
}

void ProgramRunner::Stop(Core::Duration now)
{
    if (_phase == EPhase::Running)
    {
        _elapsed = GetElapsed(now);
        _phase = EPhase::Halted;
    }
}

void ProgramRunner::Reset(ProgramEvents& out)
{
    Abandon(out);
}

void ProgramRunner::Advance(Core::Duration now, ProgramEvents& out)
{
    if (_phase != EPhase::Running || GetElapsed(now) < GetDuration())
    {
        return;
    }
    out.push_back(ProgramEvent{_spec.bFails ? EProgramEvent::Failed : EProgramEvent::Finished, _selected});
    _phase = EPhase::AtBeginning;
    _elapsed = {};
}

bool ProgramRunner::IsRunning() const noexcept
{
    return _phase == EPhase::Running;
}

bool ProgramRunner::IsAtBeginning() const noexcept
{
    return _phase == EPhase::AtBeginning;
}

int ProgramRunner::GetSelected() const noexcept
{
    return _selected;
}

const ProgramSpec& ProgramRunner::GetSpec() const noexcept
{
    return _spec;
}

std::optional<Core::Duration> ProgramRunner::GetEndOrNull() const noexcept
{
    return _phase == EPhase::Running ? std::optional(_resumedAt + GetDuration() - _elapsed) : std::nullopt;
}

Core::Duration ProgramRunner::GetElapsed(Core::Duration now) const noexcept
{
    return _phase == EPhase::Running ? _elapsed + (now - _resumedAt) : _elapsed;
}

Core::Duration ProgramRunner::GetDuration() const noexcept
{
    return _spec.duration;
}

} // namespace ACS::OpenStreamSim
