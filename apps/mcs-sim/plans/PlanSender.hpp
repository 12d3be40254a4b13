#pragma once

#include "console/RobotBoard.hpp"
#include "floor/FloorChecker.hpp"
#include "plans/PlannedPlan.hpp"
#include "plans/PlanTracker.hpp"
#include "wire/Profile.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <cstddef>
#include <functional>
#include <list>
#include <optional>
#include <set>
#include <string>

namespace ACS::McsSim
{

/// Decides which plan of the tracker goes next, and names its robot where the profile wants that: a plan that was made
/// for this run then waits until the ACS has reported a robot that can execute it.
class PlanSender
{
public:
    /// False where the link has just gone, or is full.
    using TrySendPlan = std::function<bool(const Protocol::ExecutionPlan& plan, const std::string& transactionID)>;

private:
    PlanTracker& _tracker;
    const RobotBoard& _board;
    EProfile _profile;
    FloorChecker* _floorOrNull;
    TrySendPlan _trySend;
    std::set<std::size_t> _freshPlans; ///< Made for this run; the others go as they were written.
    std::list<std::size_t>
        _heldPlans; ///< Of a scenario: they wait for the ACS, for a robot or for another plan to end.
    std::optional<Core::SteadyTime> _firstSent;

public:
    /// Tracker, board and floor outlive the sender.
    /// @param floorOrNull Learns of every plan, and may block it in the tracker.
    /// @param bFreshPlans The plans that the tracker holds already were made for this run.
    PlanSender(
        PlanTracker& tracker,
        const RobotBoard& board,
        FloorChecker* floorOrNull,
        EProfile profile,
        bool bFreshPlans,
        TrySendPlan trySend);

    /// One more plan, for SendDue. Its index in the tracker.
    std::size_t Add(PlannedPlan planned, bool bFresh);

    /// One more plan, now. True where it was sent, or waits for a robot, for an ACS that takes plans again, or for another
    /// plan to end.
    [[nodiscard]] bool TrySendOrHold(
        const PlannedPlan& planned,
        bool bFresh,
        bool bPlansTaken,
        Core::Now now,
        PlanTracker::Lines& lines);

    /// The plans that wait, as far as they can go now.
    void SendHeld(bool bPlansTaken, Core::Now now, PlanTracker::Lines& lines);

    /// Every plan whose time has come. What cannot go now is tried at the next call. A plan that waits for a robot does not delay
    /// the others.
    void SendDue(Core::Now now, PlanTracker::Lines& lines);

    [[nodiscard]] std::optional<Core::SteadyTime> GetFirstSentOrNull() const noexcept;

private:
    [[nodiscard]] bool TrySend(std::size_t index, Core::Now now, PlanTracker::Lines& lines);
    [[nodiscard]] bool IsBlocked(std::size_t index) const;
    /// Whether the plan can go as it is. Names its robot where the profile wants that and one is known.
    [[nodiscard]] bool IsNamed(std::size_t index);
};

} // namespace ACS::McsSim
