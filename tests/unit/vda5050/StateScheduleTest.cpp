#include "StateSchedule.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "Vda5050Sample.hpp"

#include <chrono>
#include <vector>

namespace ACS::VDA5050::Test
{

using namespace std::chrono_literals;

TEST_CASE("6.10 No state is due without a change, or without a link")
{
    const Testing::ManualClock clock;
    const VehicleOptions options;
    StateSchedule schedule(options);
    VehicleActions out;
    schedule.Request();
    CHECK_FALSE(schedule.ShouldPublish(clock.GetNow(), out));
    schedule.OnLinkUp();
    CHECK(schedule.ShouldPublish(clock.GetNow(), out));
    schedule.OnPublished(clock.GetNow(), out);
    CHECK_FALSE(schedule.ShouldPublish(clock.GetNow(), out));
    CHECK(
        Pick<StartVehicleTimer>(out)
        == std::vector{StartVehicleTimer{EVehicleTimer::MaximumStateInterval, options.maximumStateInterval}});
}

TEST_CASE("6.10 A change before the minimum interval waits for its rest, with one timer")
{
    Testing::ManualClock clock;
    VehicleOptions options;
    options.minimumStateInterval = 100ms;
    StateSchedule schedule(options);
    VehicleActions out;
    schedule.OnLinkUp();
    schedule.OnPublished(clock.GetNow(), out);
    out.clear();
    clock.Advance(30ms);
    for (int i = 0; i < 2; ++i)
    {
        schedule.Request();
        CHECK_FALSE(schedule.ShouldPublish(clock.GetNow(), out));
    }
    CHECK(out == VehicleActions{StartVehicleTimer{EVehicleTimer::MinimumStateInterval, 70ms}});

    SECTION("It is published when the timer ends")
    {
        clock.Advance(70ms);
        schedule.OnMinimumTimer();
        CHECK(schedule.ShouldPublish(clock.GetNow(), out));
        schedule.OnPublished(clock.GetNow(), out);
        CHECK(Pick<CancelVehicleTimer>(out).empty());
    }
    SECTION("A timer that is late is cancelled")
    {
        clock.Advance(70ms);
        CHECK(schedule.ShouldPublish(clock.GetNow(), out));
        schedule.OnPublished(clock.GetNow(), out);
        CHECK(Pick<CancelVehicleTimer>(out) == std::vector{CancelVehicleTimer{EVehicleTimer::MinimumStateInterval}});
    }
    SECTION("It is still due after the link was down, which ends the timer")
    {
        schedule.OnLinkDown(out);
        CHECK_FALSE(schedule.ShouldPublish(clock.GetNow(), out));
        out.clear();
        schedule.OnLinkUp();
        CHECK_FALSE(schedule.ShouldPublish(clock.GetNow(), out));
        CHECK(out == VehicleActions{StartVehicleTimer{EVehicleTimer::MinimumStateInterval, 70ms}});
    }
}

} // namespace ACS::VDA5050::Test
