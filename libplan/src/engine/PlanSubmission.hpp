#pragma once

#include "control/TscControl.hpp"
#include "dispatch/WaitReasons.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Accepts or refuses submitted plans. Owns the list of accepted plans whose PlanReport(Pending) is not sent.
class PlanSubmission
{
    const EngineOptions& _options;
    const PlanAdmission& _admission;
    PlanBook& _plans;
    const Fleet& _fleet;
    const ReportOutbox& _outbox;
    OutboxRoom& _room;
    EngineTransaction& _transaction;
    CallRecord& _call;
    StoreBacklog& _backlog;
    const TscControl& _tsc;
    const WaitReasons& _waits;
    std::vector<std::string> _unreported; ///< Accepted, PlanReport(Pending) not sent.

public:
    PlanSubmission(EngineState& engine, const TscControl& tsc, const WaitReasons& waits);

    /// Checks the plan, stores and queues it, and replies.
    void Submit(const SubmitPlan& command);
    /// Register D-24: reports accepted plans as Pending. In a later call than the reply, because a plan that cannot be stored is
    /// refused and must not have been reported.
    void ReportAccepted();

private:
    [[nodiscard]] Core::Result<ResolvedPlan> Admit(const Plan& plan);
    /// Register D-23: a repeated request whose Ack was lost in a crash. The steps of the plan must be sorted.
    [[nodiscard]] bool IsRepetition(const Plan& plan, const std::string& transactionID) const;
};

} // namespace ACS::Planning
