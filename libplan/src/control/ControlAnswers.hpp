#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Keeps the open control of each plan (Cancel, Abort, Pause, Resume), recognises repeated requests, and reports outcomes.
class ControlAnswers
{
    const EngineOptions& _options;
    PlanBook& _plans;
    Fleet& _fleet;
    const RestartHold& _hold;
    EngineTransaction& _transaction;

public:
    explicit ControlAnswers(EngineState& engine);

    /// Key of a request: a transactionID is unique among requests of the same command only.
    [[nodiscard]] static std::string MakeRequestID(const ControlPlan& command);
    /// Register D-23: the request was handled before a crash in which its Ack was lost.
    [[nodiscard]] bool IsRepetition(const ControlPlan& command) const;
    /// Remembers the request to recognise a repetition.
    void Remember(PlanProgress& progress, const ControlPlan& command);
    /// The open control and its request have no effect and no result: repeated, the request is executed.
    void Withdraw(ActivePlan& plan, const ControlPlan& command);
    /// Opens a control, until Answer.
    void Ask(ActivePlan& plan, EPlanControl control, EControlOrigin origin);
    /// "PausePlan", or "the operator": who began the open control of the plan.
    [[nodiscard]] static std::string DescribeOrigin(const ActivePlan& plan, EPlanControl control);
    /// Closes the open control, if any, and reports its outcome once per request of the MCS.
    void Answer(ActivePlan& plan, bool bSucceeded, const std::string& message);
    /// Reports an outcome without an open control.
    void ReportControlResult(EPlanControl control, const std::string& planID, bool bSucceeded, std::string message);
    /// Limits the time in which the robot must confirm a control or a reroute.
    void StartConfirming(Robot& robot, Core::Duration limit);
    void StopConfirming(Robot& robot);
    /// As StopConfirming; a pending reroute gets its full time again.
    void StopConfirmingControl(Robot& robot);
    /// A paused plan becomes InProgress, or Pending without a robot.
    void LeavePause(ActivePlan& plan, std::string message);
    /// Commands the robot to resume if the engine has paused it; during the hold of the restart, TscControl does at its end.
    void ReleasePause(Robot& robot);
    /// Why a plan that is not active cannot be controlled.
    [[nodiscard]] std::string DescribeInactive(const std::string& planID) const;
    /// Refuses a control of an unknown or finished plan (register D-19, D-20).
    void RefuseControl(const ControlPlan& command);
};

} // namespace ACS::Planning
