#include "Catch.hpp"
#include "SeededRandom.hpp"
#include <acs/plan/ReportOutbox.hpp>

#include <optional>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

TEST_CASE("ReportOutbox: the latest report of each alarm is found, after a restart as well")
{
    ACS::Testing::SeededRandom random;
    ReportOutbox outbox;
    const Alarm first{"LR01", "AGV-1", EAlarmLevel::Light, "blocked", {}, {}, {}};
    Alarm ofPlan = first;
    ofPlan.planID = "P1";
    CHECK(outbox.FindAlarmOrNull(first) == std::nullopt);
    outbox.Add(ErrorReport{first, true}, {}, random);
    outbox.Add(PlanReport{}, {}, random);
    outbox.Add(ErrorReport{ofPlan, true}, {}, random);
    outbox.Add(ErrorReport{first, false}, {}, random);
    CHECK(outbox.CountAlarms() == 3);
    CHECK(outbox.FindAlarmOrNull(first) == 4);
    CHECK(outbox.FindAlarmOrNull(ofPlan) == 3);

    ReportOutbox restored;
    restored.Restore({outbox.GetUnacknowledged().begin(), outbox.GetUnacknowledged().end()}, 4);
    CHECK(restored.CountAlarms() == 3);
    CHECK(restored.FindAlarmOrNull(first) == 4);

    CHECK(outbox.TryRemove(1));
    CHECK(outbox.FindAlarmOrNull(first) == 4);
    CHECK(outbox.TryRemove(4));
    CHECK(outbox.FindAlarmOrNull(first) == std::nullopt);
    CHECK(outbox.CountAlarms() == 1);
}
