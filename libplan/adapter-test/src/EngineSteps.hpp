#pragma once

#include "ScenarioRun.hpp"

namespace ACS::AdapterTest
{

/// What the engine does with a drive or a job, as far as an adapter sees it. False: the scenario cannot continue, and there
/// is a finding.

/// Waits for the end of the job that was commanded. The rule is broken if it does not end.
[[nodiscard]] bool TryAwaitJobEnd(ScenarioRun& run, ERule rule);

/// The same, and commands the job again when it was rejected, unknown or interrupted, as the engine does.
[[nodiscard]] bool TryFinishJob(ScenarioRun& run, Planning::StartJob job, ERule rule);

/// Waits for the end of the drive that was commanded.
[[nodiscard]] bool TryAwaitDriveEnd(ScenarioRun& run, ERule rule);

/// Commands a drive to the end of the route and waits until it has arrived.
[[nodiscard]] bool TryDriveToEnd(ScenarioRun& run, ERule rule);

/// Waits until the robot drives.
[[nodiscard]] bool TryAwaitDriving(ScenarioRun& run);

/// The robot was commanded to do nothing further: waits, and verifies what is reported.
void VerifyAtRest(ScenarioRun& run);

} // namespace ACS::AdapterTest
