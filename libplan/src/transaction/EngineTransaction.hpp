#pragma once

#include "plan/PlanBook.hpp"
#include "robot/Robot.hpp"
#include "transaction/AlarmBook.hpp"
#include "transaction/EngineAlarm.hpp"
#include "transaction/OutboxRoom.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/ReportOutbox.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// The changes, reports, alarms, commands and timers of one engine call, in order: the one writer of all parts. Nothing is
/// undone: what depends on the store is released after the store has confirmed (CommitGate). It also has the request to
/// dispatch again in the same call, which every part may make.
class EngineTransaction
{
    Core::IRandom& _random;
    PlanBook& _plans;
    AlarmBook& _alarms;
    ReportOutbox& _outbox;
    const OutboxRoom& _room;
    std::vector<std::reference_wrapper<IPlanObserver>> _observers;
    Core::Now _now;
    std::vector<StoreChange> _changes;
    EngineActions _actions;
    bool _bDispatchNeeded = false;
    bool _bCommandAccepted = false;                ///< As the latest reply states.
    std::optional<Core::SteadyTime> _alarmQuietAt; ///< The timer AlarmQuiet runs.

public:
    EngineTransaction(
        Core::IRandom& random,
        PlanBook& plans,
        AlarmBook& alarms,
        ReportOutbox& outbox,
        const OutboxRoom& room);

    void AddObserver(IPlanObserver& observer);
    void SetNow(Core::Now now);
    [[nodiscard]] const Core::Now& GetNow() const noexcept;

    /// Adds the report to the outbox. Returns its transactionID, valid until the next report.
    std::string_view AddReport(Report report);
    void Reply(ReplyToken token, bool bAccepted, std::string message);
    /// What the latest reply states.
    [[nodiscard]] bool HasAcceptedCommand() const noexcept;
    void Command(Robot& robot, RobotCommand command);
    void StartTimer(EEngineTimer kind, const std::string& robotID, Core::Duration delay);
    void CancelTimer(EEngineTimer kind, const std::string& robotID);
    /// A line for the log, by the observers.
    void Note(const Robot& robot, const std::string& text);
    void Store(StoreChange change);
    void Store(std::vector<StoreChange> changes);

    // States change here only.
    void ChangePlan(ActivePlan& plan, EPlanState state, std::string message);
    void ChangeStep(ActivePlan& plan, EStepState state, std::string message);
    void ChangeStepAt(ActivePlan& plan, std::size_t index, EStepState state, std::string message);
    void ChangeJob(ActivePlan& plan, EJobState state, std::string message);
    void PublishRobotStatus(const RobotStatus& status);
    void PublishTscState(ETscState state, ETscState from);
    void RaiseAlarm(Alarm alarm);
    void ClearAlarm(const Alarm& alarm);
    /// Reports that AlarmBook returned.
    void ReportAlarms(const std::vector<ErrorReport>& reports);
    /// Starts the timer AlarmQuiet for what AlarmBook has delayed.
    void WatchAlarms();
    void OnAlarmQuiet();
    /// Sets ACS-1020 while plans are refused for want of room. Running plans continue and are reported.
    void WatchOutbox();

    /// Something has changed that may let a plan or a robot continue.
    void RequestDispatch() noexcept;
    [[nodiscard]] bool IsDispatchNeeded() const noexcept;
    /// True: dispatch was requested since the last time.
    [[nodiscard]] bool TryBeginDispatch() noexcept;

    /// Returns the collected changes and forgets them.
    [[nodiscard]] std::vector<StoreChange> CollectChanges();
    [[nodiscard]] EngineActions CollectActions();

private:
    /// Adds the report to the outbox; the replaced one need not be sent.
    std::string_view AddReport(Report report, std::optional<std::uint64_t> replacedOrNull);
    /// Removes the latest report of the alarm. Returns its sequence if the host may have it.
    [[nodiscard]] std::optional<std::uint64_t> RemoveReportOrNull(const Alarm& alarm);
};

} // namespace ACS::Planning
