#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

#include <fmt/format.h>

#include <algorithm>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::PlanWorld;

namespace
{

/// Transports between random places, so that robots always compete for places.
Plan MakeRandomPlan(PlanWorld& world, std::size_t number)
{
    const auto pick = [&world](std::initializer_list<const char*> names) {
        return std::string(*(names.begin() + world.GetRandom(names.size())));
    };
    const std::string planID = fmt::format("P{}", number);
    Plan plan{planID, "", static_cast<std::int32_t>(world.GetRandom(3)), {}};
    if (world.GetRandom(2) == 0)
    {
        const std::string from = pick({"A01.CP01", "A01.CP02", "A01.CP03", "A02.CP03"});
        const std::string to = pick({"A01.CP01", "A01.CP02", "A01.CP03", "A02.CP04"});
        plan.steps = {
            {1, "CassetteLoad", from, {"C"}, {{planID + "-1", from, "AMR.CP01"}}},
            {2, "CassetteUnload", to, {"C"}, {{planID + "-2", "AMR.CP01", to}}}};
        return plan;
    }
    const std::string from = pick({"A01.CP01", "A01.CP02", "A01.CP03"});
    const std::string set = pick({"A01.SET01", "A01.SET02", "A01.SET03"});
    plan.steps = {
        {1, "TrayLoad", from, {"T"}, {{planID + "-1", from + ".TP01", "AMR.TP01"}}},
        {2, "OpenSetCover", set, {}, {}},
        {3, "MemoryPickAndPlace", set, {}, {{planID + "-2", "AMR.TP01.MP01", set + ".MP01"}}},
        {4, "TrayUnload", from, {"T"}, {{planID + "-3", "AMR.TP01", from + ".TP01"}}}};
    return plan;
}

std::size_t CountFinal(const PlanWorld& world, const std::string& planID)
{
    const std::vector<std::string> reports = world.GetReportsOf(planID);
    return static_cast<std::size_t>(std::ranges::count_if(reports, [](const std::string& report) {
        return report == "Plan Completed" || report == "Plan Failed" || report == "Plan Cancelled"
            || report == "Plan Aborted";
    }));
}

} // namespace

TEST_CASE("Random plans on a crowded loop all complete, and no node has two robots at any time")
{
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
    {
        INFO("seed " << seed);
        PlanWorld world(seed, seed % 2 == 0);
        const std::size_t plans = 4 + world.GetRandom(8);
        for (std::size_t number = 1; number <= plans; ++number)
        {
            world.Submit(MakeRandomPlan(world, number));
            if (number == plans / 2)
            {
                world.Connect();
            }
        }
        REQUIRE(world.TryRun());
        REQUIRE(world.violations == std::vector<std::string>{});
        for (std::size_t number = 1; number <= plans; ++number)
        {
            INFO("plan " << number);
            REQUIRE(world.GetReportsOf(fmt::format("P{}", number)).back() == "Plan Completed");
            REQUIRE(CountFinal(world, fmt::format("P{}", number)) == 1);
        }
        REQUIRE(world.engine->GetActivePlans().empty());
        REQUIRE(world.engine->GetUnacknowledged().empty());
        REQUIRE(world.store.GetState().outbox.empty());
    }
}

namespace
{

void RemoveCarriers(PlanWorld& world)
{
    for (const RobotStatus& robot : world.engine->GetRobotStatuses())
    {
        world.Ask(SetCarriers{robot.robotID, std::vector<std::optional<std::string>>(robot.carrierIDs.size()), 0});
    }
}

} // namespace

TEST_CASE("With random controls, rejected drives and failed jobs every plan ends once and every control has one result")
{
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
    {
        INFO("seed " << seed);
        PlanWorld world(seed, true);
        world.Connect();
        constexpr std::size_t PLANS = 10;
        std::size_t controls = 0;
        for (std::size_t number = 1; number <= PLANS; ++number)
        {
            const std::string planID = fmt::format("P{}", number);
            if (world.GetRandom(5) == 0)
            {
                world.GetRobot("CR01").failingJobs.insert(planID + "-2");
                world.GetRobot("LR02").failingJobs.insert(planID + "-1");
            }
            world.GetRobot("LR01").bRejectDrives = world.GetRandom(8) == 0;
            world.Submit(MakeRandomPlan(world, number));
            std::uint64_t left = world.GetRandom(40);
            static_cast<void>(world.TryRun([&left] { return left-- == 0; }));
            for (std::uint64_t count = world.GetRandom(3); count > 0; --count)
            {
                const auto control = static_cast<EPlanControl>(world.GetRandom(4));
                world.Control(control, fmt::format("P{}", 1 + world.GetRandom(number)));
                ++controls;
            }
            world.GetRobot("CR02").bFinishesJobs = world.GetRandom(2) == 0;
        }
        world.GetRobot("LR01").bRejectDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 0});
        REQUIRE(world.TryRun());
        for (const PlanSummary& paused : world.engine->GetActivePlans())
        {
            world.Control(EPlanControl::Resume, paused.planID);
            ++controls;
        }
        REQUIRE(world.TryRun());
        for (std::size_t round = 0; round < PLANS && !world.engine->GetActivePlans().empty(); ++round)
        {
            // A plan that did not complete may have left its carrier on a robot, and other robots wait for it.
            RemoveCarriers(world);
            REQUIRE(world.TryRun());
        }
        const auto results = std::ranges::count_if(world.reports, [](const OutboxEntry& entry) {
            return std::holds_alternative<ControlResultReport>(entry.report);
        });
        REQUIRE(static_cast<std::size_t>(results) == controls);
        REQUIRE(world.violations == std::vector<std::string>{});
        for (std::size_t number = 1; number <= PLANS; ++number)
        {
            INFO("plan " << number);
            REQUIRE(CountFinal(world, fmt::format("P{}", number)) == 1);
        }
        const std::vector<ACS::Planning::OutboxEntry>& reports = world.reports;
        REQUIRE(
            std::ranges::adjacent_find(reports, std::ranges::greater_equal{}, &OutboxEntry::sequence) == reports.end());
    }
}
