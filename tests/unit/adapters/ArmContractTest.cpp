#include "ArmBench.hpp"
#include "Catch.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

namespace ACS::Testing
{

TEST_CASE("The adapter of a vehicle with an arm over Open Stream breaks no rule")
{
    ArmBench bench(1);
    const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
    INFO(report.Describe());
    CHECK(report.findings.empty());
    CHECK(report.scenarios.size() > 60);
}

} // namespace ACS::Testing
