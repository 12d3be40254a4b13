#pragma once

#include "replay/CoreInput.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/PlanCommand.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// JSON of a command of the operator, with its receipt.
[[nodiscard]] std::string EncodeOffer(const OfferInput& offer);

/// Reads what EncodeOffer wrote. Accepts any text.
[[nodiscard]] Core::Result<OfferInput> DecodeOffer(std::string_view text);

/// Of the plan and the robot that the command is about; empty: none.
[[nodiscard]] std::string FindPlanID(const Planning::PlanCommand& command);
[[nodiscard]] std::string FindRobotID(const Planning::PlanCommand& command);

} // namespace ACS::Acsd
