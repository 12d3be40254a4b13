#include "judge/PlanChecks.hpp"

#include <acs/core/ESegmentKind.hpp>
#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string_view>

namespace ACS::AcsSim
{

namespace
{

using Core::ESegmentKind;

enum class ESide : std::uint8_t
{
    Any,
    Fixed,
    Robot,
};

/// What a job of an action moves, and between which sides; an action without places has none.
struct ActionRule
{
    std::string_view name;
    bool bPlaces = true;
    ESegmentKind kind = ESegmentKind::CassettePort;
    ESide from = ESide::Any;
    ESide to = ESide::Any;
};

constexpr std::array<ActionRule, 8> ACTIONS{{
    {"CassetteLoad", true, ESegmentKind::CassettePort, ESide::Fixed, ESide::Robot},
    {"CassetteUnload", true, ESegmentKind::CassettePort, ESide::Robot, ESide::Fixed},
    {"TrayLoad", true, ESegmentKind::TrayPort, ESide::Fixed, ESide::Robot},
    {"TrayUnload", true, ESegmentKind::TrayPort, ESide::Robot, ESide::Fixed},
    {"MemoryPickAndPlace", true, ESegmentKind::MemoryPort, ESide::Any, ESide::Any},
    {"OpenSetCover", false},
    {"CloseSetCover", false},
    {"Start", false},
}};

class PlanChecker
{
    const Protocol::ExecutionPlan& _plan;
    std::vector<PlanFinding> _findings;

public:
    explicit PlanChecker(const Protocol::ExecutionPlan& plan)
        : _plan(plan)
    {
    }

    [[nodiscard]] std::vector<PlanFinding> Check()
    {
        std::set<std::int32_t> numbers;
        std::set<std::string_view> jobs;
        for (const Protocol::PlanStep& step : _plan.steps)
        {
            if (step.stepNo < 1 || !numbers.insert(step.stepNo).second)
            {
                Add(ERule::PlanSteps, step, "the stepNo is less than 1 or used twice");
            }
            for (const Protocol::PlanJob& job : step.jobs)
            {
                if (!jobs.insert(job.jobID).second)
                {
                    Add(ERule::PlanSteps, step, "the jobId " + Core::QuoteForError(job.jobID) + " is used twice");
                }
            }
            CheckStep(step);
        }
        if (!numbers.empty() && *numbers.begin() > 1)
        {
            Add(ERule::PlanSteps, _plan.steps.front(), "there is no step 1");
        }
        return std::move(_findings);
    }

private:
    void Add(ERule rule, const Protocol::PlanStep& step, const std::string& text)
    {
        _findings.push_back(
            {rule, fmt::format("plan {}, step {}: {}", Core::QuoteForError(_plan.planID), step.stepNo, text)});
    }

    void CheckStep(const Protocol::PlanStep& step)
    {
        CheckSpelling(step, step.position);
        const auto* const found = std::ranges::find(ACTIONS, step.action, &ActionRule::name);
        if (found == ACTIONS.end())
        {
            Add(ERule::PlanAction, step, "unknown action " + Core::QuoteForError(step.action));
            return;
        }
        if (found->kind == ESegmentKind::MemoryPort && !step.carrierIDs.empty())
        {
            Add(ERule::PlanCarriers, step, "MemoryPickAndPlace with carrierIds");
        }
        if (!found->bPlaces)
        {
            return;
        }
        if (step.jobs.empty())
        {
            Add(ERule::PlanAction, step, step.action + " without jobs");
        }
        for (const Protocol::PlanJob& job : step.jobs)
        {
            CheckPlace(step, *found, "from", job.from, found->from);
            CheckPlace(step, *found, "to", job.to, found->to);
        }
    }

    void CheckPlace(
        const Protocol::PlanStep& step,
        const ActionRule& action,
        std::string_view member,
        const std::string& text,
        ESide side)
    {
        CheckSpelling(step, text);
        const Core::Result<Core::Location> place = Core::Location::Parse(text);
        const bool bFits = place.has_value() && place->GetKind() == action.kind
            && (side == ESide::Any || place->IsRobotPort() == (side == ESide::Robot));
        if (!bFits)
        {
            Add(ERule::PlanAction, step, fmt::format("{} {} {}", action.name, member, Core::QuoteForError(text)));
        }
    }

    /// The codec accepts other case and A01.CP1.
    void CheckSpelling(const Protocol::PlanStep& step, const std::string& text)
    {
        const Core::Result<Core::Location> place = Core::Location::Parse(text);
        if (place.has_value() && place->WasNormalised())
        {
            Add(ERule::PlanLocation,
                step,
                fmt::format("{} instead of {}", Core::QuoteForError(text), place->GetText()));
        }
    }
};

} // namespace

std::vector<PlanFinding> CheckPlan(const Protocol::ExecutionPlan& plan)
{
    return PlanChecker(plan).Check();
}

} // namespace ACS::AcsSim
