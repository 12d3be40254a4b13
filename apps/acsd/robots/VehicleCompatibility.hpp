#pragma once

#include "robots/DriveCheck.hpp"
#include "robots/JobMethods.hpp"
#include <acs/core/Now.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <string>

namespace ACS::Acsd
{

/// What of the drives on the map, and of the jobs by these methods, the session's factsheet does not allow, and what to correct; a
/// sentence each. Empty: nothing, or there is no factsheet. A vehicle that can do some of its jobs is compatible.
[[nodiscard]] std::string FindIncompatibility(
    const VDA5050::MasterSession& session,
    DriveCheck& drives,
    const JobMethods& methods,
    Core::Now now);

} // namespace ACS::Acsd
