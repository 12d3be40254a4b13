#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <variant>

namespace ACS::Planning
{

/// What a robot's adapter has reported.
struct RobotInput
{
    std::string robotID;
    RobotEvent event;
};

/// What the engine is called for.
using EngineInput = std::variant<PlanCommand, RobotInput, EngineTimer>;

/// The loop around a PlanEngine: calls it for one input at a time and has its actions executed strictly in order. While a
/// batch is being stored, inputs wait. Plans that wait together are handed over together, so that one transaction serves a
/// burst of them. Of states of a robot that differ only in pose or battery the latest counts, so that a disk that hangs does
/// not fill the memory. Pure; store, timers, robots and MCS belong to the caller. One thread at a time calls it.
class PlanEngineHost
{
public:
    /// Executes one action, never a StorePlans; may push inputs.
    using ExecuteHandler = std::function<void(const EngineAction& action)>;
    /// Stores the batch as one transaction and reports the outcome to OnStored, later or from within.
    using StoreHandler = std::function<void(const StoreBatch& batch)>;

private:
    PlanEngine& _engine;
    const Core::IClock& _clock;
    ExecuteHandler _execute;
    StoreHandler _store;
    std::deque<EngineInput> _inputs;
    std::deque<EngineAction> _actions; ///< Still to be executed.
    bool _bWorking = false;
    bool _bClosed = false;

public:
    /// Engine and clock must outlive the host.
    PlanEngineHost(PlanEngine& engine, const Core::IClock& clock, ExecuteHandler execute, StoreHandler store);

    /// Once, before anything else: what the store held.
    void Restore(StoredState state);

    /// A command that comes after Close is rejected by its reply.
    void Push(EngineInput input);

    /// The same for a command whose sender waits for no reply. False, and nothing done, after Close.
    [[nodiscard]] bool TryPush(PlanCommand command);

    /// The outcome of the batch that was given to the StoreHandler.
    void OnStored(const Core::Result<void>& result);

    /// The store has reported, without a batch, that it would fail. Ignored while a batch is being stored: that will fail
    /// itself.
    void OnStoreLost(const Core::Error& error);

    /// From now on commands are rejected, waiting ones included, and all other inputs are dropped. What is being stored is
    /// still completed.
    void Close();

    [[nodiscard]] bool IsStoring() const noexcept;

    /// Number of inputs that wait for the store.
    [[nodiscard]] std::size_t GetWaitingCount() const noexcept;

private:
    [[nodiscard]] bool TryMerge(const EngineInput& input);
    void Reject(const EngineInput& input) const;
    void Work();
    void CallEngine();
    void ExecuteNext();
    void Append(EngineActions actions);
};

} // namespace ACS::Planning
