#pragma once

#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/PlanCommand.hpp>

#include <optional>

namespace ACS::Planning
{

/// A command, with the receipt that is stored with it unless it is refused.
struct OfferedCommand
{
    PlanCommand command;
    std::optional<CommandReceipt> receipt{};
};

} // namespace ACS::Planning
