#include "operator/ProcessMetrics.hpp"

#include "Catch.hpp"
#include "common/Version.hpp"
#include "ManualClock.hpp"

#include <string>

namespace ACS::Acsd::Test
{

using Catch::Matchers::Contains;

TEST_CASE("The metrics of the process have its version, its start, its CPU time and its memory")
{
    Testing::ManualClock clock;
    Apps::MetricsEndpoint endpoint;
    ProcessMetrics metrics(endpoint, clock.GetNow());
    metrics.Update();
    const std::string text = endpoint.Render();
    CHECK_THAT(text, Contains("acsd_build_info{version=\"" + std::string(Apps::VERSION) + "\"} 1\n"));
    CHECK_THAT(text, Contains("\nprocess_start_time_seconds 1751457600\n"));
    CHECK_THAT(text, Contains("\nprocess_cpu_seconds_total "));
    CHECK_THAT(text, Contains("\nprocess_resident_memory_bytes ") && !Contains("\nprocess_resident_memory_bytes 0\n"));
}

} // namespace ACS::Acsd::Test
