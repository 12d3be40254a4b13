#pragma once

#include <acs/plan/Report.hpp>

#include <string>

namespace ACS::Acsd
{

/// The alarm's message as people read it, in the log, in /status and at the MCS: where it waits for an answer (ACS-1008), with
/// the requests that answer it or skip the step (OperatorRoutes). The engine knows of no HTTP.
[[nodiscard]] std::string MakeAlarmText(const Planning::Alarm& alarm);

} // namespace ACS::Acsd
