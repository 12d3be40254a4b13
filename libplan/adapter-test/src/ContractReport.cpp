#include <acs/adapter_test/ContractReport.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace ACS::AdapterTest
{

std::string Describe(const Finding& finding)
{
    const double seconds = std::chrono::duration<double>(finding.when).count();
    return fmt::format(
        "{}: {}, after {:.3f} s: {} Expected: {}",
        GetRuleName(finding.rule),
        finding.scenario,
        seconds,
        finding.happened,
        GetRuleText(finding.rule));
}

bool ContractReport::HasFinding(ERule rule) const
{
    return std::ranges::count(findings, rule, &Finding::rule) > 0;
}

std::string ContractReport::Describe() const
{
    std::string text;
    for (const Finding& finding : findings)
    {
        text += AdapterTest::Describe(finding) + "\n";
    }
    return text;
}

} // namespace ACS::AdapterTest
