#include "ArmBench.hpp"
#include "Catch.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <cstdint>

namespace ACS::Testing
{

TEST_CASE("The adapter of a vehicle with an arm over Open Stream breaks no rule", "[.long]")
{
    // Which of the two connections are lost depends on the seed.
    for (const std::uint64_t seed : {1U, 3U})
    {
        ArmBench bench(seed);
        const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
        INFO("seed " << seed << "\n" << report.Describe());
        CHECK(report.findings.empty());
        CHECK(report.scenarios.size() > 100);
    }
}

} // namespace ACS::Testing
