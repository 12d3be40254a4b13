#pragma once

#include "transaction/EngineState.hpp"

#include <cstdint>

namespace ACS::Planning
{

/// Offered plans that return to the queue.
enum class EOffers : std::uint8_t
{
    Unavailable, ///< Those of robots that cannot begin them.
    All,         ///< Those that would begin although the TSC is not Auto, and keep it from being Paused.
};

/// Which robot has a plan: offers plans to robots, starts them, and takes them back.
class PlanAssignment
{
    PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    CallRecord& _call;
    const StoreBacklog& _backlog;

public:
    explicit PlanAssignment(EngineState& engine);

    /// Offers the plan to the robot: it stays Pending until the robot has accepted its first command.
    void Offer(ActivePlan& plan, Robot& robot);
    /// The robot has accepted its first command: reports the plan as InProgress and its step as Dispatched, once.
    void Start(ActivePlan& plan);
    /// The plan returns to the queue. Its robot has no drive.
    void Withdraw(ActivePlan& plan);
    /// Withdraws the offered plans whose robots have no drive.
    void WithdrawOffers(EOffers offers);
    /// Another robot may take over the plan: it names no robot, none of its jobs was commanded or may be done, and no control is
    /// open.
    [[nodiscard]] bool CanHandOver(const ActivePlan& plan) const;
    /// Gives the plan to another robot. The present one is stationary without a drive.
    void HandOver(ActivePlan& plan, Robot& successor);
    /// The robot waits for the way to the present step's station.
    void BeginStep(ActivePlan& plan, Robot& robot);
    static void FreeRobot(Robot& robot);

private:
    void PrepareStep(ActivePlan& plan, Robot& robot);
};

} // namespace ACS::Planning
