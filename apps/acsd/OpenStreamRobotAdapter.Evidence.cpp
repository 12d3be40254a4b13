#include "OpenStreamRobotAdapter.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// Counters are raised, and wrap around: anything else is the work of a restart.
bool HasFallenBack(std::int64_t before, std::int64_t after)
{
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(after) - static_cast<std::uint32_t>(before)) < 0;
}

/// So often was the counter raised; it wraps around.
std::int64_t CountSteps(std::int64_t before, std::int64_t after)
{
    return static_cast<std::uint32_t>(after) - static_cast<std::uint32_t>(before);
}

/// For the controller to show what a CONTROL has done; then its silence counts.
constexpr std::chrono::milliseconds LOOK_LIMIT{2'000};
/// Looks in a row that showed nothing: then this controller shows it otherwise, and is not waited for.
constexpr std::size_t MOST_UNSHOWN = 3;
/// Of a program that begins; some count from 0.
constexpr std::int64_t FIRST_STEP = 1;

} // namespace

bool OpenStreamRobotAdapter::HasFallen(const Counters& before, const Counters& after)
{
    return HasFallenBack(before.started, after.started) || HasFallenBack(before.finished, after.finished)
        || HasFallenBack(before.failed, after.failed);
}

std::string OpenStreamRobotAdapter::MakeMark() const
{
    return _bCounted ? fmt::format("{} {} {}", _counters.started, _counters.finished, _counters.failed) : std::string();
}

/// The three numbers of MakeMark.
std::optional<OpenStreamRobotAdapter::Counters> OpenStreamRobotAdapter::ReadMarkOrNull(std::string_view mark)
{
    std::array<std::int64_t, 3> numbers{};
    const char* begin = mark.data();
    const char* const end = begin + mark.size();
    for (std::int64_t& number : numbers)
    {
        const auto [rest, error] = std::from_chars(begin, end, number);
        if (error != std::errc())
        {
            return std::nullopt;
        }
        begin = rest == end ? rest : rest + 1;
    }
    return begin == end ? std::optional(Counters{numbers[0], numbers[1], numbers[2]}) : std::nullopt;
}

/// Behind the CONTROL that has just settled. One whose effect the controller's general state shows is seen there first: a
/// controller may take its time for a CONTROL, and go on with the MONITOR meanwhile.
void OpenStreamRobotAdapter::LookAgain(AdapterActions& out)
{
    const bool bToShow =
        _phase == EJobPhase::Looking || _program == EProgram::Stopping || _program == EProgram::GoingOn;
    if (!bToShow || _bPlaybackHidden || _unshownLooks >= MOST_UNSHOWN)
    {
        LookAtCounters();
        return;
    }
    _look = ELook::Watched;
    _glance = EGlance::None;
    Monitor(GENERAL_URL, _options.period);
    out.emplace_back(Planning::StartAdapterTimer{LOOK_TIMER, LOOK_LIMIT});
}

void OpenStreamRobotAdapter::LookAtCounters()
{
    _look = ELook::Asked;
    WatchCounters();
}

/// Nothing was shown, but nothing was refused either.
void OpenStreamRobotAdapter::EndWatch()
{
    if (_look == ELook::Watched)
    {
        ++_unshownLooks;
        LookAtCounters();
    }
}

bool OpenStreamRobotAdapter::TryTakeEffect(const Core::JsonText& sample, AdapterActions& out)
{
    const std::optional<GeneralState> stateOrNull = ReadGeneralStateOrNull(sample);
    if (!stateOrNull.has_value())
    {
        return false;
    }
    if (IsEffectShown(*stateOrNull))
    {
        _unshownLooks = 0;
        out.emplace_back(Planning::CancelAdapterTimer{LOOK_TIMER});
        LookAtCounters();
    }
    return true;
}

bool OpenStreamRobotAdapter::IsEffectShown(const GeneralState& state) const
{
    if (_phase == EJobPhase::Looking)
    {
        return state.program == _armProgram && state.step.value_or(0) <= FIRST_STEP;
    }
    if (_phase == EJobPhase::Running && _program == EProgram::Stopping)
    {
        return !state.bPlaying;
    }
    if (_phase == EJobPhase::Running && _program == EProgram::GoingOn)
    {
        return state.bPlaying;
    }
    return true; // the job has ended meanwhile
}

void OpenStreamRobotAdapter::TakeLook(AdapterActions& out)
{
    if (_phase == EJobPhase::Looking && _counters != _counted)
    {
        // The selection has given up a program, or somebody has run one: no evidence could tell them apart.
        DisownJob(out);
    }
    else if (_phase == EJobPhase::Looking)
    {
        _phase = EJobPhase::Selected;
    }
    else if (_program == EProgram::Stopping)
    {
        _program = EProgram::Stopped;
    }
    else if (_program == EProgram::GoingOn)
    {
        _program = EProgram::Runs;
    }
    FollowPause(out);
}

void OpenStreamRobotAdapter::FindJob(AdapterActions& out)
{
    if (!_recovery.has_value() || _armState != EArmState::Ready)
    {
        return;
    }
    const Planning::StartJob job = *std::exchange(_recovery, std::nullopt);
    const std::optional<Counters> markOrNull = ReadMarkOrNull(job.mark);
    const auto tell = [&out, &job](const char* reason) {
        out.emplace_back(RaiseEvent{Planning::JobUncertain{job.jobID, reason}});
    };
    if (!markOrNull.has_value())
    {
        tell("the arm's counters of before the job are not known");
        return;
    }
    if (_counters == Counters{})
    {
        tell("all of the arm's counters are 0, as after a restart of its controller");
        return;
    }
    const std::int64_t begun = CountSteps(markOrNull->started, _counters.started);
    const std::int64_t ended =
        CountSteps(markOrNull->finished, _counters.finished) + CountSteps(markOrNull->failed, _counters.failed);
    if (HasFallen(*markOrNull, _counters) || begun > 1 || ended > begun)
    {
        tell("the arm's counters have fallen, or more than this one program has run");
        return;
    }
    _jobID = job.jobID;
    _bJobStarted = false;
    _counted = *markOrNull;
    _phase = EJobPhase::Running;
    if (begun == 0)
    {
        // It may be on its way still. Whoever has not raised its first counter by then was not started.
        _bRecovered = true;
        out.emplace_back(Planning::StartAdapterTimer{START_TIMER, START_LIMIT});
    }
    _bFound = begun != 0;
    DoubtFound();
    FollowJob(out);
    FollowPause(out);
}

/// A start that got lost on the way would leave the job running for ever.
void OpenStreamRobotAdapter::CheckStart(AdapterActions& out)
{
    if (!_bJobStarted && _phase == EJobPhase::Running && _armState == EArmState::Ready)
    {
        if (!_refusal.empty())
        {
            FailJob(_refusal, out);
            return;
        }
        if (std::exchange(_bRecovered, false))
        {
            DisownJob(out);
            return;
        }
        FailJob("the connection to the arm broke while its program was being started, and it did not begin", out);
    }
}

void OpenStreamRobotAdapter::FollowJob(AdapterActions& out)
{
    if (_phase != EJobPhase::Starting && _phase != EJobPhase::Running)
    {
        return;
    }
    const bool bBegins = _counters.started != _counted.started && !std::exchange(_bJobStarted, true);
    if (bBegins)
    {
        out.emplace_back(RaiseEvent{Planning::JobStarted{_jobID}});
    }
    if (_counters.failed != _counted.failed)
    {
        FailJob("the arm's program gave up", out);
    }
    else if (_counters.finished != _counted.finished)
    {
        EndJob(out);
        out.emplace_back(RaiseEvent{Planning::JobFinished{std::exchange(_jobID, {})}});
        TellPaused(out);
    }
    else if (bBegins)
    {
        FollowPause(out);
    }
}

} // namespace ACS::Acsd
