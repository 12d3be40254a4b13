#pragma once

#include "operator/RefusedOffer.hpp"
#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/PlanCommand.hpp>

#include <map>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// "Abort of plan P1", for a command of the operator.
[[nodiscard]] std::string DescribeCommand(const Planning::PlanCommand& command);

/// The commands of the operator that the engine has not replied to yet. Their number is limited by the queue of the engine's
/// host. Pure.
class OfferedCommands final
{
    struct Offer
    {
        std::string command;
        std::optional<Planning::CommandReceipt> receipt;
    };

    /// Those of the MCS count from 1.
    static constexpr Planning::ReplyToken FIRST_TOKEN = Planning::ReplyToken{1} << 63U;

    std::map<Planning::ReplyToken, Offer> _offers;
    Planning::ReplyToken _nextToken = FIRST_TOKEN;

public:
    /// Gives the command a token of its own.
    [[nodiscard]] Planning::ReplyToken Add(
        Planning::PlanCommand& command,
        const std::optional<Planning::CommandReceipt>& receiptOrNull);

    /// It has not been passed to the engine.
    void Remove(Planning::ReplyToken token);

    /// Ends the command of this reply. Returns it if it is refused.
    [[nodiscard]] std::optional<RefusedOffer> EndOrNull(const Planning::ReplyCommand& reply);
};

} // namespace ACS::Acsd
