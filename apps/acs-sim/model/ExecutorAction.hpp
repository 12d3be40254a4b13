#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <string>
#include <variant>
#include <vector>

namespace ACS::AcsSim
{

/// A report that must reach the MCS.
struct SendReport
{
    Protocol::AcsPayload payload;
};

/// A state of which only the latest matters.
struct SendStatus
{
    Protocol::AcsPayload payload;
};

/// The Ack of a request of the MCS.
struct SendAnswer
{
    Protocol::EAcsCommand command = Protocol::EAcsCommand::ExecutionPlan;
    std::string transactionID;
    Protocol::EAckResult result = Protocol::EAckResult::Success;
    std::string message;
    Protocol::AckPayload payload;
};

/// A plan has reached its final status, which was reported before.
struct PlanEnded
{
    std::string planID;
    Protocol::EPlanStatus status = Protocol::EPlanStatus::Completed;
};

/// To be carried out in order.
using ExecutorAction = std::variant<SendReport, SendStatus, SendAnswer, PlanEnded>;
using ExecutorActions = std::vector<ExecutorAction>;

} // namespace ACS::AcsSim
