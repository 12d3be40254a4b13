#include "Catch.hpp"
#include <acs/openstream_asio/RealTime.hpp>

#include <chrono>
#include <pthread.h>
#include <sched.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <thread>
#include <vector>

using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace)

namespace
{

struct Outcome
{
    std::vector<std::string> refusals;
    int policy = 0;
    int priority = 0;
    int slack = 0;
};

/// On a separate thread, so that the test thread is not tuned.
Outcome Tune(const RealTimeOptions& options)
{
    Outcome outcome;
    std::thread([&outcome, &options]() {
        outcome.refusals = TuneThread(options);
        sched_param parameters{};
        pthread_getschedparam(pthread_self(), &outcome.policy, &parameters);
        outcome.priority = parameters.sched_priority;
        outcome.slack = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);
    }).join();
    return outcome;
}

} // namespace

TEST_CASE("Without options nothing is tuned and no error is returned")
{
    const Outcome plain = Tune({});
    CHECK(plain.refusals.empty());
    CHECK(plain.policy == SCHED_OTHER);
}

TEST_CASE("The timer slack of the calling thread is set; an invalid one is an error")
{
    RealTimeOptions options;
    options.timerSlack = std::chrono::microseconds(7);
    const Outcome tuned = Tune(options);
    CHECK(tuned.refusals.empty());
    CHECK(tuned.slack == 7'000);
    CHECK(Tune({}).slack != 7'000);

    options.timerSlack = std::chrono::nanoseconds(-1);
    const Outcome refused = Tune(options);
    REQUIRE(refused.refusals.size() == 1);
    CHECK(refused.refusals.at(0).find("-1 ns was refused (Invalid argument)") != std::string::npos);
    CHECK(refused.slack == Tune({}).slack);
}

TEST_CASE("A priority is set, or an error is returned and the scheduling is unchanged")
{
    RealTimeOptions options;
    options.priority = 3;
    const Outcome tuned = Tune(options);
    if (tuned.refusals.empty())
    {
        CHECK(tuned.policy == SCHED_FIFO);
        CHECK(tuned.priority == 3);
    }
    else
    {
        CHECK(tuned.refusals.at(0).find("CAP_SYS_NICE") != std::string::npos);
        CHECK(tuned.policy == SCHED_OTHER);
    }

    options.priority = 1'000; // what no system grants
    const Outcome refused = Tune(options);
    REQUIRE(refused.refusals.size() == 1);
    CHECK(refused.refusals.at(0).find("SCHED_FIFO 1000 was refused") != std::string::npos);
    CHECK(refused.policy == SCHED_OTHER);
}

TEST_CASE("Memory is locked, or the error names what would allow it")
{
    RealTimeOptions options;
    options.bLockMemory = true;
    const Outcome tuned = Tune(options);
    CHECK((tuned.refusals.empty() || tuned.refusals.at(0).find("CAP_IPC_LOCK") != std::string::npos));
    munlockall();
}

TEST_CASE("Each of several options that fails returns one error")
{
    RealTimeOptions options = RealTimeOptions::MakeAll();
    CHECK(options.priority > 0);
    CHECK(options.timerSlack.count() > 0);
    CHECK(options.bLockMemory);
    options.priority = -5;
    options.timerSlack = std::chrono::nanoseconds(-1);
    options.bLockMemory = false;
    CHECK(Tune(options).refusals.size() == 2);
}
