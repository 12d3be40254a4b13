#include "operator/OfferedCommands.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace ACS::Acsd
{

std::string DescribeCommand(const Planning::PlanCommand& command)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::SubmitPlan& typed) { return "Submission of plan " + typed.plan.planID; },
            [](const Planning::ControlPlan& typed) {
                return fmt::format("{} of plan {}", GetText(typed.control), typed.planID);
            },
            [](const Planning::MessageAcknowledged&) { return std::string("Acknowledgement of a report"); },
            [](const Planning::ControlTSC& typed) {
                return fmt::format("{} of the TSC", typed.bPause ? "Pause" : "Resume");
            },
            [](const Planning::ResolveJob& typed) {
                return fmt::format("Resolution of job {} of plan {}", typed.jobID, typed.planID);
            },
            [](const Planning::SetMaintenance& typed) {
                return fmt::format("Maintenance {} of {}", typed.bOn ? "on" : "off", typed.robotID);
            },
            [](const Planning::ClearAlarms& typed) {
                return fmt::format("Clearing of alarm {} of {}", typed.errorCode, typed.robotID);
            },
            [](const Planning::SetCarriers& typed) { return "Correction of the ports of " + typed.robotID; },
            [](const Planning::SkipStep& typed) {
                return fmt::format("Skip of step {} of plan {}", typed.stepNo, typed.planID);
            },
            [](const Planning::SetPlanPriority& typed) {
                return fmt::format("Priority {} of plan {}", typed.priority, typed.planID);
            },
            [](const Planning::BlockPlace& typed) {
                return fmt::format("Block of {} {}", GetText(typed.kind), typed.id);
            },
            [](const Planning::UnblockPlace& typed) {
                return fmt::format("Unblock of {} {}", GetText(typed.kind), typed.id);
            }},
        command);
}

Planning::ReplyToken OfferedCommands::Add(
    Planning::PlanCommand& command,
    const std::optional<Planning::CommandReceipt>& receiptOrNull)
{
    const Planning::ReplyToken token = _nextToken++;
    std::visit(
        Core::Overloaded{
            [](Planning::MessageAcknowledged&) { /* has no reply */ },
            [token](auto& typed) {
                typed.replyToken = token;
            }},
        command);
    _offers.emplace(token, Offer{DescribeCommand(command), receiptOrNull});
    return token;
}

void OfferedCommands::Remove(Planning::ReplyToken token)
{
    _offers.erase(token);
}

std::optional<RefusedOffer> OfferedCommands::EndOrNull(const Planning::ReplyCommand& reply)
{
    auto ended = _offers.extract(reply.replyToken);
    if (ended.empty() || reply.bAccepted)
    {
        return std::nullopt;
    }
    Offer& offer = ended.mapped();
    return RefusedOffer{std::move(offer.command), reply.message, std::move(offer.receipt)};
}

} // namespace ACS::Acsd
