#include "operator/ReadRoutes.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "view/StateViewMaker.hpp"
#include <acs/core/Timestamp.hpp>

#include <chrono>
#include <numbers>
#include <string>

namespace ACS::Acsd::Test
{

namespace
{

using Testing::MakeLogisticsPlan;
using Testing::PlanWorld;

/// An operator who calls the routes directly, without HTTP.
class Reader final : private Core::IClock
{
    Apps::HttpRoutes _routes;
    StateView _state;

public:
    PlanWorld world{1, true};
    ProgramState program{};
    Core::WallTime now = Core::WallTime(std::chrono::hours(1));

private:
    StateViewMaker _maker{*world.engine, now};

public:
    Reader()
    {
        program.links = {{"mcs", true}, {"mqtt", false}};
        AddReadRoutes(
            _routes,
            *world.engine,
            {*this,
             [this]() -> const StateView& { return Make(); },
             [this]() -> const StateView& { return Make(); },
             [] {
                 return 7U;
             }});
    }

    std::string Get(std::string_view target)
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = "GET";
        const Apps::HttpResponse response = _routes.Respond(request);
        return response.status == 200 ? response.body : std::to_string(response.status) + " " + response.body;
    }

private:
    const StateView& Make()
    {
        _state = _maker.Make(program, now);
        return _state;
    }

    [[nodiscard]] Core::Now GetNow() const override
    {
        return {Core::SteadyTime(), now};
    }
};

bool HasText(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

std::string MakeTime(std::chrono::seconds time)
{
    return "\"" + Core::FormatUTC(Core::WallTime(time)) + "\"";
}

} // namespace

TEST_CASE("The status has links with reason and time, counts, and isConnected as the MCS knows it")
{
    Reader reader;
    const std::string start = MakeTime(std::chrono::hours(1));
    reader.now += std::chrono::seconds(90);
    std::string status = reader.Get("/v1/status");
    CHECK(HasText(status, R"("startedAt":)" + start + R"(,"ready":false,"notReadyReasons":["no connection: mqtt"])"));
    CHECK(HasText(status, R"("isConnected":null,"links":[{"name":"mcs","up":true,"reason":null,"since":)"));
    CHECK(HasText(status, R"({"name":"mqtt","up":false,"reason":"no connection: mqtt","since":)"));
    CHECK(HasText(status, R"("tsc":"Auto","tscReason":null,"outbox":{"reports":)"));
    CHECK(HasText(status, R"("refusedReports":{"count":0,"last":null})"));
    CHECK(HasText(status, R"("plans":{"active":0,"waiting":0})"));
    CHECK(HasText(status, R"("uptimeSeconds":90)"));

    reader.program.links[1].bUp = true;
    reader.program.links[1].broker = "mqtt://broker:1883";
    reader.program.bConnected = true;
    reader.program.refusedReports.count = 3;
    reader.program.refusedReports.command = "JobReport";
    reader.program.refusedReports.message = "unknown job";
    reader.program.refusedReports.bRetried = true;
    reader.now += std::chrono::seconds(10);
    status = reader.Get("/v1/status");
    CHECK(HasText(status, R"("ready":true,"notReadyReasons":[],"isConnected":true)"));
    CHECK(HasText(
        status,
        R"({"name":"mqtt","up":true,"reason":null,"since":)" + MakeTime(std::chrono::seconds(3'700))
            + R"(,"broker":"mqtt://broker:1883"})"));
    CHECK(HasText(
        status,
        R"("refusedReports":{"count":3,"last":{"command":"JobReport","planId":null,"message":"unknown job","retried":true}})"));
}

TEST_CASE("A plan is shown with its steps, its jobs, and why and since when it waits")
{
    Reader reader;
    reader.world.Submit(MakeLogisticsPlan("P1"));
    const std::string accepted = Core::FormatUTC(reader.world.engine->GetPlanRecordOrNull("P1")->acceptedAt);
    std::string plan = reader.Get("/v1/plans/P1");
    CHECK(HasText(plan, R"("planId":"P1",)"));
    CHECK(HasText(plan, R"("status":"Pending","robotId":null,)"));
    CHECK(HasText(plan, R"("acceptedAt":")" + accepted + R"(","startedAt":null,"endedAt":null)"));
    CHECK(HasText(plan, R"("since":")" + accepted + R"(","queuePosition":1,"robots":[{"robotId":"LR01",)"));
    CHECK(HasText(plan, R"("jobs":[{"jobId":"P1-a4",)"));
    CHECK(HasText(reader.Get("/v1/queue"), R"({"plans":[{"position":1,"planId":"P1","priority":)"));
    reader.world.Submit(MakeLogisticsPlan("P0"));
    reader.world.Control(Planning::EPlanControl::Pause, "P1");
    CHECK(HasText(reader.Get("/v1/queue"), R"({"plans":[{"position":1,"planId":"P0","priority":)")); // P1 is held
    reader.world.Control(Planning::EPlanControl::Resume, "P1");
    reader.world.Control(Planning::EPlanControl::Cancel, "P0");
    CHECK_FALSE(HasText(reader.Get("/v1/plans"), R"("jobs":)"));
    CHECK(HasText(reader.Get("/v1/plans"), R"("steps":[{"stepNo":1,"action":)"));

    reader.world.Connect();
    REQUIRE(Testing::TryRunUntil(reader.world, "P1", "Job 1 P1-a4 InProgress"));
    plan = reader.Get("/v1/plans/P1");
    CHECK(HasText(plan, R"("status":"InProgress","robotId":"LR01","stepNo":1,"jobId":"P1-a4",)"));
    CHECK(HasText(plan, R"("waits":null)"));
    reader.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    reader.now += std::chrono::seconds(5);
    const std::string since = MakeTime(std::chrono::seconds(3'605));
    CHECK(HasText(reader.Get("/v1/plans/P1"), R"("since":)" + since));
    reader.now += std::chrono::seconds(60);
    CHECK(HasText(reader.Get("/v1/plans/P1"), R"("since":)" + since));
}

TEST_CASE("Plans are listed by state, robot and lot; finished ones with the last first")
{
    Reader reader;
    reader.world.Connect();
    for (const char* planID : {"P1", "P2"})
    {
        reader.world.Submit(MakeLogisticsPlan(planID));
        REQUIRE(reader.world.TryRun());
    }
    reader.world.Submit(MakeLogisticsPlan("P3"));
    REQUIRE(Testing::TryRunUntil(reader.world, "P3", "Plan InProgress"));
    reader.world.Submit(MakeLogisticsPlan("P4"));
    const auto has = [&reader](const std::string& query, const std::string& planID) {
        return HasText(reader.Get("/v1/plans" + query), R"("planId":")" + planID);
    };
    CHECK((has("", "P3") && has("", "P4") && !has("", "P1")));
    CHECK((has("?state=finished", "P1") && has("?state=finished", "P2") && !has("?state=finished", "P3")));
    CHECK((has("?state=finished&limit=1", "P2") && !has("?state=finished&limit=1", "P1")));
    CHECK(HasText(reader.Get("/v1/plans?state=finished"), R"({"plans":[{"planId":"P2")"));
    CHECK((has("?state=active", "P3") && !has("?state=waiting", "P3")));
    CHECK_FALSE(has("?robot=CR01", "P3"));
    CHECK_FALSE(has("?lot=none", "P3"));
    for (const char* query :
         {"?state=old", "?limit=0", "?limit=1001", "?limit=1x", "?robots=LR01", "?state=active&state=active"})
    {
        INFO(query);
        CHECK(HasText(reader.Get(std::string("/v1/plans") + query), "400 {\"error\":"));
    }
    CHECK(HasText(reader.Get("/v1/plans/P1"), R"("status":"Completed")"));
    CHECK(HasText(
        reader.Get("/v1/plans/P9"),
        "404 {\"error\":\"There is no plan \\\"P9\\\"; /v1/plans and acsctl plans list them.\"}"));
}

TEST_CASE("A robot is shown with pose, route, reservations, ports and what its driver reports")
{
    Reader reader;
    RobotLinkState link;
    link.driver = "vda5050";
    link.ports = {"LR01.CP01"};
    link.topicPrefix = "uagv/v2/ACS/LR01";
    link.details.warnings = {"wrong version"};
    link.details.protocolVersion = "2.0.0";
    link.details.mode = "MANUAL";
    link.details.errors = {{"bumper", "FATAL", "hit"}};
    reader.program.robots.emplace("LR01", link);
    CHECK(HasText(
        reader.Get("/v1/robots/LR01"),
        R"("driver":"vda5050","status":"Disconnected","position":"","node":null,"nextNode":null,"pose":null)"));
    CHECK(HasText(reader.Get("/v1/robots/LR01"), R"("reason":"LR01: no connection.")"));
    reader.world.Connect();
    REQUIRE(reader.world.TryRun());
    reader.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(reader.world, "P1", "Plan InProgress"));
    Planning::StateChanged state;
    state.bPoseKnown = true;
    state.x = -1000.00049;
    state.theta = std::numbers::pi; // rounded it would be no valid angle
    state.lastNodeID = "D-CHG01";
    state.bDriving = true;
    state.batteryPercent = 41.6;
    reader.world.Raise("LR01", state);
    const std::string robot = reader.Get("/v1/robots/LR01");
    CHECK(HasText(robot, R"("node":"D-CHG01","nextNode":"L)"));
    CHECK(HasText(robot, R"("pose":{"x":-1000,"y":0,"theta":3.141},"battery":42,"planId":"P1")"));
    CHECK(HasText(robot, R"("route":[{"nodeId":"L)"));
    CHECK(HasText(robot, R"(,"reserved":true})"));
    CHECK(HasText(robot, R"("reservedNodes":["D-CHG01",)"));
    CHECK(HasText(robot, R"("topic":"uagv/v2/ACS/LR01","protocolVersion":"2.0.0","mode":"MANUAL")"));
    CHECK(HasText(
        robot,
        R"("errors":[{"type":"bumper","level":"FATAL","description":"hit"}],"warnings":["wrong version"])"));
    for (const auto& [charge, shown] : {std::pair(1e300, 100), std::pair(-1e300, 0)})
    {
        state.batteryPercent = charge;
        reader.world.Raise("LR01", state);
        CHECK(HasText(reader.Get("/v1/robots/LR01"), R"("battery":)" + std::to_string(shown) + ","));
    }
    CHECK(HasText(reader.Get("/v1/robots/LR09"), "404 "));
    CHECK(HasText(reader.Get("/v1/robots?all=1"), "400 "));
}

TEST_CASE("An alarm is shown with its time, its cause, and a remedy that names its robot")
{
    Reader reader;
    reader.world.Connect();
    reader.world.Raise("LR01", Planning::LinkChanged{false});
    reader.now += std::chrono::seconds(5);
    std::string alarms = reader.Get("/v1/alarms");
    CHECK(HasText(alarms, R"({"alarms":[{"robotId":"LR01","errorCode":"ACS-1002","level":"heavy","title":)"));
    CHECK(HasText(alarms, R"("since":)" + MakeTime(std::chrono::seconds(3'605))));
    CHECK(HasText(alarms, "`acsctl robot LR01`"));
    reader.now += std::chrono::seconds(60);
    CHECK(HasText(reader.Get("/v1/alarms"), R"("since":)" + MakeTime(std::chrono::seconds(3'605))));
    CHECK(HasText(reader.Get("/v1/status"), R"("alarms":{"heavy":1,"light":0})"));
}

TEST_CASE("The commands of a remedy are quoted for a shell")
{
    Reader reader;
    Planning::Plan plan = MakeLogisticsPlan("$(touch X);x y");
    plan.steps[0].jobs[0].jobID = "J'1";
    Testing::BeginPlan(reader.world, std::move(plan), "Job 1 J'1 InProgress");
    reader.world.Raise("LR01", Planning::JobUnresolved{"J'1", "it was switched off"});
    CHECK(HasText(reader.Get("/v1/alarms"), R"(`acsctl resolve '$(touch X);x y' 'J'\\''1' done`)"));
}

TEST_CASE("The snapshot has everything with the number of its last event; the site has nodes, edges and stations")
{
    Reader reader;
    const std::string snapshot = reader.Get("/v1/snapshot");
    CHECK(HasText(snapshot, R"({"eventId":7,"status":{)"));
    CHECK(HasText(snapshot, R"(,"plans":[],"robots":[{"robotId":"LR01",)"));
    const std::string site = reader.Get("/v1/site");
    CHECK(HasText(site, R"({"nodes":[{"nodeId":)"));
    CHECK(HasText(site, R"("edges":[{"edgeId":)"));
    CHECK(HasText(site, R"("stations":[{"stationId":)"));
    CHECK(HasText(site, R"("blocked":[])"));
}

TEST_CASE("Changes name what differs between two states, and the plans that have ended")
{
    StateView before;
    before.plans.resize(2);
    before.plans[0].planID = "P1";
    before.plans[1].planID = "P2";
    before.robots.resize(2);
    before.robots[0].robotID = "LR01";
    before.robots[1].robotID = "LR02";
    CHECK(FindChanges(before, before).IsEmpty());
    StateView after = before;
    after.plans.erase(after.plans.begin());
    after.robots[1].battery = 50;
    StateChanges changes = FindChanges(before, after);
    CHECK(changes.endedPlanIDs == std::vector<std::string>{"P1"});
    CHECK(changes.plans.empty());
    REQUIRE(changes.robots.size() == 1);
    CHECK(changes.robots[0].robotID == "LR02");
    CHECK_FALSE(changes.status.has_value());
    CHECK_FALSE(changes.alarms.has_value());
    after.alarms.emplace_back();
    after.status.tsc = "Paused";
    changes = FindChanges(before, after);
    CHECK((changes.status.has_value() && changes.alarms.has_value()));
}

} // namespace ACS::Acsd::Test
