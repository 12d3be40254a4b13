#pragma once

#include "model/ExecutorAction.hpp"
#include "model/RobotModel.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::AcsSim
{

/// Plays an ACS with simple robots: queues plans, executes them in the order of sections 6.12 to 6.14 and reports every state,
/// answers controls and queries. Pure.
class PlanExecutor
{
public:
    static constexpr std::size_t MOST_ENDED = 4096; ///< Ended plans that it remembers.

    struct Options
    {
        std::vector<std::string> robots{"LR01", "CR01"}; ///< LR…: cassettes, CR…: trays and memories.
        Core::Duration driveTime = std::chrono::seconds(1);
        Core::Duration jobTime = std::chrono::seconds(1);
        std::size_t maximumQueued = 100; ///< Plans that wait; others are refused.
        std::chrono::minutes siteOffset{0};
    };

private:
    Options _options;
    std::vector<RobotModel> _robots;
    std::deque<Protocol::ExecutionPlan> _waiting;                     ///< Paused ones keep their place.
    std::map<std::string, Protocol::PlanEntry, std::less<>> _entries; ///< By planID, ended plans included.
    std::deque<std::string> _endedPlans;                              ///< Whose entries are kept, oldest first.
    std::size_t _ended = 0;
    bool _bRefuseNext = false;
    bool _bFailNext = false;

public:
    explicit PlanExecutor(Options options);

    /// The states that follow a registration.
    void Report(ExecutorActions& out) const;
    void OnRequest(const Protocol::AcsRequest& request, Core::Now now, ExecutorActions& out);
    void OnTimer(Core::Now now, ExecutorActions& out);
    /// When OnTimer is due; nullopt: nothing is under way.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextDueOrNull() const;
    [[nodiscard]] Protocol::RobotPositionUpdate MakePositions() const;

    /// The next plan is refused as if the queue were full.
    void RefuseNextPlan();
    /// The next job that ends has failed.
    void FailNextJob();
    [[nodiscard]] std::size_t CountEnded() const;

private:
    using Control = void (PlanExecutor::*)(const std::string& planID, Core::Now now, ExecutorActions& out);

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const Protocol::ExecutionPlan& plan) const;
    [[nodiscard]] static bool CanExecute(const RobotModel& robot, const Protocol::ExecutionPlan& plan);
    void OnPlan(const Protocol::AcsRequest& request, Core::Now now, ExecutorActions& out);
    void OnControl(
        const Protocol::AcsRequest& request,
        const std::string& planID,
        Control control,
        Core::Now now,
        ExecutorActions& out);
    void OnHistory(
        const Protocol::AcsRequest& request,
        const Protocol::RequestAcsPlanHistory& query,
        ExecutorActions& out) const;
    void OnPlansQuery(const Protocol::AcsRequest& request, ExecutorActions& out) const;

    void Cancel(const std::string& planID, Core::Now now, ExecutorActions& out);
    void Abort(const std::string& planID, Core::Now now, ExecutorActions& out);
    void Pause(const std::string& planID, Core::Now now, ExecutorActions& out);
    void Resume(const std::string& planID, Core::Now now, ExecutorActions& out);
    void FinishAbort(const std::string& planID, std::size_t aborts, Core::Now now, ExecutorActions& out);
    /// One result for each AbortPlan.
    static void ReportAborts(
        const std::string& planID,
        std::size_t aborts,
        Protocol::EReportResult result,
        ExecutorActions& out);

    void StartPlans(Core::Now now, ExecutorActions& out);
    void Drive(RobotModel& robot, Core::Now now, ExecutorActions& out);
    void BeginJob(RobotModel& robot, std::size_t job, Core::Now now, ExecutorActions& out);
    void OnDone(RobotModel& robot, Core::Now now, ExecutorActions& out);
    void OnJobDone(RobotModel& robot, std::size_t job, Core::Now now, ExecutorActions& out);
    void EndStep(RobotModel& robot, Core::Now now, ExecutorActions& out);
    void FailPlan(RobotModel& robot, Core::Now now, ExecutorActions& out);
    static void MoveCarrier(RobotModel& robot);

    [[nodiscard]] RobotModel* FindRobotOrNull(std::string_view planID);
    [[nodiscard]] bool IsWaiting(std::string_view planID) const;
    [[nodiscard]] bool TryForgetWaiting(const std::string& planID);
    void Leave(const std::string& planID, Core::Now now, ExecutorActions& out);
    void SetPlan(const std::string& planID, Protocol::EPlanStatus status, Core::Now now, ExecutorActions& out);
    static void SetStep(const RobotModel& robot, Protocol::EStepStatus status, ExecutorActions& out);
    static void SetJob(const RobotModel& robot, Protocol::EJobStatus status, ExecutorActions& out);
    static void SetRobot(RobotModel& robot, Protocol::ERobotStatus status, ExecutorActions& out);
    void UpdateEntry(const RobotModel& robot);
    [[nodiscard]] static Protocol::RobotStatusUpdate MakeStatus(const RobotModel& robot);
};

} // namespace ACS::AcsSim
