#include "StreamMeter.hpp"

#include "Catch.hpp"
#include <acs/openstream/JointStepLimiter.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

/// Samples that arrive when they were taken.
class Feed
{
    ACS::Core::SteadyTime _now;
    double _ts = 0.0;

public:
    StreamMeter meter;

    std::uint64_t Add(double serverGap, std::chrono::microseconds arrivalGap)
    {
        _ts += serverGap;
        _now += arrivalGap;
        return meter.Add(_ts, _now);
    }
};

std::vector<double> Limit(JointStepLimiter& limiter, const std::vector<double>& wanted)
{
    const auto point = limiter.Limit(wanted);
    return {point.begin(), point.end()};
}

} // namespace

TEST_CASE("11 Mean, largest gap and percentiles, of the controller and of the arrivals")
{
    Feed feed;
    feed.meter.Begin(2ms);
    feed.Add(2.0, 2ms);
    for (int count = 0; count < 990; ++count)
    {
        feed.Add(2.0, 2ms);
    }
    for (int count = 0; count < 9; ++count)
    {
        feed.Add(4.0, 5ms);
    }
    CHECK(feed.Add(100.0, 101ms) == 49);
    const StreamQuality quality = feed.meter.GetQuality();
    CHECK(quality.samples == 1001);
    CHECK(quality.missing == 9 + 49);
    CHECK(quality.byServer.count == 1000);
    CHECK(quality.byServer.mean == Approx((990 * 2.0 + 9 * 4.0 + 100.0) / 1000));
    CHECK(quality.byServer.p50 == Approx(2.0).epsilon(1.0 / 16));
    CHECK(quality.byServer.p99 == Approx(2.0).epsilon(1.0 / 16));
    CHECK(quality.byServer.p999 == Approx(4.0).epsilon(1.0 / 16));
    CHECK(quality.byServer.largest == 100.0);
    CHECK(quality.byArrival.p999 == Approx(5.0).epsilon(1.0 / 16));
    CHECK(quality.byArrival.largest == 101.0);
}

TEST_CASE("11 A percentile is never below the true one, over nine orders of magnitude")
{
    double gap = 0.001;
    for (int step = 0; step < 65; ++step)
    {
        gap *= 1.37;
        INFO(gap);
        GapHistogram histogram;
        histogram.Add(gap);
        histogram.Add(gap * 1000.0);
        const GapStatistics figures = histogram.GetStatistics();
        CHECK(figures.p50 >= gap - 0.0006);
        CHECK(figures.p50 <= gap * (1.0 + 1.0 / 16) + 0.0006);
        CHECK(figures.p99 == figures.largest);
    }
    GapHistogram histogram;
    histogram.Add(-1.0);
    histogram.Add(std::numeric_limits<double>::quiet_NaN());
    CHECK(histogram.GetStatistics() == GapStatistics{});
    histogram.Add(1e30);
    CHECK(histogram.GetStatistics().largest == 1e30);
}

TEST_CASE("7.46 One missing frame among a hundred thousand shows in the quality")
{
    Feed feed;
    feed.meter.Begin(2ms);
    for (int count = 0; count < 99'999; ++count)
    {
        CHECK(feed.Add(2.0, 2ms) == 0);
    }
    CHECK(feed.meter.GetQuality().missing == 0);
    CHECK(feed.Add(4.0, 4ms) == 1);
    CHECK(feed.meter.GetQuality().missing == 1);
}

TEST_CASE("11 A sample that is only late hides no other one and is not counted as missing")
{
    Feed feed;
    feed.meter.Begin(2ms);
    feed.Add(0.0, 0ms);
    for (const double gap : {2.0, 2.0, 3.0, 1.0, 2.0})
    {
        CHECK(feed.Add(gap, 2ms) == 0);
    }
    CHECK(feed.meter.GetQuality().missing == 0);
    CHECK(feed.Add(2.0, 2ms) == 0);
    CHECK(feed.Add(5.0, 5ms) == 1); // one is missing, and the next one is late
    CHECK(feed.Add(1.0, 1ms) == 0);
    CHECK(feed.Add(3.0, 3ms) == 0); // late, and the one after the next is missing
    CHECK(feed.Add(3.0, 3ms) == 1);
    CHECK(feed.meter.GetQuality().missing == 2);
    for (int count = 0; count < 1'000; ++count)
    {
        const double late = count % 5 * 0.3; // up to 1.2 ms
        const double lateBefore = (count + 4) % 5 * 0.3;
        CHECK(feed.Add(2.0 + late - (count == 0 ? 0.0 : lateBefore), 2ms) == 0);
    }
    CHECK(feed.meter.GetQuality().missing == 2);
}

TEST_CASE("11 A controller whose clock or period is off by 1 % loses no sample by it, and a lost one is counted")
{
    const double gap = GENERATE(1.98, 2.02);
    const bool bWhole = GENERATE(false, true); // `ts` in whole ms
    StreamMeter meter;
    meter.Begin(2ms);
    constexpr int SAMPLES = 10'000;
    constexpr int LOST = 1'000;  // every thousandth
    constexpr int LOST_AT = 510; // where whole ms do not hide half a period
    for (int count = 0; count < SAMPLES; ++count)
    {
        const double ts = gap * count;
        meter.Add(bWhole ? std::floor(ts) : ts, ACS::Core::SteadyTime{});
    }
    CHECK(meter.GetQuality().missing == 0);
    for (int count = SAMPLES; count < 2 * SAMPLES; ++count)
    {
        const double ts = gap * count;
        if (count % LOST != LOST_AT)
        {
            meter.Add(bWhole ? std::floor(ts) : ts, ACS::Core::SteadyTime{});
        }
    }
    CHECK(meter.GetQuality().missing == SAMPLES / LOST);
}

TEST_CASE("11 A controller that is much slower than the period counts as missing, at most what is short of the period")
{
    StreamMeter meter;
    meter.Begin(10ms);
    constexpr int SAMPLES = 10'000;
    for (int count = 0; count <= SAMPLES; ++count)
    {
        meter.Add(11.0 * count, ACS::Core::SteadyTime{});
    }
    CHECK(meter.GetQuality().missing > 0);
    CHECK(meter.GetQuality().missing <= SAMPLES / 10);
    meter.Begin(10ms);
    for (int count = 0; count <= SAMPLES; ++count)
    {
        meter.Add(20.0 * count, ACS::Core::SteadyTime{});
    }
    CHECK(meter.GetQuality().missing == SAMPLES);
}

TEST_CASE("11 After a step of the clock the samples are measured against the new time")
{
    Feed feed;
    feed.meter.Begin(2ms);
    feed.Add(100.0, 0ms);
    CHECK(feed.Add(-50.0, 2ms) == 0);
    CHECK(feed.Add(2.0, 2ms) == 0);
    CHECK(feed.Add(4.0, 4ms) == 1);
    CHECK(feed.Add(1e9, 2ms) == 0);
    CHECK(feed.Add(3.0, 3ms) == 0);
    CHECK(feed.Add(3.0, 3ms) == 1);
    CHECK(feed.meter.Add(std::numeric_limits<double>::infinity(), {}) == 0);
    CHECK(feed.meter.Add(std::numeric_limits<double>::infinity(), {}) == 0);
    CHECK(feed.meter.Add(10.0, {}) == 0);
    CHECK(feed.meter.Add(14.0, {}) == 1);
}

TEST_CASE("11 The share of samples in time is of the last hundred periods")
{
    Feed feed;
    feed.meter.Begin(10ms);
    CHECK(feed.meter.GetQuality().inTime == 1.0);
    for (int count = 0; count < 200; ++count)
    {
        feed.Add(10.0, 10ms);
    }
    CHECK(feed.meter.GetQuality().inTime == 1.0);
    feed.Add(10.0, 15ms); // half a period late is in time
    CHECK(feed.meter.GetQuality().inTime == 1.0);
    feed.Add(10.0, 16ms);
    CHECK(feed.meter.GetQuality().inTime == Approx(0.99));
    feed.Add(40.0, 40ms); // three are missing, the next one is there
    CHECK(feed.meter.GetQuality().inTime == Approx(0.96));
    for (int count = 0; count < 100; ++count)
    {
        feed.Add(10.0, 10ms);
    }
    CHECK(feed.meter.GetQuality().inTime == 1.0);
    feed.Add(100'000.0, 100'000ms);
    CHECK(feed.meter.GetQuality().inTime == Approx(0.01));
    CHECK(feed.Add(-5.0, 10ms) == 0);
    CHECK(feed.Add(1e12, 10ms) == 0); // another clock
}

TEST_CASE("11 A joint moves no further from one point to the next than its limit, and catches up")
{
    JointStepLimiter limiter({1.0, 0.0, std::numeric_limits<double>::infinity()});
    limiter.Begin(std::array{10.0, 20.0, 30.0});
    CHECK(Limit(limiter, {10.5, 20.0, 300.0}) == std::vector<double>{10.5, 20.0, 300.0});
    CHECK_FALSE(limiter.WasLimited());
    CHECK(Limit(limiter, {13.0, 21.0, -300.0}) == std::vector<double>{11.5, 20.0, -300.0});
    CHECK(limiter.WasLimited());
    CHECK(Limit(limiter, {13.0, 20.0, 0.0}) == std::vector<double>{12.5, 20.0, 0.0});
    CHECK(Limit(limiter, {13.0, 20.0, 0.0}) == std::vector<double>{13.0, 20.0, 0.0});
    CHECK_FALSE(limiter.WasLimited());
    CHECK(Limit(limiter, {-100.0, 20.0, 0.0}) == std::vector<double>{12.0, 20.0, 0.0});
    limiter.Begin(std::array{-99.5, 20.0, 0.0});
    CHECK(Limit(limiter, {-100.0, 20.0, 0.0}) == std::vector<double>{-100.0, 20.0, 0.0});
}

TEST_CASE("11 A position or limit that is not a number switches no limit off")
{
    constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN();
    JointStepLimiter limiter({1.0, NO_NUMBER});
    limiter.Begin(std::array{NO_NUMBER, 20.0});
    const std::vector<double> point = Limit(limiter, {50.0, 25.0});
    CHECK(std::isnan(point[0]));
    CHECK(point[1] == 20.0);
    CHECK(limiter.WasLimited());
    limiter.Begin(std::array{10.0, 20.0});
    CHECK(Limit(limiter, {50.0, 20.0}) == std::vector<double>{11.0, 20.0});
}

TEST_CASE("11 A value that is not a number moves no joint, and a first point without a position is accepted")
{
    constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN();
    JointStepLimiter limiter({1.0, 1.0});
    CHECK(Limit(limiter, {50.0, NO_NUMBER}) == std::vector<double>{50.0, 0.0});
    CHECK(limiter.WasLimited());
    CHECK(Limit(limiter, {NO_NUMBER, 0.5}) == std::vector<double>{50.0, 0.5});
    CHECK(Limit(limiter, {std::numeric_limits<double>::infinity(), 5.0}) == std::vector<double>{50.0, 1.5});
    CHECK(Limit(limiter, {50.0}).size() == 1);
}

TEST_CASE("11 A joint that a shorter point leaves out keeps its position and its limit")
{
    JointStepLimiter limiter({1.0, 1.0});
    limiter.Begin(std::array{0.0, 0.0});
    CHECK(Limit(limiter, {0.0}) == std::vector<double>{0.0});
    CHECK_FALSE(limiter.WasLimited());
    CHECK(Limit(limiter, {0.0, 90.0}) == std::vector<double>{0.0, 1.0});
    CHECK(limiter.WasLimited());
}
