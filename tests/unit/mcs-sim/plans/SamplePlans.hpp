#pragma once

#include "plans/PlannedPlan.hpp"
#include <acs/protocol/AcsMessage.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Testing
{

/// Two steps: CassetteLoad with one job J1, CassetteUnload with two jobs J2 and J3. The array is not in order.
inline McsSim::PlannedPlan MakeSamplePlan(const std::string& planID, const std::string& transactionID)
{
    McsSim::PlannedPlan planned;
    planned.transactionID = transactionID;
    planned.plan.planID = planID;
    planned.plan.lotID = "LOT";
    planned.plan.steps = {
        {2,
         "CassetteUnload",
         "A02.CP03",
         {"C1", "C2"},
         {{"J2", "AMR.CP01", "A02.CP03"}, {"J3", "AMR.CP02", "A02.CP03"}}},
        {1, "CassetteLoad", "A01.CP01", {"C1"}, {{"J1", "A01.CP01", "AMR.CP01"}}}};
    return planned;
}

inline Protocol::PlanReport MakePlanReport(
    const std::string& planID,
    Protocol::EPlanStatus status,
    const std::string& message = {})
{
    return {planID, status, message};
}

inline Protocol::StepReport MakeStepReport(const std::string& planID, std::int32_t stepNo, Protocol::EStepStatus status)
{
    return {planID, "LR01", stepNo, status, ""};
}

inline Protocol::JobReport MakeJobReport(
    const std::string& planID,
    std::int32_t stepNo,
    const std::string& jobID,
    Protocol::EJobStatus status)
{
    return {planID, "LR01", stepNo, jobID, status, ""};
}

inline Protocol::AcsAck MakeAck(
    const McsSim::PlannedPlan& planned,
    Protocol::EAckResult result,
    const std::string& message = {})
{
    return {
        Protocol::EAcsCommand::ExecutionPlan,
        planned.transactionID,
        {},
        result,
        message,
        Protocol::PlanAck{planned.plan.planID},
        false};
}

} // namespace ACS::Testing
