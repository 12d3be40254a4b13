#pragma once

#include "PlannedPlan.hpp"
#include "PlanTracker.hpp"
#include "Profile.hpp"
#include "RobotBoard.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace ACS::McsSim
{

/// Decides which plan of the tracker goes next, and names its robot where the profile wants that: a plan that was made
/// for this run then waits until the ACS has told of a robot that can work it.
class PlanSender
{
public:
    /// False where the link has just gone, or is full.
    using TrySendPlan = std::function<bool(const Protocol::ExecutionPlan& plan, const std::string& transactionID)>;

private:
    PlanTracker& _tracker;
    const RobotBoard& _board;
    EProfile _profile;
    TrySendPlan _trySend;
    std::set<std::size_t> _freshPlans;  ///< Made for this run; the others go as they were written.
    std::deque<std::size_t> _heldPlans; ///< Of a scenario, until the ACS takes plans and has told of a robot.
    std::optional<Core::SteadyTime> _firstSent;

public:
    /// Tracker and board outlive the sender.
    /// @param bFreshPlans The plans that the tracker holds already were made for this run.
    PlanSender(PlanTracker& tracker, const RobotBoard& board, EProfile profile, bool bFreshPlans, TrySendPlan trySend);

    /// One more plan, for SendDue.
    void Add(PlannedPlan planned, bool bFresh);

    /// One more plan, now. True where it was sent, or waits for a robot, or for an ACS that takes plans again.
    [[nodiscard]] bool TrySendOrHold(
        const PlannedPlan& planned,
        bool bFresh,
        bool bPlansTaken,
        Core::Now now,
        PlanTracker::Lines& lines);

    /// The plans that wait, as far as they can go now.
    void SendHeld(Core::Now now, PlanTracker::Lines& lines);

    /// Every plan whose time has come. What cannot go now is tried at the next call.
    void SendDue(Core::Now now, PlanTracker::Lines& lines);

    [[nodiscard]] std::optional<Core::SteadyTime> GetFirstSentOrNull() const noexcept;

private:
    [[nodiscard]] bool TrySend(std::size_t index, Core::Now now, PlanTracker::Lines& lines);
    /// Whether the plan can go as it is. Names its robot where the profile wants that and one is known.
    [[nodiscard]] bool IsNamed(std::size_t index);
};

} // namespace ACS::McsSim
