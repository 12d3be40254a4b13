#include "Catch.hpp"
#include "VehicleBench.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

namespace ACS::Testing
{

TEST_CASE("The adapter of a VDA5050 vehicle breaks no rule when its own connection to the broker is lost")
{
    VehicleBench bench(VehicleBench::ELink::OfAdapter);
    const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
    INFO(report.Describe());
    CHECK(report.findings.empty());
    CHECK(report.scenarios.size() > 150);
}

TEST_CASE("The adapter of a VDA5050 vehicle breaks no rule when the vehicle's connection to the broker is lost")
{
    VehicleBench bench(VehicleBench::ELink::OfVehicle);
    const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
    INFO(report.Describe());
    CHECK(report.findings.empty());
    CHECK(report.scenarios.size() > 150);
}

} // namespace ACS::Testing
