#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>

namespace ACS::Acsd
{

/// What a robot has told.
struct RobotTask
{
    std::string robotID;
    Planning::RobotEvent event;
};

/// What the engine is to be called for.
using EngineTask = std::variant<Planning::PlanCommand, RobotTask, Planning::EngineTimer>;

/// Calls the engine for one task at a time and has its actions carried out strictly in order. While a batch is on its way
/// to the disk nothing else happens to the engine: tasks wait. Plans that wait together are handed over together, so that
/// one transaction serves a burst of them, and of states of a robot that differ in its pose or battery only the latest
/// counts, so that a disk that hangs fills no memory. Pure; the store and everything else are the caller's.
class EngineLoop
{
public:
    /// Carries one action out, never a StorePlans; may push tasks.
    using ExecuteHandler = std::function<void(const Planning::EngineAction& action)>;
    /// Begins to store the batch; OnStored is called when that is done, never from within.
    using StoreHandler = std::function<void(const Planning::StoreBatch& batch)>;

private:
    Planning::PlanEngine& _engine;
    const Core::IClock& _clock;
    ExecuteHandler _execute;
    StoreHandler _store;
    std::deque<EngineTask> _tasks;
    Planning::EngineActions _actions; ///< Of the last call.
    std::size_t _executed = 0;        ///< So many of them are done.
    std::optional<Planning::StoreBatch> _storing;
    bool _bWorking = false;
    bool _bClosed = false;

public:
    /// Engine and clock must outlive the loop.
    EngineLoop(Planning::PlanEngine& engine, const Core::IClock& clock, ExecuteHandler execute, StoreHandler store);

    /// Once, before anything else: what the store held.
    void Restore(Planning::StoredState state);

    /// A command that comes after Close is refused by its reply.
    void Push(EngineTask task);

    /// The same for a command whose sender waits for no reply: false, and nothing done, after Close.
    [[nodiscard]] bool TryPush(Planning::PlanCommand command);

    /// The batch is on disk, or could not be stored: then the engine decides anew about what stood behind it.
    void OnStored(const Core::Result<void>& result);

    /// The store has shown, without a batch, that it would fail; nothing while one is on its way, which will fail itself.
    void OnStoreLost(const Core::Error& error);

    /// From now on commands are refused, those that wait too, and all other tasks are forgotten; what is being stored is
    /// still brought to its end.
    void Close();

    [[nodiscard]] bool IsStoring() const noexcept;

    /// Tasks that wait for the disk.
    [[nodiscard]] std::size_t GetWaitingCount() const noexcept;

private:
    [[nodiscard]] bool TryMerge(const EngineTask& task);
    void Refuse(const EngineTask& task) const;
    void Work();
    void CallEngine();
    void ExecuteNext();
};

} // namespace ACS::Acsd
