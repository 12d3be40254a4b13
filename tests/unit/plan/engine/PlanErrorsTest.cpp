#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

using namespace std::chrono_literals;

constexpr std::size_t FLOOD = 10'000;
constexpr std::size_t MOST_OWN = 20;    ///< Errors of a robot that are alarms of their own.
constexpr std::size_t MOST_CHANGES = 5; ///< An alarm that is set this number of times without a quiet minute stays set.
constexpr std::size_t MOST_IN_MINUTE = 60; ///< Errors of a robot that become alarms within a minute.

/// The latest state of LR01 on its node, with these errors.
StateChanged MakeState(std::vector<RobotError> errors)
{
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    state.batteryPercent = 80;
    state.errors = std::move(errors);
    return state;
}

RobotError MakeError(const std::string& code, EAlarmLevel level = EAlarmLevel::Light)
{
    return {"AGV-" + code, level, "simulated by the test"};
}

/// Distinct errors, numbered from this one on.
std::vector<RobotError> MakeErrors(std::size_t count, std::size_t first = 0)
{
    std::vector<RobotError> errors;
    for (std::size_t i = first; i < first + count; ++i)
    {
        errors.push_back(MakeError(fmt::format("e{}", i)));
    }
    return errors;
}

struct ErrorWorld : PlanWorld
{
    ErrorWorld()
    {
        Connect();
        reports.clear();
    }

    void RaiseErrors(std::vector<RobotError> errors)
    {
        Raise("LR01", MakeState(std::move(errors)));
    }

    [[nodiscard]] bool HasAlarm(const std::string& code) const
    {
        const std::vector<Alarm>& alarms = engine->GetActiveAlarms();
        return std::ranges::count(alarms, code, &Alarm::errorCode) > 0;
    }

    [[nodiscard]] std::size_t CountReports() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(reports, [](const OutboxEntry& entry) {
            return std::holds_alternative<ErrorReport>(entry.report);
        }));
    }
};

} // namespace

TEST_CASE("19.5 of 10,000 errors in one state 20 are alarms, and one more alarm has the number of the others")
{
    ErrorWorld world;
    world.RaiseErrors(MakeErrors(FLOOD));
    CHECK(world.CountReports() == MOST_OWN + 1);
    const auto& alarms = world.engine->GetActiveAlarms();
    const auto summary = std::ranges::find(alarms, "ACS-1014", &Alarm::errorCode);
    REQUIRE(summary != alarms.end());
    CHECK(summary->message.find("9980") != std::string::npos);

    world.RaiseErrors(MakeErrors(FLOOD));
    CHECK(world.CountReports() == MOST_OWN + 1);
    world.RaiseErrors({});
    CHECK(world.CountReports() == 2 * (MOST_OWN + 1));
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("19.5 errors that are others in each state become at most 60 alarms within a minute")
{
    ErrorWorld world;
    constexpr std::size_t STATES = 50;
    for (std::size_t i = 0; i < STATES; ++i)
    {
        world.RaiseErrors(MakeErrors(FLOOD, i * FLOOD));
        world.Advance(1s);
    }
    // Each is set and cleared; the summary changes once in a minute.
    CHECK(world.CountReports() <= 2 * MOST_IN_MINUTE + 2);
    CHECK(world.CountReports() >= MOST_IN_MINUTE);
    CHECK(world.HasAlarm("ACS-1014"));
}

TEST_CASE("19.5 a heavy error is an alarm of its own before light ones")
{
    ErrorWorld world;
    std::vector<RobotError> errors = MakeErrors(FLOOD);
    errors.push_back(MakeError("fatal", EAlarmLevel::Heavy));
    world.RaiseErrors(errors);
    CHECK(world.HasAlarm("AGV-fatal"));
}

TEST_CASE("19.5 an error that comes and goes stays an alarm until it has been quiet for a minute")
{
    ErrorWorld world;
    for (int i = 0; i < 1'000; ++i)
    {
        world.RaiseErrors({MakeError("flaps")});
        world.Advance(50ms);
        world.RaiseErrors({});
        world.Advance(50ms);
    }
    CHECK(world.CountReports() == 2 * MOST_CHANGES - 1);
    CHECK(world.HasAlarm("AGV-flaps"));
    const ACS::Core::SteadyTime last = world.GetNow().steady;
    REQUIRE(world.TryRun([&world] { return !world.HasAlarm("AGV-flaps"); }));
    CHECK(world.GetNow().steady - last > 59s);
    CHECK(world.GetNow().steady - last <= 60s);
    CHECK(world.CountReports() == 2 * MOST_CHANGES);

    world.RaiseErrors({MakeError("flaps")});
    world.RaiseErrors({});
    CHECK(world.CountReports() == 2 * MOST_CHANGES + 2);
}

TEST_CASE("19.5 an error whose level changes with each state stays heavy until it has been quiet for a minute")
{
    ErrorWorld world;
    for (int i = 0; i < 1'000; ++i)
    {
        world.RaiseErrors({MakeError("flaps", i % 2 == 0 ? EAlarmLevel::Heavy : EAlarmLevel::Light)});
    }
    CHECK(world.CountReports() <= 2 * MOST_CHANGES + 1);
    REQUIRE(world.HasAlarm("AGV-flaps"));
    CHECK(world.engine->GetActiveAlarms().back().level == EAlarmLevel::Heavy);
}

TEST_CASE("19.5 the alarms of a connection that comes and goes are limited too")
{
    ErrorWorld world;
    for (int i = 0; i < 1'000; ++i)
    {
        world.Raise("LR01", LinkChanged{false});
        world.Raise("LR01", LinkChanged{true});
        world.RaiseErrors({});
    }
    CHECK(world.CountReports() <= 2 * MOST_CHANGES);
    CHECK(world.HasAlarm("ACS-1002"));
    REQUIRE(world.TryRun([&world] { return !world.HasAlarm("ACS-1002"); }));
}
