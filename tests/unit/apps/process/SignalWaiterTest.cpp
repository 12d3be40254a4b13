#include "common/process/SignalWaiter.hpp"

#include "Catch.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace Apps = ACS::Apps;
using namespace std::chrono_literals;

namespace
{

constexpr int EXIT_NOT_KILLED = 7;

/// The child's status as waitpid() gives it.
int WaitFor(pid_t child)
{
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return status;
}

/// A child of its own takes the second signal: it ends the process.
int RunChildWithTwoSignals(int signalNumber)
{
    const pid_t child = fork();
    if (child == 0)
    {
        boost::asio::io_context context;
        const Apps::SignalWaiter waiter(context.get_executor(), [signalNumber](int) {
            // The loop is blocked here: only the signal handler can end the process.
            std::raise(signalNumber);
            std::_Exit(EXIT_NOT_KILLED);
        });
        std::raise(signalNumber);
        context.run_for(5s);
        std::_Exit(EXIT_NOT_KILLED);
    }
    return WaitFor(child);
}

/// The same in a child whose loop never runs.
int RunHangingChildWithTwoSignals(int signalNumber)
{
    const pid_t child = fork();
    if (child == 0)
    {
        boost::asio::io_context context;
        const Apps::SignalWaiter waiter(context.get_executor(), [](int) {});
        std::raise(signalNumber);
        std::raise(signalNumber);
        std::_Exit(EXIT_NOT_KILLED);
    }
    return WaitFor(child);
}

} // namespace

TEST_CASE("The first signal calls the handler once and the loop ends")
{
    const int signalNumber = GENERATE(SIGINT, SIGTERM);
    boost::asio::io_context context;
    std::vector<int> received;
    {
        const Apps::SignalWaiter waiter(context.get_executor(), [&received](int number) {
            received.push_back(number);
        });
        std::raise(signalNumber);
        context.run_for(5s);
    }
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    REQUIRE(received == std::vector<int>{signalNumber});
    REQUIRE(context.stopped());
}

TEST_CASE("The second signal ends the process immediately with 130 or 143")
{
    const int signalNumber = GENERATE(SIGINT, SIGTERM);
    const int status = RunChildWithTwoSignals(signalNumber);
    REQUIRE(WIFEXITED(status));
    REQUIRE(WEXITSTATUS(status) == 128 + signalNumber);
}

TEST_CASE("The second signal ends a process whose loop hangs since before the first")
{
    const int signalNumber = GENERATE(SIGINT, SIGTERM);
    const int status = RunHangingChildWithTwoSignals(signalNumber);
    REQUIRE(WIFEXITED(status));
    REQUIRE(WEXITSTATUS(status) == 128 + signalNumber);
}

TEST_CASE("A stopped waiter does not keep the loop running and does not call its handler")
{
    boost::asio::io_context context;
    int count = 0;
    Apps::SignalWaiter waiter(context.get_executor(), [&count](int) { ++count; });
    waiter.Stop();
    context.run_for(5s);
    REQUIRE(context.stopped());
    REQUIRE(count == 0);
}
