#pragma once

#include "api/ApiTypes.hpp"
#include "view/ViewContext.hpp"

#include <string>

namespace ACS::Acsctl
{

/// The lines of `actions`: the last instant actions of a robot, and those that it offers.
[[nodiscard]] std::string PrintActions(const ActionsAnswer& answer, const ViewContext& context);

/// "initPosition of LR01: Failed: the pose is invalid"
[[nodiscard]] std::string MakeOutcomeLine(const std::string& robotID, const ActionInfo& action);

} // namespace ACS::Acsctl
