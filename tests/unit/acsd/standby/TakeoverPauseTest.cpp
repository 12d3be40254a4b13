#include "standby/TakeoverPause.hpp"

#include "Catch.hpp"

#include <chrono>

namespace ACS::Acsd::Test
{

TEST_CASE("TakeoverPause: none after the first fault, then twice as long each time, up to a limit")
{
    constexpr std::chrono::seconds LEASE{3};
    TakeoverPause pause;
    Core::SteadyTime now{std::chrono::hours(1)};
    for (const int expected : {0, 3, 6, 12, 24, 30, 30})
    {
        CHECK(pause.OnFault(now, LEASE) == std::chrono::seconds(expected));
        now += std::chrono::seconds(expected);
    }
    CHECK(pause.OnFault(now + TakeoverPause::MEMORY, LEASE) == std::chrono::seconds(0));
    CHECK(TakeoverPause().OnFault(now, std::chrono::minutes(1)) == std::chrono::seconds(0));
}

TEST_CASE("TakeoverPause: it is never shorter than a lease")
{
    constexpr std::chrono::minutes LEASE{1};
    TakeoverPause pause;
    const Core::SteadyTime now{std::chrono::hours(1)};
    CHECK(pause.OnFault(now, LEASE) == std::chrono::seconds(0));
    CHECK(pause.OnFault(now, LEASE) == LEASE);
    CHECK(pause.OnFault(now, LEASE) == LEASE);
}

} // namespace ACS::Acsd::Test
