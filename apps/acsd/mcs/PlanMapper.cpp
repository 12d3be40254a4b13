#include "mcs/PlanMapper.hpp"

#include <acs/core/Overloaded.hpp>

#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

std::optional<std::string> MakePlaceOrNull(const std::string& text)
{
    return text.empty() ? std::nullopt : std::optional<std::string>(text);
}

Planning::Plan MakePlan(const Protocol::ExecutionPlan& message)
{
    Planning::Plan plan;
    plan.planID = message.planID;
    plan.lotID = message.lotID;
    plan.priority = message.priority;
    for (const Protocol::PlanStep& from : message.steps)
    {
        Planning::Step& step = plan.steps.emplace_back();
        step.stepNo = from.stepNo;
        step.action = from.action;
        step.position = from.position;
        step.carrierIDs = from.carrierIDs;
        for (const Protocol::PlanJob& job : from.jobs)
        {
            step.jobs.push_back(Planning::Job{job.jobID, MakePlaceOrNull(job.from), MakePlaceOrNull(job.to)});
        }
    }
    return plan;
}

} // namespace

std::optional<Planning::PlanCommand> MakePlanCommandOrNull(
    const Protocol::AcsPayload& payload,
    const std::string& transactionID,
    Planning::ReplyToken replyToken)
{
    using Planning::EPlanControl;
    const auto control = [&](EPlanControl kind, const std::string& planID, std::string reason) {
        return Planning::PlanCommand(Planning::ControlPlan{kind, planID, std::move(reason), replyToken, transactionID});
    };
    return std::visit(
        Core::Overloaded{
            [&](const Protocol::ExecutionPlan& message) -> std::optional<Planning::PlanCommand> {
                return Planning::SubmitPlan{MakePlan(message), replyToken, transactionID};
            },
            [&](const Protocol::CancelPlan& message) -> std::optional<Planning::PlanCommand> {
                return control(EPlanControl::Cancel, message.planID, message.reason);
            },
            [&](const Protocol::AbortPlan& message) -> std::optional<Planning::PlanCommand> {
                return control(EPlanControl::Abort, message.planID, message.reason);
            },
            [&](const Protocol::PausePlan& message) -> std::optional<Planning::PlanCommand> {
                return control(EPlanControl::Pause, message.planID, message.reason);
            },
            [&](const Protocol::ResumePlan& message) -> std::optional<Planning::PlanCommand> {
                return control(EPlanControl::Resume, message.planID, {});
            },
            [](const auto&) -> std::optional<Planning::PlanCommand> {
                return std::nullopt;
            }},
        payload);
}

} // namespace ACS::Acsd
