#pragma once

#include "ScenarioRun.hpp"

#include <string>
#include <vector>

namespace ACS::AdapterTest
{

/// One scenario of the suite.
struct Scenario
{
    using Steps = void (*)(ScenarioRun& run);

    std::string name;
    /// Connected: the robot is connected and has reported its state when the steps begin.
    Steps steps = nullptr;
    bool BenchOptions::*needed = nullptr; ///< Null: every bench can do it.
    const char* reason = "";              ///< Why it is omitted otherwise.
};

void AddDriveScenarios(std::vector<Scenario>& scenarios);
void AddControlScenarios(std::vector<Scenario>& scenarios);
void AddJobScenarios(std::vector<Scenario>& scenarios);
void AddLinkScenarios(std::vector<Scenario>& scenarios);
void AddRestartScenarios(std::vector<Scenario>& scenarios);

/// Where the adapter is disturbed during a drive or a job: after this time, for that time.
struct Disturbance
{
    Core::Duration after{};
    Core::Duration lasts{};
};

/// The link is lost at each point.
void LoseLinkInJob(ScenarioRun& run, const Disturbance& disturbance);
void LoseLinkInDrive(ScenarioRun& run, const Disturbance& disturbance);
/// The ACS crashes at each point.
void CrashInJob(ScenarioRun& run, const Disturbance& disturbance);
void CrashInDrive(ScenarioRun& run, const Disturbance& disturbance);

} // namespace ACS::AdapterTest
