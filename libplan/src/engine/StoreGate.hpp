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

/// Owns the CommitGate. Commits the changes of each call, withholds what depends on them, and recovers when the store fails.
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

    /// Emits one batch for the whole call and withholds everything that depends on it.
    void Commit(EngineActions& out);
    /// Removes an acknowledged report; stored with the next batch or after a delay.
    void Acknowledge(const MessageAcknowledged& command);
    /// The delay has expired (timer Acknowledged).
    void StoreAcknowledged();
    /// Releases the withheld actions or, after a failure, what is possible without the store.
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);
    [[nodiscard]] bool IsStoring() const noexcept;
    /// The store reports that it would fail, without a batch in progress.
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);
    /// Clears the alarm once a batch was stored again; called at the beginning of each call.
    void CheckStoreRecovery();

private:
    /// Collects the WorkRecord of each robot, so that commands are stored before they are sent.
    void CollectWork();
    /// Raises ACS-1005, whose report waits for the store too, and starts the retries.
    void ReportStoreFailure(std::string_view reason, EngineActions& out);
    /// Releases all actions but the reports.
    void ReleaseActions(EngineActions& out);
    void StartStoreRetry(EngineActions& out);
    /// Keeps the changes for the next attempt, except new plans, which are withdrawn. Returns the number of withdrawn plans.
    [[nodiscard]] std::size_t RecoverBatch(const StoreBatch& batch, bool bUnknown);
    /// Withdraws the control of this call if it pauses or resumes a robot: after a crash the reason of the pause would be unknown,
    /// or the robot would drive for a plan that is paused. Its request is refused.
    [[nodiscard]] bool TryWithdrawControl(CommitGate::Transaction& transaction);
    /// Handles withheld actions: reports wait, new plans are refused, everything else is released. The refusals wait too if the
    /// batch may be stored. So does the answer to any other control, which has taken effect.
    void ReleaseWithoutStore(
        const EngineActions& withheld,
        bool bRefused,
        const Core::Error& error,
        EngineActions& out);
    /// Withdraws a job that must not be executed while a crash would lose its record.
    [[nodiscard]] bool TryWithdrawJob(const CommandRobot& command);
    [[nodiscard]] static Alarm MakeStoreAlarm(std::string message);
};

} // namespace ACS::Planning
