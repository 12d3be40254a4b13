#include "Catch.hpp"
#include "SeededRandom.hpp"
#include <acs/core/Backoff.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using ACS::Core::Backoff;
using ACS::Core::BackoffOptions;
using ACS::Testing::SeededRandom;
using std::chrono::milliseconds;

namespace
{

/// Always the largest number: the maximum jitter.
class LargestRandom final : public ACS::Core::IRandom
{
public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return std::numeric_limits<std::uint64_t>::max();
    }
};

std::vector<milliseconds> TakeDelays(Backoff& backoff, std::size_t count)
{
    SeededRandom random;
    std::vector<milliseconds> delays(count);
    std::ranges::generate(delays, [&backoff, &random] { return backoff.GetNextDelay(random); });
    return delays;
}

} // namespace

TEST_CASE("1 Delays between connection attempts double from 0.5 s to 10 s")
{
    BackoffOptions options;
    options.jitter = 0.0;
    Backoff backoff(options);

    const std::vector<milliseconds> expected{
        milliseconds(500),
        milliseconds(1'000),
        milliseconds(2'000),
        milliseconds(4'000),
        milliseconds(8'000),
        milliseconds(10'000),
        milliseconds(10'000)};
    CHECK(TakeDelays(backoff, 7) == expected);

    backoff.Reset();
    CHECK(TakeDelays(backoff, 1).front() == milliseconds(500));
}

TEST_CASE("1 Jitter shortens a delay by at most its fraction and never lengthens it")
{
    BackoffOptions options;
    options.factor = 1.0;
    options.jitter = 0.25;
    Backoff backoff(options);

    const std::vector<milliseconds> delays = TakeDelays(backoff, 1'000);
    const auto [shortest, longest] = std::ranges::minmax_element(delays);
    CHECK(*shortest >= milliseconds(375));
    CHECK(*shortest <= milliseconds(380));
    CHECK(*longest <= milliseconds(500));
    CHECK(*longest >= milliseconds(495));
}

TEST_CASE("1 A delay is never zero, even with full jitter")
{
    LargestRandom random;
    Backoff backoff(BackoffOptions{milliseconds(1), milliseconds(10), 2.0, 1.0});
    CHECK(backoff.GetNextDelay(random) == milliseconds(1));
}

TEST_CASE("1 Invalid options are replaced by the nearest valid ones")
{
    constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    Backoff shrinking(BackoffOptions{milliseconds(-5), milliseconds(-10), 0.1, -1.0});
    CHECK(TakeDelays(shrinking, 2) == std::vector<milliseconds>{milliseconds(1), milliseconds(1)});

    Backoff undefined(BackoffOptions{milliseconds(100), milliseconds(200), NOT_A_NUMBER, NOT_A_NUMBER});
    CHECK(TakeDelays(undefined, 2) == std::vector<milliseconds>{milliseconds(100), milliseconds(100)});

    const milliseconds day = std::chrono::hours(24);
    Backoff endless(
        BackoffOptions{milliseconds(-5), milliseconds::max(), std::numeric_limits<double>::infinity(), 0.0});
    CHECK(TakeDelays(endless, 3) == std::vector<milliseconds>{milliseconds(1), day, day});
    Backoff late(BackoffOptions{milliseconds::max(), milliseconds(1), 2.0, 0.0});
    CHECK(TakeDelays(late, 2) == std::vector<milliseconds>{day, day});

    Backoff huge(BackoffOptions{milliseconds(100), milliseconds(200), 1e300, 0.0});
    CHECK(TakeDelays(huge, 3) == std::vector<milliseconds>{milliseconds(100), milliseconds(200), milliseconds(200)});
}
