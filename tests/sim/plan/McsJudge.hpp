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

/// Holds what the MCS sees against the rules: each plan and control that was acknowledged, each report in its order.
class McsJudge final
{
public:
    enum class EKnowledge : std::uint8_t
    {
        Unknown, ///< Sent, and no Ack has come.
        Accepted,
        Refused,
    };

private:
    struct StepView
    {
        Protocol::EStepStatus status = Protocol::EStepStatus::Pending;
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
        std::set<std::string> sent; ///< TransactionIDs: a repetition has no result of its own.
        std::size_t acknowledged = 0;
        std::size_t results = 0;
        bool bDone = false;    ///< One of them says so.
        bool bUnknown = false; ///< Sent about a plan that was perhaps not known.
    };

    Trace& _trace;
    const CrashableStore& _store;
    const WorkChecker& _witness;
    std::map<std::string, PlanView> _plans;
    std::map<std::pair<std::string, Planning::EPlanControl>, ControlView> _controls;
    std::map<std::string, Protocol::AcsPayload> _seen;
    std::uint64_t _lastSequence = 0;
    std::map<std::string, Protocol::RobotStatusUpdate> _statuses;
    std::optional<Protocol::ETscState> _tscState;
    std::vector<Protocol::ErrorReport> _alarms;

public:
    McsJudge(Trace& trace, const CrashableStore& store, const WorkChecker& witness);

    /// A plan that will be sent; a good one is one that can be done.
    void NotePlan(const Protocol::ExecutionPlan& plan, bool bGood);
    void NotePlanSent(const std::string& planID);
    void NotePlanAck(const Protocol::AcsAck& ack);
    void NoteControlSent(Planning::EPlanControl control, const std::string& planID, const std::string& transactionID);
    void NoteControlAck(Planning::EPlanControl control, const std::string& planID, const Protocol::AcsAck& ack);

    /// Whatever acsd sends.
    void OnRequest(const Protocol::AcsRequest& request);

    /// That the disk still holds every plan that was acknowledged, and the end of each until the MCS has it.
    void CheckKept();

    [[nodiscard]] EKnowledge GetKnowledge(const std::string& planID) const;
    [[nodiscard]] std::vector<std::string> GetPaused() const;
    [[nodiscard]] const std::map<std::string, Protocol::RobotStatusUpdate>& GetStatuses() const noexcept;
    [[nodiscard]] const std::optional<Protocol::ETscState>& GetTscStateOrNull() const noexcept;
    [[nodiscard]] const std::vector<Protocol::ErrorReport>& GetAlarms() const noexcept;

    /// What is still owed to the MCS, in words; empty where nothing is.
    [[nodiscard]] std::string DescribeOwed() const;

private:
    void TakePlanReport(const Protocol::PlanReport& report);
    void TakeStepReport(const Protocol::StepReport& report);
    void TakeJobReport(const Protocol::JobReport& report);
    void TakeResult(Planning::EPlanControl control, const std::string& planID, Protocol::EReportResult result);
    void TakeAlarm(const Protocol::ErrorReport& report);
    void TakeFirst(const Protocol::AcsPayload& payload);
    [[nodiscard]] PlanView* FindReportedOrNull(const std::string& planID, std::string_view what);
    void CheckCompleted(const std::string& planID, const PlanView& plan);
};

/// Which control the command asks for, or the result tells of; nullopt for others.
[[nodiscard]] std::optional<Planning::EPlanControl> GetControlOrNull(Protocol::EAcsCommand command);

} // namespace ACS::Simulation
