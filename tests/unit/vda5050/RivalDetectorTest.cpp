#include "RivalDetector.hpp"

#include "Catch.hpp"
#include "MosquittoError.hpp"

#include <chrono>
#include <cstddef>
#include <system_error>

namespace ACS::VDA5050
{

namespace
{

using namespace std::chrono_literals;

const std::error_code RESET = std::make_error_code(std::errc::connection_reset);

/// A connection of this duration.
RivalDetector::End Connect(RivalDetector& rivals, std::chrono::seconds duration)
{
    const RivalDetector::Time start{};
    rivals.OnUp(start);
    return rivals.OnEnd(start + duration, RESET);
}

} // namespace

TEST_CASE("Short connections in a row have a rival as their reason; attempts in vain do not count")
{
    RivalDetector rivals(false);
    CHECK_FALSE(Connect(rivals, 1s).bRival);
    CHECK_FALSE(rivals.OnEnd({}, RESET).bRival);
    CHECK_FALSE(Connect(rivals, 4s).bRival);
    CHECK_FALSE(rivals.OnEnd({}, RESET).bRival);
    const RivalDetector::End third = Connect(rivals, 2s);
    CHECK(third.bRival);
    CHECK(third.upTime == 2s);
    CHECK(Connect(rivals, 2s).bRival);
    CHECK_FALSE(rivals.OnEnd({}, RESET).bRival);
    CHECK_FALSE(Connect(rivals, RivalDetector::STABLE_AFTER).bRival);
    CHECK_FALSE(Connect(rivals, 1s).bRival);
}

TEST_CASE("MQTT 5 reports a rival at once; such a connection does not count as a short one")
{
    RivalDetector rivals(false);
    for (std::size_t connection = 0; connection < RivalDetector::SUSPICIOUS_COUNT; ++connection)
    {
        rivals.OnUp({});
        CHECK(rivals.OnEnd(RivalDetector::Time(1s), MakeConnackError(0x8E)).bRival);
    }
    CHECK_FALSE(Connect(rivals, 1s).bRival);
}

TEST_CASE("No other client can have a generated id")
{
    RivalDetector rivals(true);
    for (int connection = 0; connection < 9; ++connection)
    {
        CHECK_FALSE(Connect(rivals, 1s).bRival);
    }
}

} // namespace ACS::VDA5050
