#include "transaction/OutboxRoom.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"
#include "plan/ReportForecast.hpp"

#include <cstddef>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// Alarms and controls have 10 of 100 reports each.
EngineOptions MakeSmallOutbox()
{
    EngineOptions options = MakeTestOptions(false);
    options.maximumReports = 100;
    return options;
}

struct RoomParts : EngineParts
{
    RoomParts()
        : EngineParts(MakeSmallOutbox())
    {
    }

    void AddReports(std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            engine.transaction.AddReport(PlanReport{});
        }
    }

    void AddAlarms(std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            engine.transaction.AddReport(ErrorReport{});
        }
    }
};

} // namespace

TEST_CASE("OutboxRoom: a plan has three reports of its own, three of each step and three of each job")
{
    const Plan plan = MakeLogisticsPlan("P1");
    std::size_t jobs = 0;
    for (const Step& step : plan.steps)
    {
        jobs += step.jobs.size();
    }
    CHECK(CountReportsAhead(plan) == 3 * (1 + plan.steps.size() + jobs));
}

TEST_CASE("OutboxRoom: an accepted plan needs the reports that its states still allow, a finished one none")
{
    RoomParts parts;
    ActivePlan& plan = parts.AddLoad();
    PlanBook& plans = parts.engine.plans;
    const std::size_t all = plans.GetReportsAhead();
    CHECK(all == CountReportsAhead(MakeLogisticsPlan("P1")));
    parts.engine.transaction.ChangePlan(plan, EPlanState::InProgress, {});
    parts.engine.transaction.ChangeStep(plan, EStepState::Dispatched, {});
    parts.engine.transaction.ChangeJob(plan, EJobState::Instructed, {});
    CHECK(plans.GetReportsAhead() == all - 4); // it is not reported as Pending any more
    CHECK(plans.GetReportsAhead() == CountReportsAhead(plan.record.progress));
    parts.engine.transaction.ChangePlan(plan, EPlanState::Failed, {});
    static_cast<void>(plans.End(plan));
    CHECK(plans.GetReportsAhead() == 0);
}

TEST_CASE("OutboxRoom: the outbox is full from a refused plan on, until this plan has room and a tenth more")
{
    RoomParts parts;
    OutboxRoom& room = parts.engine.room;
    const Plan plan = MakeLogisticsPlan("P1");
    const std::size_t reports = CountReportsAhead(plan);
    parts.AddReports(80 - reports);
    CHECK(room.TryReserve(plan));
    CHECK_FALSE(room.IsFull());
    parts.AddReports(1);
    CHECK_FALSE(room.TryReserve(plan));
    CHECK(room.IsFull());
    CHECK_FALSE(room.IsFree());
    const auto acknowledge = [&parts] {
        REQUIRE(parts.engine.outbox.TryRemove(parts.engine.outbox.GetUnacknowledged().front().sequence));
    };
    acknowledge();
    CHECK_FALSE(room.IsFull());
    CHECK_FALSE(room.IsFree());
    for (int i = 0; i < 9; ++i)
    {
        acknowledge();
    }
    CHECK(room.IsFree());
}

TEST_CASE("OutboxRoom: a plan that is too long for an empty outbox does not fill it")
{
    RoomParts parts;
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.resize(30);
    CHECK_FALSE(parts.engine.room.TryReserve(plan));
    CHECK_FALSE(parts.engine.room.IsFull());
}

TEST_CASE("OutboxRoom: alarms are merged from half of their tenth on, and leave the room of plans and controls")
{
    RoomParts parts;
    const OutboxRoom& room = parts.engine.room;
    parts.AddAlarms(4);
    CHECK_FALSE(room.ShouldMergeAlarms());
    parts.AddAlarms(1);
    CHECK(room.ShouldMergeAlarms());
    CHECK_FALSE(room.IsAlarmShareUsed());
    parts.AddAlarms(5);
    CHECK(room.IsAlarmShareUsed());
    parts.AddReports(79);
    CHECK_FALSE(room.IsFull());
    parts.AddReports(1);
    CHECK(room.IsFull());
    CHECK(room.HasRoomForControl());
    parts.AddReports(8);
    CHECK_FALSE(room.HasRoomForControl());
}
