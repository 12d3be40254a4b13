#pragma once

#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/WaitReasons.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Accepts and refuses plans.
class PlanSubmission
{
    const EngineOptions& _options;
    const PlanAdmission& _admission;
    PlanBook& _plans;
    const Fleet& _fleet;
    const ReportOutbox& _outbox;
    EngineTransaction& _transaction;
    CallRecord& _call;
    const TscControl& _tsc;
    const Dispatcher& _dispatcher;
    const WaitReasons& _waits;
    std::vector<std::string> _unreported; ///< Accepted, PlanReport(Pending) not sent.

public:
    PlanSubmission(EngineState& engine, const TscControl& tsc, const Dispatcher& dispatcher, const WaitReasons& waits);

    void Submit(const SubmitPlan& command);
    /// Register D-24. Not with the reply: a plan that cannot be stored is refused, and must not have been reported.
    void ReportAccepted();

private:
    [[nodiscard]] Core::Result<ResolvedPlan> Admit(const Plan& plan) const;
    /// Register D-23: the same request again, whose Ack may have been lost in a crash. The plan's steps are sorted.
    [[nodiscard]] bool IsRepetition(const Plan& plan, const std::string& transactionID) const;
};

} // namespace ACS::Planning
