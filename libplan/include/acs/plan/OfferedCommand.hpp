#pragma once

#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/PlanCommand.hpp>

#include <optional>

namespace ACS::Planning
{

/// A command, with the receipt that is stored with it unless it is refused.
struct OfferedCommand
{
    PlanCommand command;                     ///< Of the MCS or of an operator.
    std::optional<CommandReceipt> receipt{}; ///< Of an operator's command that its sender may repeat.
};

} // namespace ACS::Planning
