#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

StartJob MakeLoadJob(const std::string& carrierID)
{
    StartJob job;
    job.action = "CassetteLoad";
    job.from = "A01.CP01";
    job.to = "LR01.CP01";
    job.carrierID = carrierID;
    return job;
}

/// What the sensor of LR01.CP01 shows; no id: the port is empty.
void ReportLoad(EngineParts& parts, const std::string& carrierID)
{
    parts.lr.view.state->loads = std::vector{PortLoad{"LR01.CP01", !carrierID.empty(), carrierID}};
    parts.loads.CompareLoads(parts.lr);
}

} // namespace

TEST_CASE("LoadWatch: a finished job moves its carrier on the record")
{
    EngineParts parts;
    parts.loads.MoveCarrier(parts.lr, MakeLoadJob("C1"));
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListChanges<CarriersChanged>() == std::vector{CarriersChanged{"LR01", {"C1"}, {"LR01.CP01"}}});
    CHECK(outcome.ListSetAlarms().empty());
    CHECK(parts.lr.changes.IsStatusMarked());
    StartJob other = MakeLoadJob("C1");
    other.to = "A01.CP02";
    parts.loads.MoveCarrier(parts.lr, other);
    CHECK(parts.Collect().changes.empty());
}

TEST_CASE("LoadWatch: a job that contradicts the record counts, with an alarm until a job fits")
{
    EngineParts parts;
    parts.loads.MoveCarrier(parts.lr, MakeLoadJob("C1"));
    parts.Discard();
    parts.loads.MoveCarrier(parts.lr, MakeLoadJob("C2"));
    CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1004"});
    CHECK(outcome.ListChanges<CarriersChanged>() == std::vector{CarriersChanged{"LR01", {"C2"}, {"LR01.CP01"}}});
    StartJob unload;
    unload.action = "CassetteUnload";
    unload.from = "LR01.CP01";
    unload.carrierID = "C2";
    parts.loads.MoveCarrier(parts.lr, unload);
    outcome = parts.Collect();
    CHECK(outcome.ListClearedAlarms() == std::vector<std::string>{"ACS-1004"});
    CHECK(
        outcome.ListChanges<CarriersChanged>() == std::vector{CarriersChanged{"LR01", {std::nullopt}, {"LR01.CP01"}}});
}

TEST_CASE("LoadWatch: the record follows the reported loads, with an alarm until they agree again")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.Discard();
    ReportLoad(parts, "C1");
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListChanges<CarriersChanged>() == std::vector{CarriersChanged{"LR01", {"C1"}, {"LR01.CP01"}}});
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1011"});
    CHECK(outcome.GetDelayOrNull(EEngineTimer::LoadAlarm) == std::chrono::seconds(10));
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    ReportLoad(parts, {});
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1011"});
}

TEST_CASE("LoadWatch: further differences are reported once in an interval")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    ReportLoad(parts, "C1");
    parts.Discard();
    ReportLoad(parts, "C2");
    CHECK(parts.Collect().ListReports<ErrorReport>().empty());
    parts.loads.OnLoadAlarmTimer(parts.lr);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1011"});
    CHECK(outcome.ListClearedAlarms() == std::vector<std::string>{"ACS-1011"});
    parts.loads.OnLoadAlarmTimer(parts.lr);
    CHECK(parts.Collect().ListReports<ErrorReport>().empty());
}

TEST_CASE("LoadWatch: the delayed clear of the alarm is dropped when the loads differ again")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    for (int i = 0; i < 5; ++i)
    {
        ReportLoad(parts, "C1");
        ReportLoad(parts, {});
        parts.loads.OnLoadAlarmTimer(parts.lr);
    }
    REQUIRE(parts.engine.alarms.GetAlarms().size() == 1);
    parts.Advance(std::chrono::seconds(30));
    ReportLoad(parts, "C1");
    parts.Advance(std::chrono::minutes(1));
    parts.Discard();
    parts.engine.transaction.ReportAlarms(parts.engine.alarms.ApplyDelayed(parts.engine.transaction.GetNow().steady));
    CHECK(parts.Collect().ListClearedAlarms().empty());
    CHECK(parts.engine.alarms.GetAlarms().size() == 1);
}

TEST_CASE("LoadWatch: loads are no evidence at the ports of an open job, nor for a robot with unstored work")
{
    EngineParts parts;
    SECTION("an open job fills the port")
    {
        parts.BeginLoad();
        ReportLoad(parts, "C1");
        CHECK(parts.Collect().changes.empty());
    }
    SECTION("the robot may have done work that was not stored")
    {
        parts.PutOn(parts.lr, "D-CHG01");
        parts.Discard();
        parts.lr.work.MarkUnresolved();
        ReportLoad(parts, "C1");
        CHECK(parts.Collect().changes.empty());
    }
}
