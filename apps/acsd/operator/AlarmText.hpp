#pragma once

#include <acs/plan/Report.hpp>

#include <string>

namespace ACS::Acsd
{

/// The alarm's message for the log and for the MCS. For an unresolved job (ACS-1008) it names the commands of acsctl that resolve the
/// job or skip its step, which the engine does not know.
[[nodiscard]] std::string MakeAlarmText(const Planning::Alarm& alarm);

} // namespace ACS::Acsd
