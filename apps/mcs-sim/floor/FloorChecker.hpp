#pragma once

#include "floor/FloorPlan.hpp"
#include "plans/PlanTracker.hpp"
#include "plans/PlanTurns.hpp"
#include "world/IWorld.hpp"
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// Whether the floor is made ready for each plan (Restock).
enum class EStocking : std::uint8_t
{
    Restock, ///< Plans that share a station or a carrier go one after the other, because each finds the floor as it needs it.
    Leave,
};

/// Carriers that the plans of a run have moved.
struct DeliveryCount
{
    std::size_t delivered = 0; ///< They were at their last `to` when their plan was over.
    std::size_t misplaced = 0; ///< They were not where the last job that was reported Completed had to bring them.

    bool operator==(const DeliveryCount&) const = default;
};

/// Compares what the ACS reports of its plans with what the simulated robots have moved: each job that is reported Completed
/// has one move of its own, and each move has such a job. What is wrong becomes a violation of the tracker. Moves that
/// happened before a plan was sent are not its own. A world that cannot be read or written is a violation, too.
class FloorChecker
{
    struct Move
    {
        std::size_t number; ///< Of all events since the run began.
        Sim::WorldEvent event;
    };

    struct CheckedPlan
    {
        FloorPlan floor;
        std::size_t firstEvent = 0; ///< The number of the next event when it was sent.
    };

    PlanTracker& _tracker;
    Sim::IWorld& _world;
    EStocking _stocking;
    std::vector<CheckedPlan> _plans; ///< As those of the tracker.
    std::set<std::size_t> _open;     ///< Plans that were sent and are not over.
    PlanTurns _turns;
    std::list<Move> _moves; ///< Those that no report has claimed.
    std::size_t _eventCount = 0;
    DeliveryCount _count;
    std::string _failure; ///< Of the world, as it was reported last; empty: none.

public:
    /// Tracker and world outlive the checker. What happened in the world before does not count.
    FloorChecker(PlanTracker& tracker, Sim::IWorld& world, EStocking stocking);

    /// The tracker has more plans than before.
    void OnPlansAdded();

    /// Before a plan goes to the ACS for the first time.
    void OnSending(std::size_t index, PlanTracker::Lines& out);

    /// Any request of the ACS, after the tracker.
    void OnRequest(const Protocol::AcsPayload& payload, PlanTracker::Lines& out);

    /// After anything that can end a plan: counts the carriers of those that are over, and lets others go.
    void EndPlans(PlanTracker::Lines& out);

    /// The run is over: what was moved without a report is wrong. Once.
    void Finish(PlanTracker::Lines& out);

    [[nodiscard]] const DeliveryCount& GetCount() const noexcept;

private:
    void ReadEvents(PlanTracker::Lines& out);
    void CheckReport(
        const std::string& planID,
        const std::string& robotID,
        std::int32_t stepNo,
        const std::string& jobID,
        PlanTracker::Lines& out);
    /// Takes the first move of this kind since the plan was sent. False: there is none.
    [[nodiscard]] bool TryClaim(const CheckedPlan& plan, const Sim::WorldEvent& expected);
    void CountCarriers(std::size_t index, PlanTracker::Lines& out);
    /// Whether a plan that is not over moves the carrier, too.
    [[nodiscard]] bool IsClaimed(const std::string& carrierID) const;
    void ExcuseUnfinished(std::size_t index);
};

} // namespace ACS::McsSim
