#include "scenario/ScenarioRunner.hpp"

#include "common/config/DurationText.hpp"
#include "console/CleanText.hpp"
#include "plans/TrackedPlan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

/// The command that a pattern must name for this message.
std::string GetCommandName(const Protocol::DecodeOutcome& outcome)
{
    if (!outcome.message.has_value())
    {
        return outcome.message.error().commandName;
    }
    if (const auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message))
    {
        return std::string(GetText(GetCommand(*requestOrNull)));
    }
    const auto& ack = std::get<Protocol::AcsAck>(*outcome.message);
    return ack.bLegacyName ? "RequestAcsStatusAck" : std::string(GetText(ack.command)) + "Ack";
}

const Protocol::PlanReport* FindPlanReportOrNull(const Protocol::DecodeOutcome& outcome)
{
    const auto* const requestOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsRequest>(&*outcome.message) : nullptr;
    return requestOrNull == nullptr ? nullptr : std::get_if<Protocol::PlanReport>(&requestOrNull->payload);
}

template <typename... TSteps>
bool IsOneOf(const ScenarioStep& step)
{
    return (std::holds_alternative<TSteps>(step.kind) || ...);
}

bool IsExpectation(const ScenarioStep& step)
{
    return IsOneOf<ExpectStep, ExpectNextStep, ExpectNothingStep, WaitForPlanStep>(step);
}

/// Whether the step waits until an ACS is registered.
bool IsForACS(const ScenarioStep& step)
{
    return IsOneOf<SendPlanStep, SendAgainStep, SendRequestStep, SendTextStep, AskStep, DropStep>(step);
}

const MessagePattern* FindPatternOrNull(const ScenarioStep& step)
{
    if (const auto* const expectOrNull = std::get_if<ExpectStep>(&step.kind))
    {
        return &expectOrNull->pattern;
    }
    const auto* const nothingOrNull = std::get_if<ExpectNothingStep>(&step.kind);
    return nothingOrNull == nullptr ? nullptr : &nothingOrNull->pattern;
}

/// Maximum duration of a step; 0: done at once, or waits for an ACS for the scenario's time.
std::chrono::milliseconds GetLimit(const ScenarioStep& step, std::chrono::milliseconds otherwise)
{
    if (const auto* const expectOrNull = std::get_if<ExpectStep>(&step.kind))
    {
        return expectOrNull->within;
    }
    if (const auto* const nextOrNull = std::get_if<ExpectNextStep>(&step.kind))
    {
        return nextOrNull->within;
    }
    if (const auto* const nothingOrNull = std::get_if<ExpectNothingStep>(&step.kind))
    {
        return nothingOrNull->duration;
    }
    if (const auto* const planOrNull = std::get_if<WaitForPlanStep>(&step.kind))
    {
        return planOrNull->within;
    }
    const auto* const waitOrNull = std::get_if<WaitStep>(&step.kind);
    return waitOrNull == nullptr ? otherwise : waitOrNull->duration;
}

} // namespace

ScenarioRunner::ScenarioRunner(Scenario scenario, PlanRefresher& refresher, Core::IRandom& random)
    : _scenario(std::move(scenario)),
      _refresher(refresher),
      _random(random)
{
    for (const ScenarioStep& step : _scenario.steps)
    {
        StepVerdict& verdict = _verdicts.emplace_back();
        verdict.number = _verdicts.size();
        verdict.title = step.title;
        verdict.bExpectation = IsExpectation(step);
    }
}

void ScenarioRunner::Start(bool bRegistered, Core::Now now, ScenarioActions& out)
{
    _bStarted = true;
    _bRegistered = bRegistered;
    out.emplace_back(PrintLine{"scenario " + CleanText(_scenario.name)});
    Advance(now, out);
}

void ScenarioRunner::OnRegistered(Core::Now now, ScenarioActions& out)
{
    _bRegistered = true;
    Advance(now, out);
}

void ScenarioRunner::OnLinkLost()
{
    _bRegistered = false;
}

void ScenarioRunner::OnMessage(std::string_view text, Core::Now now, ScenarioActions& out)
{
    if (IsFinished())
    {
        return;
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (const Protocol::PlanReport* const reportOrNull = FindPlanReportOrNull(outcome))
    {
        _planStatus[reportOrNull->planID] = reportOrNull->status;
    }
    std::string command = GetCommandName(outcome);
    const bool bRepeated = WasSeen(command, ReadFoundMessage(text));
    if (IsAskedFor(command))
    {
        if (_kept.size() == MAX_KEPT)
        {
            Forget(1);
        }
        _kept.push_back({std::move(command), std::string(text), bRepeated});
    }
    Advance(now, out);
}

void ScenarioRunner::OnTimer(Core::Now now, ScenarioActions& out)
{
    Advance(now, out);
}

void ScenarioRunner::OnSendFailed(Core::Now now, ScenarioActions& out)
{
    if (!IsFinished())
    {
        Leave(Fail("a message could not be sent: the link had just gone"), now, out);
    }
}

const std::string& ScenarioRunner::GetName() const noexcept
{
    return _scenario.name;
}

bool ScenarioRunner::IsFinished() const noexcept
{
    return _index >= _scenario.steps.size();
}

bool ScenarioRunner::IsRegistered() const noexcept
{
    return _bRegistered;
}

const std::vector<StepVerdict>& ScenarioRunner::GetVerdicts() const noexcept
{
    return _verdicts;
}

bool ScenarioRunner::HasHeld() const
{
    return std::all_of(_verdicts.begin(), _verdicts.end(), [](const StepVerdict& verdict) {
        return verdict.verdict == EVerdict::Held;
    });
}

void ScenarioRunner::Advance(Core::Now now, ScenarioActions& out)
{
    while (_bStarted && !IsFinished())
    {
        if (!_bEntered)
        {
            Enter(now, out);
        }
        const EProgress progress = Try(now, out);
        if (progress == EProgress::Waiting)
        {
            return;
        }
        Leave(progress, now, out);
    }
}

void ScenarioRunner::Enter(Core::Now now, ScenarioActions& out)
{
    const std::chrono::milliseconds limit = GetLimit(_scenario.steps[_index], _scenario.within);
    _bEntered = true;
    _entered = now.steady;
    _deadline = now.steady + limit;
    _scanned = 0;
    _candidates = 0;
    _mismatch.clear();
    const auto* const nextOrNull = std::get_if<ExpectNextStep>(&_scenario.steps[_index].kind);
    _open = nextOrNull == nullptr ? std::vector<MessagePattern>() : nextOrNull->patterns;
    out.emplace_back(StartScenarioTimer{limit});
}

void ScenarioRunner::Leave(EProgress progress, Core::Now now, ScenarioActions& out)
{
    StepVerdict& verdict = _verdicts[_index];
    verdict.verdict = progress == EProgress::Done ? EVerdict::Held : EVerdict::Failed;
    verdict.duration = std::chrono::duration_cast<std::chrono::milliseconds>(now.steady - _entered);
    verdict.reason = std::exchange(_failure, {});
    out.emplace_back(PrintLine{fmt::format(
        "step {} {}{}{}",
        verdict.number,
        verdict.title,
        verdict.bExpectation || progress == EProgress::Failed ? (progress == EProgress::Done ? ": held" : ": FAILED")
                                                              : "",
        verdict.reason.empty() ? "" : ": " + verdict.reason)});
    _bEntered = false;
    _index = progress == EProgress::Done ? _index + 1 : _scenario.steps.size();
}

ScenarioRunner::EProgress ScenarioRunner::Try(Core::Now now, ScenarioActions& out)
{
    const ScenarioStep& current = _scenario.steps[_index];
    if (IsForACS(current) && !_bRegistered)
    {
        return now.steady < _deadline
            ? EProgress::Waiting
            : Fail("no ACS has registered within " + Apps::MakeDurationText(_scenario.within));
    }
    return std::visit([this, now, &out](const auto& step) { return Do(step, now, out); }, current.kind);
}

std::optional<std::size_t> ScenarioRunner::FindMatchOrNull(const MessagePattern& pattern)
{
    for (; _scanned < _kept.size(); ++_scanned)
    {
        const KeptMessage& message = _kept[_scanned];
        if (!MatchesGlob(message.command, pattern.command))
        {
            continue;
        }
        std::optional<std::string> mismatch = FindMismatchOfOrNull(message, pattern);
        if (!mismatch.has_value())
        {
            return _scanned;
        }
        ++_candidates;
        _mismatch = std::move(*mismatch);
    }
    return std::nullopt;
}

std::optional<std::string> ScenarioRunner::TakeNextOrNull(const ExpectNextStep& step)
{
    while (!_open.empty() && !_kept.empty())
    {
        const KeptMessage& message = _kept.front();
        std::string mismatch;
        const auto fits = [this, &message, &mismatch](const MessagePattern& pattern) {
            mismatch = MatchesGlob(message.command, pattern.command)
                ? FindMismatchOfOrNull(message, pattern).value_or("")
                : fmt::format("{} came before {}: {}", message.command, pattern.command, CleanText(message.text));
            return mismatch.empty();
        };
        const auto found = std::find_if(_open.begin(), _open.end(), fits);
        if (found != _open.end())
        {
            _open.erase(found);
        }
        else if (!MatchesGlob(message.command, step.besides))
        {
            return mismatch;
        }
        Forget(1);
    }
    return std::nullopt;
}

std::optional<std::string> ScenarioRunner::FindMismatchOfOrNull(
    const KeptMessage& message,
    const MessagePattern& pattern) const
{
    if (pattern.bRepeated && !message.bRepeated)
    {
        return "its transactionId is new";
    }
    return FindMismatchOrNull(message.text, pattern, MakeReader());
}

bool ScenarioRunner::IsAskedFor(const std::string& command) const
{
    return std::any_of(_scenario.steps.begin(), _scenario.steps.end(), [&command](const ScenarioStep& step) {
        // Whatever comes may be what must not come in between.
        const MessagePattern* const patternOrNull = FindPatternOrNull(step);
        return std::holds_alternative<ExpectNextStep>(step.kind)
            || (patternOrNull != nullptr && MatchesGlob(command, patternOrNull->command));
    });
}

bool ScenarioRunner::WasSeen(const std::string& command, const FoundMessage& envelope)
{
    std::string key = command + ' ' + envelope.transactionID;
    if (_transactions.contains(key))
    {
        return true;
    }
    if (_transactions.size() < MAX_TRANSACTIONS && !envelope.transactionID.empty())
    {
        _transactions.insert(std::move(key));
    }
    return false;
}

void ScenarioRunner::Forget(std::size_t count)
{
    _kept.erase(_kept.begin(), _kept.begin() + static_cast<std::ptrdiff_t>(count));
    _scanned -= std::min(_scanned, count);
}

PlaceholderReader ScenarioRunner::MakeReader() const
{
    return [this](std::string_view name) {
        return ReadPlaceholderOrNull(_names, name);
    };
}

} // namespace ACS::McsSim
