#include "Catch.hpp"
#include <acs/plan/LeaseTerm.hpp>
#include <acs/plan/LeaseWatch.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;

namespace
{

const Core::SteadyTime START{std::chrono::hours(1)};

LeaseState MakeState(std::uint64_t epoch, std::uint64_t renewal)
{
    return {epoch, renewal, "leader", "config", milliseconds(3'000), false};
}

} // namespace

TEST_CASE("LeaseTerm: a leader commands until the margin before the end, counted from the request of the last renewal")
{
    LeaseTerm term(milliseconds(3'000), START);
    CHECK(term.GetEnd() == START + milliseconds(2'500));
    CHECK(term.GetRenewInterval() == milliseconds(500));
    CHECK(term.IsHeld(START + milliseconds(2'499)));
    CHECK_FALSE(term.IsHeld(START + milliseconds(2'500)));
    term.OnRenewed(START + milliseconds(1'000));
    CHECK(term.IsHeld(START + milliseconds(3'499)));
    term.OnRenewed(START + milliseconds(500)); // an answer that comes late
    CHECK(term.GetEnd() == START + milliseconds(3'500));
}

TEST_CASE("LeaseWatch: a lease that was never taken, or was released, is taken at once")
{
    LeaseWatch watch("config");
    CHECK_FALSE(watch.GetSeenOrNull().has_value());
    CHECK(watch.ShouldTake({}, START));
    LeaseState released = MakeState(1, 7);
    CHECK_FALSE(watch.ShouldTake(released, START));
    released.bReleased = true;
    CHECK(watch.ShouldTake(released, START + milliseconds(1)));
}

TEST_CASE("LeaseWatch: a lease is taken when its renewal has not changed for its whole duration")
{
    LeaseWatch watch("config");
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 7), START));
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 7), START + milliseconds(2'999)));
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 8), START + milliseconds(3'000)));
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 8), START + milliseconds(5'999)));
    CHECK_FALSE(watch.ShouldTake(MakeState(2, 8), START + milliseconds(6'000))); // another standby was faster
    CHECK(watch.ShouldTake(MakeState(2, 8), START + milliseconds(9'000)));
}

TEST_CASE("LeaseWatch: a standby with another configuration takes a lease only if it was released")
{
    LeaseWatch watch("other");
    CHECK_FALSE(watch.IsOtherConfig());
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 7), START));
    CHECK(watch.IsOtherConfig());
    CHECK_FALSE(watch.ShouldTake(MakeState(1, 7), START + std::chrono::hours(1)));
    LeaseState released = MakeState(1, 7);
    released.bReleased = true;
    CHECK(watch.ShouldTake(released, START + std::chrono::hours(1)));
    CHECK_FALSE(watch.IsOtherConfig());
}

/// Two processes whose clocks differ by hours: whenever the standby takes the lease, the leader has stopped before.
TEST_CASE("LeaseWatch and LeaseTerm: never two processes that may command")
{
    constexpr milliseconds DURATION{3'000};
    constexpr std::chrono::hours APART{5};
    for (int delay = 0; delay < 1'000; delay += 100) // of the request of a renewal on its way to the store
    {
        for (int last = 0; last < 3'000; last += 250) // when the leader asks for its last renewal
        {
            LeaseTerm term(DURATION, START);
            LeaseWatch watch("config");
            bool bTaken = false;
            for (int now = 0; now < 10'000 && !bTaken; now += 50)
            {
                const Core::SteadyTime time = START + milliseconds(now);
                if (now <= last && now % 250 == 0)
                {
                    term.OnRenewed(time); // it counts from the request
                }
                const int stored =
                    std::max(std::min(now - delay, last), -250) + 250; // when the last stored one was asked for
                bTaken = watch.ShouldTake(MakeState(1, static_cast<std::uint64_t>(stored / 250)), time + APART);
                const bool bSafe = !bTaken || !term.IsHeld(time);
                REQUIRE(bSafe);
            }
            REQUIRE(bTaken);
        }
    }
}
