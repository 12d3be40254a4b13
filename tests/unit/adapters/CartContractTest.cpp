#include "CartBench.hpp"
#include "Catch.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

namespace ACS::Testing
{

TEST_CASE("The adapter of examples/own-driver breaks no rule")
{
    CartBench bench;
    const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
    INFO(report.Describe());
    CHECK(report.findings.empty());
    CHECK(report.scenarios.size() > 120);
}

} // namespace ACS::Testing
