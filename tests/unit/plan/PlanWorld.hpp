#pragma once

#include "FakeRobotAdapter.hpp"
#include "FaultyPlanStore.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A one-way loop of lane nodes L01…L16 with a dock on each: six cassette ports, four sets, two ports of A02, a stocker
/// port and three chargers. All edges for both vehicle types.
[[nodiscard]] Planning::SiteMap MakeTestSite();

/// LR01 at home on CHG01, CR01 on CHG02; more of each on request.
[[nodiscard]] Planning::EngineOptions MakeTestOptions(bool bFourRobots);

/// The plans of the document: section 6.3 and section 6.4.
[[nodiscard]] Planning::Plan MakeLogisticsPlan(const std::string& planID);
[[nodiscard]] Planning::Plan MakeControlPlan(const std::string& planID);

/// Engine, store and robots in virtual time, driven as a program drives them.
class PlanWorld
{
    struct Entry
    {
        Core::SteadyTime time;
        std::uint64_t order = 0;
        std::string robotID; ///< Of a robot's timer; empty: the engine's.
        Planning::EngineTimer engineTimer;
        Planning::AdapterTimerID robotTimer = 0;
        std::uint64_t generation = 0;
    };

    ManualClock _clock;
    SeededRandom _random;
    std::vector<Entry> _entries;
    std::uint64_t _order = 0;
    std::map<Planning::EngineTimer, std::uint64_t> _engineTimers;
    std::map<std::pair<std::string, Planning::AdapterTimerID>, std::uint64_t> _robotTimers;
    std::map<std::string, std::unique_ptr<FakeRobotAdapter>> _robots;
    std::deque<std::pair<std::string, Planning::RobotEvent>> _delayed; ///< Answers of robots to commands.
    bool _bExecuting = false;
    std::optional<std::size_t> _crashAt;

public:
    FaultyPlanStore store;
    std::unique_ptr<Planning::PlanEngine> engine;
    std::vector<std::string> trace; ///< Every store, reply, report, command and status, in order.
    std::vector<Planning::OutboxEntry> reports;
    std::map<Planning::ReplyToken, Planning::ReplyCommand> replies;
    std::vector<std::string> violations;
    std::map<std::string, std::string> driveIDs; ///< The latest of each robot.
    bool bAcknowledges = true;

    explicit PlanWorld(std::uint64_t seed = 1, bool bFourRobots = false);
    PlanWorld(std::uint64_t seed, Planning::EngineOptions options, Planning::SiteMap site);

    void Connect();
    void Submit(Planning::Plan plan, Planning::ReplyToken token = 0, const std::string& transactionID = {});
    void SubmitTogether(const std::vector<Planning::SubmitPlan>& plans);
    void Control(
        Planning::EPlanControl control,
        const std::string& planID,
        Planning::ReplyToken token = 0,
        const std::string& transactionID = {});
    void Settle(
        const std::string& planID,
        const std::string& jobID,
        Planning::EJobAnswer answer,
        Planning::ReplyToken token = 0);
    void Advance(std::chrono::milliseconds time);
    void SwitchTsc(bool bPause);
    void Ask(const Planning::PlanCommand& command);
    void Raise(const std::string& robotID, const Planning::RobotEvent& event);
    /// Has the robot tell its state.
    void TellState(const std::string& robotID);
    /// As somebody at the robot would: past the engine.
    void Operate(const std::string& robotID, const Planning::RobotCommand& command);
    /// Until nothing is left to happen, or the predicate holds after an event. False: more than a day went by.
    bool TryRun(const std::function<bool()>& isReached = {});
    /// The engine is gone. What robots tell now nobody hears; they go on by themselves.
    void Crash();
    /// The actions of this call are lost from this one on (0: the first), and the engine with them. Counts anew.
    void CrashAtAction(std::size_t number);
    /// A new engine on what the store holds; the robots stay where they are.
    void Restart(Planning::EngineOptions options, Planning::SiteMap site);

    [[nodiscard]] FakeRobotAdapter& GetRobot(const std::string& robotID);
    [[nodiscard]] Core::Now GetNow() const;
    [[nodiscard]] std::uint64_t GetRandom(std::uint64_t below);
    /// The lines of the trace about reports of this plan: "Plan InProgress", "Step 1 Dispatched", "Job 1 a4184 Completed".
    [[nodiscard]] std::vector<std::string> GetReportsOf(const std::string& planID) const;
    [[nodiscard]] std::vector<std::string> GetTraceOf(const std::string& prefix) const;

private:
    void AddRobots(const Planning::EngineOptions& options);
    void Execute(Planning::EngineActions actions);
    void ExecuteAll(Planning::EngineActions actions);
    void ExecuteAction(const Planning::EngineAction& action, std::vector<std::uint64_t>& acknowledged);
    void RaiseDelayed();
    void Replay(const std::vector<Planning::OutboxEntry>& outbox);
    void ExecuteRobot(const std::string& robotID, const Planning::AdapterActions& actions);
    void CheckOccupancy();
    void Push(Entry entry, Core::Duration delay);
    void Fire(const Entry& entry);
};

} // namespace ACS::Testing
