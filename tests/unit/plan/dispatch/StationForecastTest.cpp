#include "dispatch/StationForecast.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>
#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

Plan MakeTransport(const std::string& planID, const std::string& from, const std::string& to)
{
    Plan plan = MakeLogisticsPlan(planID);
    plan.steps[0].position = from;
    plan.steps[0].jobs[0].from = from;
    plan.steps[1].position = to;
    plan.steps[1].jobs[0].to = to;
    return plan;
}

/// Four robots; LR01 begins a plan from A01.CP01 to A02.CP03 on its parking position.
struct BusyFloor
{
    EngineParts parts{MakeTestOptions(true)};
    Robot& other = parts.engine.fleet[2];
    ActivePlan& begun = parts.BeginDriveToLoad();

    BusyFloor()
    {
        parts.PutOn(other, "D-CHG03");
    }

    [[nodiscard]] StationForecast Forecast() const
    {
        return {parts.engine.fleet, parts.coordinator.GetVisits()};
    }
};

} // namespace

TEST_CASE("StationForecast: a plan whose stations no robot uses begins")
{
    BusyFloor floor;
    const ActivePlan& plan = floor.parts.Add(MakeTransport("P2", "A01.CP05", "A02.CP04"));
    CHECK(floor.Forecast().CanBegin(plan, floor.other));
    CHECK_FALSE(floor.Forecast().FindTakenOrNull(plan).has_value());
}

TEST_CASE("StationForecast: a plan that would meet another robot at a station does not begin")
{
    BusyFloor floor;
    const ActivePlan& first = floor.parts.Add(MakeTransport("P2", "A01.CP01", "A02.CP04"));
    const ActivePlan& second = floor.parts.Add(MakeTransport("P3", "A01.CP05", "A02.CP03"));
    const StationForecast stations = floor.Forecast();
    CHECK_FALSE(stations.CanBegin(first, floor.other));
    CHECK(stations.FindTakenOrNull(first) == "A01.CP01");
    CHECK_FALSE(stations.CanBegin(second, floor.other));
    CHECK(stations.FindTakenOrNull(second) == "A02.CP03");
    CHECK(stations.ListRobots("A02.CP03") == std::vector<std::size_t>{floor.parts.lr.index});
}

TEST_CASE("StationForecast: a station is taken while a robot that cannot move has a plan to it")
{
    BusyFloor floor;
    const ActivePlan& plan = floor.parts.Add(MakeTransport("P2", "A01.CP05", "A02.CP03"));
    floor.parts.engine.jobTimes.Note("A02.CP03", std::chrono::milliseconds(1));
    floor.parts.engine.jobTimes.Note("A01.CP05", std::chrono::hours(1));
    CHECK(floor.Forecast().CanBegin(plan, floor.other));
    floor.parts.lr.view.state->bAutomatic = false;
    CHECK_FALSE(floor.Forecast().CanBegin(plan, floor.other));
}

TEST_CASE("StationForecast: a plan that arrives long after the other robot has left begins")
{
    BusyFloor floor;
    // Of the plan of LR01 only the last job is left, which took a moment before.
    floor.begun.step = 1;
    floor.parts.PutOn(floor.parts.lr, "D-A02.CP03");
    floor.parts.engine.jobTimes.Note("A02.CP03", std::chrono::milliseconds(1));
    floor.parts.engine.jobTimes.Note("A01.CP05", std::chrono::minutes(1));
    const ActivePlan& plan = floor.parts.Add(MakeTransport("P2", "A01.CP05", "A02.CP03"));
    CHECK(floor.Forecast().CanBegin(plan, floor.other));
    floor.parts.engine.jobTimes.Note("A02.CP03", std::chrono::hours(1));
    CHECK_FALSE(floor.Forecast().CanBegin(plan, floor.other));
}

TEST_CASE("StationForecast: plans that share a station begin in the order of the queue")
{
    BusyFloor floor;
    const ActivePlan& first = floor.parts.Add(MakeTransport("P2", "A01.CP01", "A02.CP04"));
    const ActivePlan& second = floor.parts.Add(MakeTransport("P3", "A01.CP05", "A02.CP04"));
    StationForecast stations = floor.Forecast();
    CHECK(stations.CanBegin(second, floor.other));
    stations.PassOver(first);
    CHECK_FALSE(stations.CanBegin(second, floor.other));
}

TEST_CASE("StationForecast: a robot that has just got a plan counts")
{
    BusyFloor floor;
    const ActivePlan& first = floor.parts.Add(MakeTransport("P2", "A01.CP04", "A02.CP04"));
    const ActivePlan& second = floor.parts.Add(MakeTransport("P3", "A01.CP05", "A02.CP04"));
    StationForecast stations = floor.Forecast();
    floor.other.planOrNull = floor.parts.engine.plans.FindActiveOrNull("P2");
    stations.Add(first, floor.other);
    CHECK_FALSE(stations.CanBegin(second, floor.other));
    floor.other.planOrNull = nullptr;
}
