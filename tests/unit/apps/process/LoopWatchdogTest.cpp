#include "common/process/LoopWatchdog.hpp"

#include "Catch.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <chrono>
#include <vector>

namespace Apps = ACS::Apps;
namespace Core = ACS::Core;
using namespace std::chrono_literals;

TEST_CASE("A blocked loop is reported with the duration, as soon as it continues")
{
    boost::asio::io_context context;
    std::vector<Core::Duration> stalls;
    Apps::LoopWatchdog watchdog(
        context.get_executor(),
        {300ms, {}},
        {[&](Core::Duration stall) {
             stalls.push_back(stall);
             context.stop();
         },
         nullptr});
    watchdog.Start();
    boost::asio::post(context, [] {
        const auto end = std::chrono::steady_clock::now() + Apps::LoopWatchdog::PERIOD + 400ms;
        while (std::chrono::steady_clock::now() < end)
        {
        }
    });
    context.run_for(10s);
    REQUIRE(stalls.size() == 1);
    CHECK(stalls.front() >= 300ms);
}

TEST_CASE("A running loop reports that it is alive, without a stall, until it is stopped")
{
    boost::asio::io_context context;
    int stalls = 0;
    int reports = 0;
    Apps::LoopWatchdog watchdog(
        context.get_executor(),
        {1h, Apps::LoopWatchdog::PERIOD},
        {[&](Core::Duration) { ++stalls; },
         [&] {
             ++reports;
         }});
    watchdog.Start();
    while (reports < 3 && context.run_one() > 0)
    {
    }
    CHECK(reports == 3);
    CHECK(stalls == 0);
    watchdog.Stop();
    context.run_for(10s);
    CHECK(context.stopped());
    CHECK(reports == 3);
}
