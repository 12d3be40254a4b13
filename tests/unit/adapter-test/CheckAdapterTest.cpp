#include "Catch.hpp"
#include "ReferenceAdapter.hpp"
#include "ReferenceBench.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>

namespace ACS::Testing
{

TEST_CASE("The reference adapter breaks no rule, and every scenario is run")
{
    ReferenceBench bench([] { return std::make_unique<ReferenceAdapter>(); });
    const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
    INFO(report.Describe());
    CHECK(report.findings.empty());
    CHECK(report.omitted.empty());
    CHECK(report.scenarios.size() > 100);
}

TEST_CASE("The page for authors of adapters lists each rule with the same name and text, in the same order")
{
    std::ifstream file(ACS_ADAPTER_PAGE);
    std::stringstream page;
    page << file.rdbuf();
    std::string table = "| Rule | Contract |\n|---|---|\n";
    for (const AdapterTest::ERule rule : AdapterTest::ALL_RULES)
    {
        table += fmt::format("| `{}` | {} |\n", GetRuleName(rule), GetRuleText(rule));
    }
    CHECK(page.str().find(table + "\n") != std::string::npos);
}

} // namespace ACS::Testing
