#include "floor/FloorChecker.hpp"

#include "console/CleanText.hpp"
#include "floor/FloorStock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

using Protocol::EJobStatus;
using Protocol::EStepStatus;

namespace
{

/// The state of a move according to the reports.
enum class EMoveReport : std::uint8_t
{
    None,  ///< It was not begun.
    Begun, ///< The reports leave open whether it was done.
    Completed,
};

EMoveReport GetReport(EStepStatus status)
{
    switch (status)
    {
        case EStepStatus::Completed:
            return EMoveReport::Completed;
        case EStepStatus::InProgress:
        case EStepStatus::Failed:
        case EStepStatus::Skipped:
            return EMoveReport::Begun;
        case EStepStatus::Pending:
        case EStepStatus::Dispatched:
        default:
            return EMoveReport::None;
    }
}

EMoveReport GetReport(EJobStatus status)
{
    switch (status)
    {
        case EJobStatus::Completed:
            return EMoveReport::Completed;
        case EJobStatus::Instructed:
        case EJobStatus::InProgress:
        case EJobStatus::Failed:
            return EMoveReport::Begun;
        case EJobStatus::Pending:
        default:
            return EMoveReport::None;
    }
}

EMoveReport GetReport(const TrackedPlan& plan, const FloorMove& move)
{
    for (const TrackedStep& step : plan.steps)
    {
        if (step.stepNo != move.stepNo)
        {
            continue;
        }
        const auto job = std::find_if(step.jobs.begin(), step.jobs.end(), [&move](const TrackedJob& candidate) {
            return candidate.jobID == move.jobID;
        });
        return job == step.jobs.end() ? GetReport(step.status) : GetReport(job->status);
    }
    return EMoveReport::None;
}

/// The way of a carrier through a plan.
struct CarrierWay
{
    std::string to;           ///< Of its last move that was reported Completed; empty: of none.
    bool bLast = false;       ///< That was the last move of the plan.
    bool bUnresolved = false; ///< A later one was begun.
};

std::map<std::string, CarrierWay> MakeWays(const TrackedPlan& plan, const FloorPlan& floor)
{
    std::map<std::string, CarrierWay> ways;
    for (const FloorMove& move : floor.moves)
    {
        const Sim::WorldEvent event = WithRobot(move.event, plan.robotID);
        const auto* const movedOrNull = std::get_if<Sim::CarrierMoved>(&event);
        if (movedOrNull == nullptr || movedOrNull->carrierID.empty())
        {
            continue;
        }
        CarrierWay& way = ways[movedOrNull->carrierID];
        const EMoveReport report = GetReport(plan, move);
        way.bLast = report == EMoveReport::Completed;
        way.bUnresolved = !way.bLast && (way.bUnresolved || report == EMoveReport::Begun);
        way.to = way.bLast ? movedOrNull->to : way.to;
    }
    return ways;
}

} // namespace

FloorChecker::FloorChecker(PlanTracker& tracker, Sim::IWorld& world, EStocking stocking)
    : _tracker(tracker),
      _world(world),
      _stocking(stocking)
{
    static_cast<void>(_world.TakeEvents());
    OnPlansAdded();
}

void FloorChecker::OnPlansAdded()
{
    for (std::size_t i = _plans.size(); i < _tracker.GetPlans().size(); ++i)
    {
        const TrackedPlan& plan = _tracker.GetPlans()[i];
        _plans.push_back({MakeFloorPlan(plan.planned.plan), 0});
        // A planId that is there already is refused: it claims nothing and moves nothing.
        const bool bFirst = _tracker.FindPlanOrNull(plan.planned.plan.planID) == &plan;
        if (_stocking == EStocking::Restock && bFirst)
        {
            _turns.Add(i, _plans.back().floor.claims);
            if (!_turns.IsFirst(i))
            {
                _tracker.Block(i);
            }
        }
    }
}

void FloorChecker::OnSending(std::size_t index, PlanTracker::Lines& out)
{
    const TrackedPlan& plan = _tracker.GetPlans()[index];
    if (_stocking == EStocking::Restock && _tracker.FindPlanOrNull(plan.planned.plan.planID) == &plan)
    {
        const Core::Result<void> restocked = Restock(_plans[index].floor, _world, out);
        if (!restocked.has_value())
        {
            _tracker.AddViolation(
                fmt::format(
                    "{} is sent without restocking: {}",
                    CleanText(plan.planned.plan.planID),
                    CleanText(Core::Describe(restocked.error()))),
                out);
        }
    }
    ReadEvents(out);
    _plans[index].firstEvent = _eventCount;
    _open.insert(index);
}

void FloorChecker::OnRequest(const Protocol::AcsPayload& payload, PlanTracker::Lines& out)
{
    const auto* const jobOrNull = std::get_if<Protocol::JobReport>(&payload);
    const auto* const stepOrNull = std::get_if<Protocol::StepReport>(&payload);
    if (jobOrNull != nullptr && jobOrNull->status == EJobStatus::Completed)
    {
        CheckReport(jobOrNull->planID, jobOrNull->robotID, jobOrNull->stepNo, jobOrNull->jobID, out);
    }
    else if (stepOrNull != nullptr && stepOrNull->status == EStepStatus::Completed)
    {
        CheckReport(stepOrNull->planID, stepOrNull->robotID, stepOrNull->stepNo, {}, out);
    }
}

void FloorChecker::EndPlans(PlanTracker::Lines& out)
{
    const std::set<std::size_t> open = _open;
    for (const std::size_t index : open)
    {
        if (GetOutcome(_tracker.GetPlans()[index]) == EOutcome::Open)
        {
            continue;
        }
        _open.erase(index);
        CountCarriers(index, out);
        for (const std::size_t next : _turns.End(index))
        {
            _tracker.Unblock(next);
        }
    }
}

void FloorChecker::Finish(PlanTracker::Lines& out)
{
    EndPlans(out);
    for (const std::size_t index : std::exchange(_open, {}))
    {
        CountCarriers(index, out);
    }
    ReadEvents(out);
    for (std::size_t i = 0; i < _plans.size() && !_moves.empty(); ++i)
    {
        ExcuseUnfinished(i);
    }
    for (const Move& move : _moves)
    {
        _tracker.AddViolation("done without a report: " + CleanText(Describe(move.event)), out);
    }
    _moves.clear();
}

const DeliveryCount& FloorChecker::GetCount() const noexcept
{
    return _count;
}

void FloorChecker::ReadEvents(PlanTracker::Lines& out)
{
    for (Sim::WorldEvent& event : _world.TakeEvents())
    {
        if (IsMove(event))
        {
            _moves.push_back({_eventCount, std::move(event)});
        }
        ++_eventCount;
    }
    const std::optional<Core::Error> failed = _world.GetFailureOrNull();
    std::string failure = failed.has_value() ? CleanText(Core::Describe(*failed)) : std::string();
    if (!failure.empty() && failure != _failure)
    {
        _tracker.AddViolation("the world cannot be read, moves may be missing: " + failure, out);
    }
    _failure = std::move(failure);
}

void FloorChecker::CheckReport(
    const std::string& planID,
    const std::string& robotID,
    std::int32_t stepNo,
    const std::string& jobID,
    PlanTracker::Lines& out)
{
    const TrackedPlan* const planOrNull = _tracker.FindPlanOrNull(planID);
    if (planOrNull == nullptr)
    {
        return; // reported by the tracker
    }
    const CheckedPlan& plan = _plans[static_cast<std::size_t>(planOrNull - _tracker.GetPlans().data())];
    const auto& moves = plan.floor.moves;
    const auto move = std::find_if(moves.begin(), moves.end(), [stepNo, &jobID](const FloorMove& candidate) {
        return candidate.stepNo == stepNo && candidate.jobID == jobID;
    });
    if (move == moves.end())
    {
        return;
    }
    ReadEvents(out);
    const Sim::WorldEvent expected = WithRobot(move->event, robotID);
    if (!TryClaim(plan, expected))
    {
        _tracker.AddViolation(
            fmt::format(
                "{} {} step {} Completed, but not moved: {}",
                CleanText(planID),
                jobID.empty() ? "StepReport" : "JobReport",
                stepNo,
                CleanText(Describe(expected))),
            out);
    }
}

bool FloorChecker::TryClaim(const CheckedPlan& plan, const Sim::WorldEvent& expected)
{
    const auto found = std::find_if(_moves.begin(), _moves.end(), [&plan, &expected](const Move& move) {
        return move.number >= plan.firstEvent && IsSameMove(expected, move.event);
    });
    if (found == _moves.end())
    {
        return false;
    }
    _moves.erase(found);
    return true;
}

void FloorChecker::CountCarriers(std::size_t index, PlanTracker::Lines& out)
{
    const TrackedPlan& plan = _tracker.GetPlans()[index];
    for (const auto& [carrierID, way] : MakeWays(plan, _plans[index].floor))
    {
        if (way.to.empty())
        {
            continue;
        }
        const std::optional<std::string> place = _world.GetPlaceOrNull(carrierID);
        if (place == way.to)
        {
            _count.delivered += way.bLast ? 1U : 0U;
        }
        else if (!way.bUnresolved && !IsClaimed(carrierID))
        {
            ++_count.misplaced;
            _tracker.AddViolation(
                fmt::format(
                    "{} {} is at {}, not at {}",
                    CleanText(plan.planned.plan.planID),
                    CleanText(carrierID),
                    CleanText(place.value_or("no place")),
                    CleanText(way.to)),
                out);
        }
    }
}

bool FloorChecker::IsClaimed(const std::string& carrierID) const
{
    return std::any_of(_open.begin(), _open.end(), [this, &carrierID](std::size_t index) {
        const std::vector<std::string>& claims = _plans[index].floor.claims;
        return std::find(claims.begin(), claims.end(), carrierID) != claims.end();
    });
}

void FloorChecker::ExcuseUnfinished(std::size_t index)
{
    const TrackedPlan& plan = _tracker.GetPlans()[index];
    for (const FloorMove& move : _plans[index].floor.moves)
    {
        if (plan.sends > 0 && GetReport(plan, move) == EMoveReport::Begun)
        {
            static_cast<void>(TryClaim(_plans[index], WithRobot(move.event, plan.robotID)));
        }
    }
}

} // namespace ACS::McsSim
