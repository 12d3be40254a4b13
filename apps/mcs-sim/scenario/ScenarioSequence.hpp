#pragma once

#include "scenario/ScenarioRunner.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// What came of a scenario.
struct ScenarioResult
{
    std::string name;
    std::vector<StepVerdict> verdicts;
    bool bHeld = false;
};

/// The scenarios of a run, one after the other. Pure, as the runner of each.
class ScenarioSequence
{
    std::vector<std::unique_ptr<ScenarioRunner>> _runners;
    PlanRefresher _refresher;
    std::size_t _index = 0;
    bool _bStarted = false;
    bool _bRegistered = false;

public:
    /// The random source outlives the sequence.
    ScenarioSequence(std::vector<Scenario> scenarios, Core::IRandom& random, PlanRefresher refresher);
    ScenarioSequence(const ScenarioSequence&) = delete; // the runners know the refresher
    ScenarioSequence& operator=(const ScenarioSequence&) = delete;
    ~ScenarioSequence() = default;

    void Start(Core::Now now, ScenarioActions& out);
    void OnRegistered(Core::Now now, ScenarioActions& out);
    void OnLinkLost();
    void OnMessage(std::string_view text, Core::Now now, ScenarioActions& out);
    void OnTimer(Core::Now now, ScenarioActions& out);
    void OnSendFailed(Core::Now now, ScenarioActions& out);

    /// Also where there are no scenarios.
    [[nodiscard]] bool IsFinished() const noexcept;
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] std::vector<ScenarioResult> GetResults() const;
    [[nodiscard]] bool HasHeld() const;

private:
    /// Calls the runner whose turn it is, and begins the next one where that has ended it.
    void Run(const std::function<void(ScenarioRunner&)>& call, Core::Now now, ScenarioActions& out);
};

} // namespace ACS::McsSim
