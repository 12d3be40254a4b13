#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/EngineInput.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

namespace ACS::Planning
{

class InputQueue;

/// The loop around a PlanEngine: calls it for one input at a time and passes its actions to the handlers strictly in order.
/// Inputs wait while a batch is being stored, at most InputLimits of them, so that a blocked disk does not fill the memory.
/// Events of robots, timers and controls are handled before plans, and plans before commands of the operator; a class to which
/// others were preferred 16 times has its turn. Plans that wait together share one transaction, and so do commands of the
/// operator. Waiting states of a robot that differ only in pose or battery are merged into the latest one. Does no I/O: store,
/// timers, robots and MCS belong to the caller. Called by one thread at a time.
class ACS_API PlanEngineHost
{
public:
    /// Executes one action; never called with StorePlans. May call Push and Offer.
    using ExecuteHandler = std::function<void(const EngineAction& action)>;
    /// Stores the batch as one transaction and calls OnStored with the result, before it returns or later.
    using StoreHandler = std::function<void(const StoreBatch& batch)>;

private:
    PlanEngine& _engine;
    const Core::IClock& _clock;
    ExecuteHandler _execute;
    StoreHandler _store;
    std::unique_ptr<InputQueue> _inputs;
    std::deque<EngineAction> _actions; ///< Still to be executed.
    bool _bWorking = false;
    bool _bClosed = false;

public:
    /// Engine and clock must outlive the host.
    PlanEngineHost(
        PlanEngine& engine,
        const Core::IClock& clock,
        ExecuteHandler execute,
        StoreHandler store,
        const InputLimits& limits = {});
    PlanEngineHost(const PlanEngineHost&) = delete;
    PlanEngineHost& operator=(const PlanEngineHost&) = delete;
    ~PlanEngineHost();

    /// Passes the content of the store to the engine. Call it once, before any other function.
    void Restore(StoredState state);

    /// Handles the input, or queues it. A command is rejected by its reply if it would exceed a limit, and after Close; other
    /// inputs are dropped after Close.
    void Push(EngineInput input);

    /// As Push, for a command of the operator. Unless Accepted, the command is not handled. The receipt is stored in the
    /// transaction of the command; if that fails, with the retry. It is not stored if the reply refuses the command, whose
    /// state may have changed while it waited for the store.
    [[nodiscard]] EInputAdmission Offer(
        PlanCommand command,
        std::optional<CommandReceipt> receiptOrNull = std::nullopt);

    /// The result of the batch that was passed to the StoreHandler.
    void OnStored(const Core::Result<void>& result);

    /// IPlanStore::Check has failed. Ignored while a batch is being stored, because that batch fails too.
    void OnStoreLost(const Core::Error& error);

    /// Rejects all further and waiting commands and drops all other inputs. A batch that is being stored is still completed.
    void Close();

    /// Whether a batch that was passed to the StoreHandler has no OnStored yet.
    [[nodiscard]] bool IsStoring() const noexcept;

    /// Number of inputs that wait for the store.
    [[nodiscard]] std::size_t GetWaitingCount() const noexcept;

private:
    void Reject(const PlanCommand& command, std::string_view reason) const;
    void Work();
    void CallEngine();
    void ExecuteNext();
    void Append(EngineActions actions);
};

} // namespace ACS::Planning
