#include "ServerMonitor.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <chrono>
#include <variant>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::SteadyTime;

namespace
{

/// A ServerMonitor with a period of 10 ms and a service that has to answer within 15 ms.
class ServerMonitorFixture
{
    ServerActions _actions;

public:
    ACS::Testing::ManualClock clock;
    ServerMonitor monitor{15ms};

    ServerMonitorFixture()
    {
        monitor.Begin(MakeRequest(10ms), clock.GetNow(), _actions);
    }

    static MonitorRequest MakeRequest(std::chrono::milliseconds period)
    {
        return MonitorRequest{"/arm", period, {}, {}};
    }

    void Replace(std::chrono::milliseconds period)
    {
        monitor.Replace(MakeRequest(period), clock.GetNow(), _actions);
    }

    ServerMonitor::Outcome Tick(std::uint64_t token, std::chrono::milliseconds after)
    {
        clock.Advance(after);
        return monitor.OnTick(token, clock.GetNow(), _actions);
    }

    /// Deadline of the last timer that was started.
    [[nodiscard]] SteadyTime GetNextTick() const
    {
        SteadyTime deadline;
        for (const ServerAction& action : _actions)
        {
            const auto* const start = std::get_if<ServerStartTimer>(&action);
            deadline = start != nullptr ? start->deadline : deadline;
        }
        return deadline;
    }
};

} // namespace

TEST_CASE("A late tick keeps the phase, and the ticks that it missed are skipped")
{
    ServerMonitorFixture fixture;
    const SteadyTime begin = fixture.clock.GetNow().steady;
    CHECK(fixture.GetNextTick() == begin + 10ms);
    CHECK(fixture.Tick(1, 35ms).skipped == 2);
    CHECK(fixture.monitor.IsCall(1));
    CHECK(fixture.GetNextTick() == begin + 40ms);
}

TEST_CASE("A tick that fires early calls nothing")
{
    ServerMonitorFixture fixture;
    CHECK(fixture.Tick(1, 9ms).skipped == 0);
    CHECK_FALSE(fixture.monitor.IsCall(1));
}

TEST_CASE("A MONITOR that replaces another one keeps its earlier tick and outdates its call")
{
    ServerMonitorFixture fixture;
    const SteadyTime begin = fixture.clock.GetNow().steady;
    static_cast<void>(fixture.Tick(1, 10ms));
    fixture.Replace(100ms);
    CHECK(fixture.GetNextTick() == begin + 20ms);
    CHECK_FALSE(fixture.monitor.IsCall(1));
    fixture.Replace(2ms);
    CHECK(fixture.GetNextTick() == begin + 12ms);
}

TEST_CASE("A service that fails is reported once, until it answers again")
{
    ServerMonitorFixture fixture;
    ApiResponse failure;
    failure.status = 500;
    CHECK_FALSE(fixture.Tick(1, 10ms).bFailureBegan);
    CHECK_FALSE(fixture.Tick(2, 10ms).bFailureBegan);
    CHECK(fixture.Tick(3, 10ms).bFailureBegan); // no answer within 15 ms
    CHECK_FALSE(fixture.Tick(4, 10ms).bFailureBegan);
    CHECK_FALSE(fixture.monitor.OnAnswer(failure).bFailureBegan);
    CHECK_FALSE(fixture.monitor.OnAnswer({}).bFailureBegan);
    CHECK(fixture.monitor.OnAnswer(failure).bFailureBegan);
    ApiResponse none;
    none.bNoSample = true;
    CHECK(fixture.monitor.OnAnswer(none).skipped == 1);
    CHECK_FALSE(fixture.monitor.OnAnswer(failure).bFailureBegan);
}
