#include "robot/StallMonitor.hpp"

#include "Catch.hpp"

#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;

namespace
{

constexpr ACS::Core::SteadyTime START{1h};

} // namespace

TEST_CASE("StallMonitor: each node and each extension starts the timer again")
{
    StallMonitor monitor;
    CHECK(monitor.OnProgress(DriveProgress{"D1", false, 0}, 3, START).timer == EStallTimer::Start);
    CHECK(monitor.OnProgress(DriveProgress{"D1", false, 0}, 3, START + 1s).timer == EStallTimer::Unchanged);
    CHECK(monitor.GetTimeWithoutProgress(START + 5s) == 5s);
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 0}, 3, START + 2s).timer == EStallTimer::Start);
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 1}, 3, START + 3s).timer == EStallTimer::Start);
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 1}, 4, START + 4s).timer == EStallTimer::Start);
    CHECK(monitor.GetTimeWithoutProgress(START + 5s) == 1s);
}

TEST_CASE("StallMonitor: nothing is watched while no node is expected")
{
    StallMonitor monitor;
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 0}, std::nullopt, START).timer == EStallTimer::Unchanged);
    CHECK_FALSE(monitor.TryStall());
    CHECK_FALSE(monitor.IsStalled());
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 0}, 2, START).timer == EStallTimer::Start);
    CHECK(monitor.OnProgress(DriveProgress{"D1", true, 0}, std::nullopt, START).timer == EStallTimer::Cancel);
    CHECK_FALSE(monitor.TryStall());
}

TEST_CASE("StallMonitor: a stall ends with progress and not with a pause or an extension")
{
    StallMonitor monitor;
    static_cast<void>(monitor.OnProgress(DriveProgress{"D1", true, 0}, 2, START));
    CHECK(monitor.TryStall());
    CHECK(monitor.IsStalled());
    CHECK_FALSE(monitor.OnProgress(DriveProgress{"D1", true, 0}, 3, START).bStallEnded);
    CHECK_FALSE(monitor.OnProgress(DriveProgress{"D1", true, 0}, std::nullopt, START).bStallEnded);
    CHECK(monitor.IsStalled());

    SECTION("with the next node")
    {
        CHECK(monitor.OnProgress(DriveProgress{"D1", true, 1}, 3, START).bStallEnded);
    }
    SECTION("with another drive")
    {
        CHECK(monitor.OnProgress(DriveProgress{"D2", false, 0}, 3, START).bStallEnded);
    }
    SECTION("with the end of the drive, or of the connection")
    {
        CHECK(monitor.OnProgress(std::nullopt, std::nullopt, START).bStallEnded);
    }
    CHECK_FALSE(monitor.IsStalled());
}

TEST_CASE("StallMonitor: the limit is the timeout or three times the drive time of the edge")
{
    CHECK(StallMonitor::GetLimit(60s, 0) == 60s);
    CHECK(StallMonitor::GetLimit(60s, 20) == 60s);
    CHECK(StallMonitor::GetLimit(60s, 30) == 90s);
    CHECK(StallMonitor::GetLimit(60s, 1e300) == 24h);
}
