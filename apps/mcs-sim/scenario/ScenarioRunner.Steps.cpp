#include "scenario/ScenarioRunner.hpp"

#include "common/config/DurationText.hpp"
#include "console/CleanText.hpp"
#include "plans/TrackedPlan.hpp"
#include "wire/PayloadText.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <utility>

// What each kind of step does.
namespace ACS::McsSim
{

ScenarioRunner::EProgress ScenarioRunner::Do(const SendPlanStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    for (std::size_t i = 0; i < step.times; ++i)
    {
        PlannedPlan planned = step.plan;
        if (step.bFreshIDs)
        {
            _refresher.Refresh(planned);
        }
        else if (planned.transactionID.empty())
        {
            planned.transactionID = Core::MakeUUID(_random);
        }
        _names.insert_or_assign(step.name, planned);
        out.emplace_back(SendPlannedPlan{std::move(planned), step.bFreshIDs});
    }
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const SendAgainStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    PlannedPlan planned = std::get<PlannedPlan>(_names.at(step.name));
    planned.transactionID = step.bFreshTransaction ? Core::MakeUUID(_random) : planned.transactionID;
    out.emplace_back(SendPlannedPlan{std::move(planned), false});
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const SendRequestStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Core::Result<Protocol::AcsPayload> payload =
        ParsePayload(step.command, FillPlaceholders(step.payload, MakeReader()));
    if (!payload.has_value())
    {
        return Fail(Core::Describe(payload.error()));
    }
    Forget(_kept.size());
    out.emplace_back(SendPayload{std::move(*payload)});
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const SendTextStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    out.emplace_back(SendRawText{FillPlaceholders(step.text, MakeReader())});
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const ExpectStep& step, Core::Now now, ScenarioActions& /*out*/)
{
    const std::optional<std::size_t> found = FindMatchOrNull(step.pattern);
    if (found.has_value())
    {
        if (!step.name.empty())
        {
            _names.insert_or_assign(step.name, ReadFoundMessage(_kept[*found].text));
        }
        Forget(*found + 1);
        return EProgress::Done;
    }
    if (now.steady < _deadline)
    {
        return EProgress::Waiting;
    }
    const std::string limit = Apps::MakeDurationText(step.within);
    return Fail(
        _candidates == 0 ? fmt::format("no {} came within {}", step.pattern.command, limit)
                         : fmt::format(
                             "{} {} came within {}, none that matches; the last: {}",
                             _candidates,
                             step.pattern.command,
                             limit,
                             CleanText(_mismatch)));
}

ScenarioRunner::EProgress ScenarioRunner::Do(const ExpectNextStep& step, Core::Now now, ScenarioActions& /*out*/)
{
    std::optional<std::string> misfit = TakeNextOrNull(step);
    if (misfit.has_value())
    {
        return Fail(CleanText(*misfit));
    }
    if (_open.empty())
    {
        return EProgress::Done;
    }
    return now.steady < _deadline
        ? EProgress::Waiting
        : Fail(fmt::format("no {} came within {}", _open.front().command, Apps::MakeDurationText(step.within)));
}

ScenarioRunner::EProgress ScenarioRunner::Do(const ExpectNothingStep& step, Core::Now now, ScenarioActions& /*out*/)
{
    const std::optional<std::size_t> found = FindMatchOrNull(step.pattern);
    if (found.has_value())
    {
        return Fail("it came: " + CleanText(_kept[*found].text));
    }
    return now.steady < _deadline ? EProgress::Waiting : EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const WaitForPlanStep& step, Core::Now now, ScenarioActions& /*out*/)
{
    const auto found = _planStatus.find(std::get<PlannedPlan>(_names.at(step.name)).plan.planID);
    if (found != _planStatus.end() && found->second == step.status)
    {
        Forget(_kept.size());
        return EProgress::Done;
    }
    if (found != _planStatus.end() && IsFinal(found->second))
    {
        return Fail(fmt::format("the plan is {}", GetText(found->second)));
    }
    if (now.steady < _deadline)
    {
        return EProgress::Waiting;
    }
    return Fail(fmt::format(
        "after {} the plan is {}",
        Apps::MakeDurationText(step.within),
        found == _planStatus.end() ? "still not reported" : GetText(found->second)));
}

ScenarioRunner::EProgress ScenarioRunner::Do(const WaitStep& /*step*/, Core::Now now, ScenarioActions& /*out*/)
{
    return now.steady < _deadline ? EProgress::Waiting : EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const AskStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    out.emplace_back(PrintLine{"asked for: " + CleanText(step.text)});
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const DropStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    _bRegistered = false;
    out.emplace_back(step);
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(const HoldAcksStep& step, Core::Now /*now*/, ScenarioActions& out)
{
    Forget(_kept.size());
    out.emplace_back(step);
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Do(
    const RefuseRegistrationStep& step,
    Core::Now /*now*/,
    ScenarioActions& out)
{
    Forget(_kept.size());
    out.emplace_back(step);
    return EProgress::Done;
}

ScenarioRunner::EProgress ScenarioRunner::Fail(std::string reason)
{
    _failure = std::move(reason);
    return EProgress::Failed;
}

} // namespace ACS::McsSim
