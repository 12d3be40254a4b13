#pragma once

#include <acs/adapter_test/ERule.hpp>
#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>

#include <string>
#include <vector>

namespace ACS::AdapterTest
{

/// The adapter, or the robot that it commands, has broken a rule.
struct Finding
{
    ERule rule{};          ///< The rule that was broken.
    std::string scenario;  ///< What was done with the robot.
    Core::Duration when{}; ///< Virtual time since the start of the scenario.
    std::string happened;  ///< In a sentence. GetRuleText has what was expected.

    bool operator==(const Finding&) const = default;
};

/// One line: rule, scenario, time, what happened and what was expected.
[[nodiscard]] ACS_API std::string Describe(const Finding& finding);

/// The result of CheckAdapter.
struct ACS_API ContractReport
{
    /// At most one of each rule in each scenario.
    std::vector<Finding> findings;
    std::vector<std::string> scenarios; ///< Those that were run.
    std::vector<std::string> omitted;   ///< Those that the bench cannot do, each with the reason.

    /// Whether the rule was broken in any scenario.
    [[nodiscard]] bool HasFinding(ERule rule) const;
    /// Each finding in a line of its own; empty without findings.
    [[nodiscard]] std::string Describe() const;
};

} // namespace ACS::AdapterTest
