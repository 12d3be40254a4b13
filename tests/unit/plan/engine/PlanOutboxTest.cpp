#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <variant>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

using namespace std::chrono_literals;

constexpr std::size_t OUTBOX_LIMIT = 200;

/// An MCS that acknowledges nothing.
struct OutboxWorld : PlanWorld
{
    OutboxWorld()
        : PlanWorld(1, MakeOptions(), MakeTestSite())
    {
        bAcknowledges = false;
        Connect();
    }

    static EngineOptions MakeOptions()
    {
        EngineOptions options = MakeTestOptions(false);
        options.maximumReports = OUTBOX_LIMIT;
        return options;
    }

    [[nodiscard]] std::size_t CountReports() const
    {
        return engine->GetUnacknowledged().size();
    }

    [[nodiscard]] bool HasAlarm(const std::string& code) const
    {
        return std::ranges::count(engine->GetActiveAlarms(), code, &Alarm::errorCode) > 0;
    }

    void RaiseError(const std::string& code)
    {
        StateChanged state;
        state.lastNodeID = "D-CHG01";
        state.batteryPercent = 80;
        if (!code.empty())
        {
            state.errors.push_back({code, EAlarmLevel::Light, "simulated by the test"});
        }
        Raise("LR01", state);
    }

    void AcknowledgeAll()
    {
        for (const OutboxEntry& entry : engine->GetUnacknowledged())
        {
            Ask(MessageAcknowledged{entry.sequence});
        }
    }
};

} // namespace

TEST_CASE("19.5 outbox.max: with an MCS that acknowledges nothing, alarms use at most their tenth")
{
    constexpr int CHANGES = 1'000;
    OutboxWorld world;
    for (int i = 0; i < CHANGES; ++i)
    {
        world.RaiseError(fmt::format("AGV-{}", i));
        world.Advance(61s); // no rate limit applies
        world.RaiseError({});
        world.Advance(61s);
    }
    CHECK(world.CountReports() <= OUTBOX_LIMIT / 10 + 5);
    CHECK(world.store.GetState().outbox == world.engine->GetUnacknowledged());

    // What is left has the latest state of each alarm.
    world.RaiseError("AGV-last");
    std::map<std::string, bool> states;
    for (const OutboxEntry& entry : world.engine->GetUnacknowledged())
    {
        const auto& report = std::get<ErrorReport>(entry.report);
        states[report.alarm.errorCode] = report.bSet;
    }
    CHECK(world.HasAlarm("ACS-1014"));
    CHECK(states.at("ACS-1014"));
    CHECK(std::ranges::count_if(states, [](const auto& state) { return state.second; }) == 1);

    world.AcknowledgeAll();
    world.RaiseError("AGV-last");
    CHECK(world.HasAlarm("AGV-last"));
    CHECK_FALSE(world.HasAlarm("ACS-1014"));
}

TEST_CASE("19.5 outbox.max: plans are refused in time, and those that were accepted are reported to their end")
{
    OutboxWorld world;
    std::size_t accepted = 0;
    for (bool bAccepted = true; bAccepted; accepted += bAccepted ? 1U : 0U)
    {
        REQUIRE(accepted < OUTBOX_LIMIT);
        const std::string planID = fmt::format("P{}", accepted);
        world.Submit(MakeLogisticsPlan(planID), accepted + 1);
        bAccepted = world.replies.at(accepted + 1).bAccepted;
        if (bAccepted)
        {
            REQUIRE(world.TryRun());
            CHECK(world.GetReportsOf(planID).back() == "Plan Completed");
        }
    }
    CHECK(world.replies.rbegin()->second.message.find("Outbox Full") != std::string::npos);
    CHECK(accepted > 5);
    CHECK(world.CountReports() <= OUTBOX_LIMIT);
    CHECK(world.store.GetState().outbox.size() <= OUTBOX_LIMIT);
    CHECK(world.HasAlarm("ACS-1020"));
    CHECK(
        std::ranges::count_if(
            world.engine->GetUnacknowledged(),
            [](const OutboxEntry& entry) {
                const auto* planOrNull = std::get_if<PlanReport>(&entry.report);
                return planOrNull != nullptr && planOrNull->state == EPlanState::Completed;
            })
        == static_cast<std::ptrdiff_t>(accepted));

    world.AcknowledgeAll();
    CHECK_FALSE(world.HasAlarm("ACS-1020"));
    world.Submit(MakeLogisticsPlan("after"), OUTBOX_LIMIT);
    CHECK(world.replies.at(OUTBOX_LIMIT).bAccepted);
}

TEST_CASE("19.5 outbox.max: waiting plans keep their room")
{
    OutboxWorld world;
    world.SwitchTSC(true); // no plan is started
    ReplyToken token = 0;
    do
    {
        REQUIRE(++token < OUTBOX_LIMIT);
        world.Submit(MakeLogisticsPlan(fmt::format("P{}", token)), token);
    }
    while (world.replies.at(token).bAccepted);
    CHECK(world.CountReports() < OUTBOX_LIMIT / 2);
    world.SwitchTSC(false);
    REQUIRE(world.TryRun());
    for (ReplyToken other = 1; other < token; ++other)
    {
        CHECK(world.GetReportsOf(fmt::format("P{}", other)).back() == "Plan Completed");
    }
    CHECK(world.CountReports() <= OUTBOX_LIMIT);
}

TEST_CASE("19.5 outbox.max: a control without room for its result is refused, without a result")
{
    OutboxWorld world;
    for (std::size_t i = 1; i <= 2 * OUTBOX_LIMIT; ++i)
    {
        world.Control(EPlanControl::Abort, "unknown", i);
    }
    CHECK(world.CountReports() <= OUTBOX_LIMIT);
    CHECK(world.replies.at(2 * OUTBOX_LIMIT).message.find("Outbox Full") != std::string::npos);
    world.AcknowledgeAll();
    world.Control(EPlanControl::Abort, "unknown", 1);
    CHECK(world.replies.at(1).message.find("There is no plan") != std::string::npos);
}

TEST_CASE("19.5 outbox.max: merged alarms of a failing store are stored and sent once it works again")
{
    OutboxWorld world;
    for (int i = 0; i < static_cast<int>(OUTBOX_LIMIT); ++i)
    {
        world.RaiseError(fmt::format("AGV-{}", i % 15));
        world.Advance(61s);
    }
    world.store.bFails = true;
    for (int i = 0; i < 20; ++i)
    {
        world.RaiseError(i % 2 == 0 ? "AGV-0" : "AGV-1");
        world.Advance(61s);
    }
    world.store.bFails = false;
    REQUIRE(world.TryRun());
    CHECK(world.store.GetState().outbox == world.engine->GetUnacknowledged());
    CHECK(world.CountReports() <= OUTBOX_LIMIT / 10 + 5);
    CHECK(world.violations.empty());
}
