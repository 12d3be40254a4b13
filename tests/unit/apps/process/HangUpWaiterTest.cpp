#include "common/process/HangUpWaiter.hpp"

#include "Catch.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <csignal>

namespace Apps = ACS::Apps;
using namespace std::chrono_literals;

TEST_CASE("Each SIGHUP calls the handler on the executor and does not end the process, also after it")
{
    boost::asio::io_context context;
    int count = 0;
    {
        const Apps::HangUpWaiter waiter(context.get_executor(), [&count] { ++count; });
        for (int expected = 1; expected <= 3; ++expected)
        {
            std::raise(SIGHUP);
            while (count < expected)
            {
                REQUIRE(context.run_one_for(10s) == 1);
            }
        }
    }
    context.run(); // nothing waits any more
    std::raise(SIGHUP);
    CHECK(count == 3);
}

TEST_CASE("A SIGHUP that comes before the waiter, but is postponed, calls its handler")
{
    Apps::HangUpWaiter::Postpone();
    std::raise(SIGHUP);
    boost::asio::io_context context;
    int count = 0;
    const Apps::HangUpWaiter waiter(context.get_executor(), [&count] { ++count; });
    while (count == 0)
    {
        REQUIRE(context.run_one_for(10s) == 1);
    }
    CHECK(count == 1);
}
