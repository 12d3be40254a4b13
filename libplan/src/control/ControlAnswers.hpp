#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// The control that a plan was asked for (cancel, abort, pause, resume): repetitions, the open one, its timer and its outcome.
class ControlAnswers
{
    const EngineOptions& _options;
    PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;

public:
    explicit ControlAnswers(EngineState& engine);

    /// A transactionID is one request's of its command; another command may have the same.
    [[nodiscard]] static std::string MakeRequestID(const ControlPlan& command);
    /// Register D-23: after a crash the Ack may have been lost, and not the control.
    [[nodiscard]] bool IsRepetition(const ControlPlan& command) const;
    void Remember(PlanProgress& progress, const ControlPlan& command);
    /// A control is open from here on until Answer.
    void Ask(ActivePlan& plan, EPlanControl control);
    /// The outcome of the control that is open, if one is: once for each time that it was asked for.
    void Answer(ActivePlan& plan, bool bSucceeded, const std::string& message);
    void ReportControlResult(EPlanControl control, const std::string& planID, bool bSucceeded, std::string message);
    void StartConfirming(Robot& robot, Core::Duration limit);
    void StopConfirming(Robot& robot);
    /// What it is to confirm beside the control has its time anew: that it gives its present way up for another one.
    void StopConfirmingControl(Robot& robot);
    void LeavePause(ActivePlan& plan, std::string message);
    /// The robot's own pause ends, where the engine has asked for it.
    void ReleasePause(Robot& robot);
    /// Register D-19, D-20.
    void RefuseControl(const ControlPlan& command);
};

} // namespace ACS::Planning
