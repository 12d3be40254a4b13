#include "ClientControls.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <chrono>
#include <utility>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::SteadyTime;

namespace
{

using Outcomes = std::vector<std::pair<std::uint64_t, EControlOutcome>>;

Outcomes TakeOutcomes(ClientActions& actions)
{
    Outcomes outcomes;
    for (const ClientAction& action : std::exchange(actions, {}))
    {
        const auto* const event = std::get_if<ClientEvent>(&action);
        if (const auto* settled = event != nullptr ? std::get_if<ClientControlSettled>(event) : nullptr)
        {
            outcomes.emplace_back(settled->token, settled->outcome);
        }
    }
    return outcomes;
}

ControlCall MakeConfirmedCall()
{
    ControlCall call;
    call.isConfirmed = [](const DataLine& sample) {
        return sample.ts > 0;
    };
    call.confirmWithin = 1s;
    return call;
}

DataLine MakeSample(double ts)
{
    DataLine line;
    line.ts = ts;
    return line;
}

} // namespace

TEST_CASE("A CONTROL has a deadline for sending until it has left, and is accepted when its window has passed")
{
    const ACS::Testing::ManualClock clock;
    const SteadyTime deadline = clock.GetNow().steady + 5s;
    ClientControls controls(1);
    ClientActions actions;
    REQUIRE(controls.BeginNextOrNull() == nullptr);
    REQUIRE(controls.TryAdd(1, deadline, {}));
    REQUIRE_FALSE(controls.TryAdd(2, deadline, {}));
    CHECK(controls.GetDeadline() == deadline);
    REQUIRE(controls.BeginNextOrNull() != nullptr);
    CHECK(controls.GetDeadline() == SteadyTime::max());
    CHECK(controls.GetSendDeadline() == deadline);
    CHECK(controls.TryBeginWindow(clock.GetNow()));
    CHECK_FALSE(controls.TryBeginWindow(clock.GetNow()));
    CHECK(controls.GetSendDeadline() == SteadyTime::max());
    CHECK(controls.TryAccept(actions));
    CHECK_FALSE(controls.IsInFlight());
    CHECK(TakeOutcomes(actions) == Outcomes{{1, EControlOutcome::Accepted}});
}

TEST_CASE("Only a sample after a CONTROL has left confirms it, within its window or later")
{
    const ACS::Testing::ManualClock clock;
    ClientControls controls(2);
    ClientActions actions;
    REQUIRE(controls.TryAdd(1, SteadyTime::max(), MakeConfirmedCall()));
    REQUIRE(controls.TryAdd(2, SteadyTime::max(), MakeConfirmedCall()));
    REQUIRE(controls.BeginNextOrNull() != nullptr);
    controls.OnSample(MakeSample(1), actions);
    REQUIRE(controls.TryBeginWindow(clock.GetNow()));
    CHECK_FALSE(controls.TryAccept(actions));
    CHECK(controls.GetDeadline() == clock.GetNow().steady + 1s);
    REQUIRE(controls.BeginNextOrNull() != nullptr);
    REQUIRE(controls.TryBeginWindow(clock.GetNow()));
    controls.OnSample(MakeSample(0), actions);
    CHECK(TakeOutcomes(actions).empty());
    controls.OnSample(MakeSample(1), actions);
    CHECK(TakeOutcomes(actions) == Outcomes{{1, EControlOutcome::Accepted}});
    CHECK(controls.TryAccept(actions));
    CHECK(TakeOutcomes(actions) == Outcomes{{2, EControlOutcome::Accepted}});
}

TEST_CASE(
    "CONTROLs that wait for too long are settled: for their turn as not sent, for their confirmation as unconfirmed")
{
    ACS::Testing::ManualClock clock;
    ClientControls controls(2);
    ClientActions actions;
    REQUIRE(controls.TryAdd(1, SteadyTime::max(), MakeConfirmedCall()));
    REQUIRE(controls.TryAdd(2, clock.GetNow().steady + 1s, {}));
    REQUIRE(controls.BeginNextOrNull() != nullptr);
    REQUIRE(controls.TryBeginWindow(clock.GetNow()));
    REQUIRE_FALSE(controls.TryAccept(actions));
    clock.Advance(999ms);
    controls.SettleLate(clock.GetNow(), actions);
    CHECK(TakeOutcomes(actions).empty());
    clock.Advance(1ms);
    controls.SettleLate(clock.GetNow(), actions);
    CHECK(TakeOutcomes(actions) == Outcomes{{2, EControlOutcome::NotSent}, {1, EControlOutcome::Unconfirmed}});
    CHECK(controls.GetDeadline() == SteadyTime::max());
}
