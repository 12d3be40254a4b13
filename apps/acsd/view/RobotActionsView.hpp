#pragma once

#include "drivers/ActionHistory.hpp"
#include <acs/acsd/RobotAction.hpp>

#include <vector>

namespace ACS::Acsd
{

/// The instant actions of a robot, as the operator sees them.
struct RobotActionsView
{
    std::vector<RobotActionRecord> actions; ///< Those that were requested last, oldest first.
    std::vector<RobotActionOffer> offered;  ///< Those that may be requested.
};

} // namespace ACS::Acsd
