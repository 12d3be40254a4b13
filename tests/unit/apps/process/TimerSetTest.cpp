#include "common/process/TimerSet.hpp"

#include "Catch.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace Apps = ACS::Apps;
using namespace std::chrono_literals;

namespace
{

/// Far beyond what a test waits for.
constexpr auto NEVER = 1h;

} // namespace

TEST_CASE("Timers fire once each, in the order of their delays")
{
    boost::asio::io_context context;
    std::vector<std::uint64_t> fired;
    Apps::TimerSet<std::uint64_t> timers(context.get_executor(), [&fired](std::uint64_t key) { fired.push_back(key); });
    timers.Start(7, 20ms);
    timers.Start(3, 0ms);
    REQUIRE(timers.IsRunning(7));
    context.run_for(5s);
    REQUIRE(fired == std::vector<std::uint64_t>{3, 7});
    REQUIRE_FALSE(timers.IsRunning(7));
}

TEST_CASE("A cancelled timer does not fire, even if it has expired")
{
    boost::asio::io_context context;
    std::vector<std::uint64_t> fired;
    std::unique_ptr<Apps::TimerSet<std::uint64_t>> timers;
    timers =
        std::make_unique<Apps::TimerSet<std::uint64_t>>(context.get_executor(), [&fired, &timers](std::uint64_t key) {
            fired.push_back(key);
            timers->Cancel(key + 1);
            timers->Cancel(99);
        });
    timers->Start(1, -2ms);
    timers->Start(2, -1ms);
    context.run_for(5s);
    REQUIRE(fired == std::vector<std::uint64_t>{1});
}

TEST_CASE("A key may be of any ordered type")
{
    boost::asio::io_context context;
    std::vector<std::string> fired;
    Apps::TimerSet<std::string> timers(context.get_executor(), [&fired](const std::string& key) {
        fired.push_back(key);
    });
    timers.Start("LR01", 20ms);
    timers.Start("LR02", 0ms);
    timers.Start("LR03", NEVER);
    context.run_for(100ms);
    REQUIRE(fired == std::vector<std::string>{"LR02", "LR01"});
    REQUIRE(timers.IsRunning("LR03"));
}

TEST_CASE("A restarted timer has the full delay again")
{
    boost::asio::io_context context;
    int count = 0;
    Apps::TimerSet<std::uint64_t> timers(context.get_executor(), [&count](std::uint64_t /*key*/) { ++count; });
    timers.Start(1, -1ms);
    timers.Start(1, NEVER);
    context.run_for(10ms);
    REQUIRE(count == 0);
    REQUIRE(timers.IsRunning(1));
    timers.Start(1, 0ms);
    context.run_for(5s);
    REQUIRE(count == 1);
}

TEST_CASE("A handler may restart its own timer")
{
    boost::asio::io_context context;
    int count = 0;
    std::unique_ptr<Apps::TimerSet<std::uint64_t>> timers;
    timers =
        std::make_unique<Apps::TimerSet<std::uint64_t>>(context.get_executor(), [&count, &timers](std::uint64_t key) {
            if (++count < 3)
            {
                timers->Start(key, 0ms);
            }
        });
    timers->Start(1, 0ms);
    context.run_for(5s);
    REQUIRE(count == 3);
}

TEST_CASE("After destruction, also inside the handler, no timer fires")
{
    boost::asio::io_context context;
    int count = 0;
    std::unique_ptr<Apps::TimerSet<std::uint64_t>> timers;
    timers = std::make_unique<Apps::TimerSet<std::uint64_t>>(
        context.get_executor(),
        [&count, &timers](std::uint64_t /*key*/) {
            ++count;
            timers.reset();
        });
    timers->Start(1, -2ms);
    timers->Start(2, -1ms);
    timers->Start(3, NEVER);
    context.run_for(5s);
    REQUIRE(count == 1);
    REQUIRE(context.stopped());
}
