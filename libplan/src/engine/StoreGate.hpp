#pragma once

#include "control/ControlAnswers.hpp"
#include "traffic/PlaceTracker.hpp"
#include "transaction/CommitGate.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Commits each call's changes, withholds what depends on them, and recovers when the store fails.
class StoreGate
{
    const EngineOptions& _options;
    PlanBook& _plans;
    Fleet& _fleet;
    ReportOutbox& _outbox;
    EngineTransaction& _transaction;
    CallRecord& _call;
    StoreBacklog& _backlog;
    ControlAnswers& _answers;
    const PlaceTracker& _places;
    PlanWork& _work;
    CommitGate _gate;
    std::vector<StoreChange> _acknowledged; ///< Stored with the next batch, or by the timer.

public:
    StoreGate(EngineState& engine, ControlAnswers& answers, const PlaceTracker& places, PlanWork& work);

    /// One batch for the whole call, then everything that waits for it.
    void Commit(EngineActions& out);
    void Acknowledge(const MessageAcknowledged& command);
    /// The timer Acknowledged.
    void StoreAcknowledged();
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);
    [[nodiscard]] bool IsStoring() const noexcept;
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);
    /// A call after a batch that did not fail.
    void CheckStoreRecovery();

private:
    /// What robots were told in this call is stored before they are told.
    void CollectWork();
    /// By the alarm, which waits for the store with all the rest, and tries again from now on.
    void ReportStoreFailure(std::string_view reason, EngineActions& out);
    /// The actions of a call whose changes are not stored: all but the reports.
    void ReleaseActions(EngineActions& out);
    void StartStoreRetry(EngineActions& out);
    /// What is to be stored later, but for new plans: they are not told to anybody and not begun, as if they had never come.
    /// Gives how many there were.
    [[nodiscard]] std::size_t RecoverBatch(const StoreBatch& batch);
    /// What depends on the batch: reports wait, new plans and controls are rejected, everything else is released.
    void ReleaseWithoutStore(
        const EngineActions& withheld,
        bool bPlanRefused,
        std::string_view reason,
        EngineActions& out);
    /// What a robot must not do while nobody could know of it after a crash.
    [[nodiscard]] bool TryWithdraw(const CommandRobot& command);
    /// The control that wanted it is refused. After a crash nobody would know who has stopped the robot.
    void WithdrawPause(Robot& robot);
    [[nodiscard]] static Alarm MakeStoreAlarm(std::string message);
};

} // namespace ACS::Planning
