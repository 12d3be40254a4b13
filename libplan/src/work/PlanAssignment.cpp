#include "work/PlanAssignment.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

PlanAssignment::PlanAssignment(EngineState& engine)
    : _plans(engine.plans),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _call(engine.call),
      _backlog(engine.backlog)
{
}

void PlanAssignment::Offer(ActivePlan& plan, Robot& robot)
{
    _plans.Dequeue(plan);
    plan.robot = robot.index;
    robot.planOrNull = &plan;
    robot.parking.bRefused = false;
    robot.work.BeginPlan(robot.view.state.has_value() ? robot.view.state->restartEvidence.commandID : std::nullopt);
    robot.changes.MarkWork();
    PrepareStep(plan, robot);
}

void PlanAssignment::Start(ActivePlan& plan)
{
    if (!IsOffered(plan))
    {
        return;
    }
    const std::string& robotID = _fleet[*plan.robot].GetID();
    plan.verdicts.rejections.clear();
    plan.record.progress.robotID = robotID;
    _call.begunPlanIDs.push_back(plan.record.plan.planID);
    plan.bUnstored = _backlog.IsFailing();
    _transaction.ChangePlan(plan, EPlanState::InProgress, fmt::format("Assigned to {}.", robotID));
    _transaction.ChangeStep(plan, EStepState::Dispatched, {});
}

void PlanAssignment::Withdraw(ActivePlan& plan)
{
    FreeRobot(_fleet[*std::exchange(plan.robot, std::nullopt)]);
    _plans.Enqueue(plan);
    _transaction.RequestDispatch();
}

void PlanAssignment::WithdrawOffers(EOffers offers)
{
    for (Robot& robot : _fleet)
    {
        const bool bOffered = robot.planOrNull != nullptr && !robot.drive.has_value() && IsOffered(*robot.planOrNull);
        if (bOffered && (offers == EOffers::All || !robot.IsUsable()))
        {
            Withdraw(*robot.planOrNull);
        }
    }
}

bool PlanAssignment::CanHandOver(const ActivePlan& plan) const
{
    return plan.robot.has_value() && plan.resolved.candidates.size() > 1 && !plan.bJobBegun
        && _fleet[*plan.robot].work.IsChecked() && !_fleet[*plan.robot].work.IsUnresolved()
        && plan.record.progress.state == EPlanState::InProgress && !plan.record.progress.control.has_value();
}

void PlanAssignment::HandOver(ActivePlan& plan, Robot& successor)
{
    Robot& robot = _fleet[*plan.robot];
    _transaction.Note(robot, fmt::format("plan {} is handed over to {}", plan.record.plan.planID, successor.GetID()));
    FreeRobot(robot);
    plan.record.progress.bArrived = false;
    plan.record.progress.robotID = successor.GetID();
    _call.begunPlanIDs.push_back(plan.record.plan.planID);
    Offer(plan, successor);
    _transaction.ChangeStep(plan, EStepState::Dispatched, {});
}

void PlanAssignment::FreeRobot(Robot& robot)
{
    robot.planOrNull = nullptr;
    robot.activity = EActivity::Idle;
    robot.changes.MarkWork(robot.work.TryResolve());
    robot.parking.retreatNode.reset();
    robot.changes.MarkStatus();
    robot.search.plannedRoute.reset();
    robot.search.block.clear();
    robot.search.blockers.clear();
}

void PlanAssignment::BeginStep(ActivePlan& plan, Robot& robot)
{
    PrepareStep(plan, robot);
    _transaction.ChangeStep(plan, EStepState::Dispatched, {});
}

void PlanAssignment::PrepareStep(ActivePlan& plan, Robot& robot)
{
    plan.job = 0;
    plan.repetition = {};
    plan.next = EContinuation::Job;
    plan.bStepArrived = false;
    robot.activity = EActivity::Waits;
    robot.changes.MarkStatus();
    robot.search.plannedRoute.reset();
    robot.search.detours = 0;
    _transaction.RequestDispatch();
}

} // namespace ACS::Planning
