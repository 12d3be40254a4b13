#pragma once

#include "CrashableStore.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"
#include <acs/plan/EPlanControl.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

/// Checks what the MCS receives against the rules: acknowledged plans and controls, and the order of the reports.
class McsJudge final
{
public:
    enum class EKnowledge : std::uint8_t
    {
        Unknown, ///< Sent, without an Ack so far.
        Accepted,
        Refused,
    };

private:
    struct StepView
    {
        Protocol::EStepStatus status = Protocol::EStepStatus::Pending;
        std::string robotID; ///< Of the latest report.
        std::map<std::string, Protocol::EJobStatus> jobs;
    };

    struct PlanView
    {
        bool bGood = true;
        std::size_t sent = 0;
        EKnowledge knowledge = EKnowledge::Unknown;
        Protocol::EPlanStatus status = Protocol::EPlanStatus::Pending;
        std::map<std::int32_t, StepView> steps;
    };

    struct ControlView
    {
        std::set<std::string> sent;    ///< TransactionIDs: a repetition has no result of its own.
        std::set<std::string> refused; ///< Of these, the ones that were last answered with Fail.
        std::size_t acknowledged = 0;
        std::size_t results = 0;
        bool bDone = false;    ///< One of them reports success.
        bool bUnknown = false; ///< Sent when the plan was perhaps unknown to acsd.
    };

    Trace& _trace;
    const CrashableStore& _store;
    const WorkChecker& _workChecker;
    std::map<std::string, PlanView> _plans;
    std::map<std::pair<std::string, Planning::EPlanControl>, ControlView> _controls;
    std::set<std::string> _controlledByOperator;
    std::set<std::string> _failedByOperator; ///< Plans.
    std::map<std::string, Protocol::AcsPayload> _seen;
    std::uint64_t _lastSequence = 0;
    std::map<std::string, Protocol::RobotStatusUpdate> _statuses;
    std::optional<Protocol::ETscState> _tscState;
    std::vector<Protocol::ErrorReport> _alarms;

public:
    McsJudge(Trace& trace, const CrashableStore& store, const WorkChecker& workChecker);

    /// The plan will be sent; a good one can be done.
    void NotePlan(const Protocol::ExecutionPlan& plan, bool bGood);
    void NotePlanSent(const std::string& planID);
    void NotePlanAck(const Protocol::AcsAck& ack);
    /// The operator resolves a job of the plan as failed: the plan may fail without a JobReport(Failed).
    void NoteFailedByOperator(const std::string& planID);
    /// The operator may end the plan, so its end is no effect of a control of the MCS.
    void NoteControlledByOperator(const std::string& planID);
    void NoteControlSent(Planning::EPlanControl control, const std::string& planID, const std::string& transactionID);
    void NoteControlAck(Planning::EPlanControl control, const std::string& planID, const Protocol::AcsAck& ack);

    /// Every message of acsd.
    void OnRequest(const Protocol::AcsRequest& request);

    /// Checks that the disk has every acknowledged plan, and its end until the MCS has it.
    void CheckKept();

    [[nodiscard]] EKnowledge GetKnowledge(const std::string& planID) const;
    [[nodiscard]] std::vector<std::string> GetPaused() const;
    [[nodiscard]] const std::map<std::string, Protocol::RobotStatusUpdate>& GetStatuses() const noexcept;
    [[nodiscard]] const std::optional<Protocol::ETscState>& GetTscStateOrNull() const noexcept;
    [[nodiscard]] const std::vector<Protocol::ErrorReport>& GetAlarms() const noexcept;

    /// What the MCS still waits for, as text; empty: nothing.
    [[nodiscard]] std::string DescribeOwed() const;

private:
    void OnPlanReport(const Protocol::PlanReport& report);
    void OnStepReport(const Protocol::StepReport& report);
    void OnJobReport(const Protocol::JobReport& report);
    [[nodiscard]] std::string DescribeOwedResults() const;
    void OnResult(Planning::EPlanControl control, const std::string& planID, Protocol::EReportResult result);
    void OnAlarm(const Protocol::ErrorReport& report);
    void HandleFirst(const Protocol::AcsPayload& payload);
    [[nodiscard]] PlanView* FindReportedOrNull(const std::string& planID, std::string_view what);
    void CheckCompleted(const std::string& planID, const PlanView& plan);
    void CheckFailed(const std::string& planID, const PlanView& plan);
};

/// The control of the command or of the result; nullopt: another message.
[[nodiscard]] std::optional<Planning::EPlanControl> GetControlOrNull(Protocol::EAcsCommand command);

} // namespace ACS::Simulation
