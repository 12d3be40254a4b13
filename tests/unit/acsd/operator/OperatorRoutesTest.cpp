#include "operator/OperatorRoutes.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "operator/AcsdStatus.hpp"
#include <acs/core/Timestamp.hpp>

#include <string>
#include <utility>

using namespace ACS; // NOLINT(google-build-using-namespace): a test of several of them
using Testing::MakeLogisticsPlan;
using Testing::PlanWorld;

namespace
{

/// An operator who calls the routes directly, without HTTP.
class Operator
{
    Apps::HttpRoutes _routes;

public:
    PlanWorld world{1, true};
    Planning::EInputAdmission admission = Planning::EInputAdmission::Accepted;
    std::chrono::seconds retryAfter{}; ///< Of the last answer.
    std::optional<std::string> storeFault;

    Operator()
    {
        Acsd::AddOperatorRoutes(
            _routes,
            *world.engine,
            {[this](const Planning::PlanCommand& command) {
                 if (admission == Planning::EInputAdmission::Accepted)
                 {
                     world.Ask(command);
                 }
                 return admission;
             },
             [this] {
                 return storeFault;
             }});
        world.Connect();
    }

    /// "202 …" with the body.
    std::string Post(std::string_view target, const std::string& body = {})
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
        request.method = "POST";
        request.body = body;
        const Apps::HttpResponse response = _routes.Respond(request);
        retryAfter = response.retryAfter;
        CHECK((response.status == 404 || response.contentType == "application/json"));
        return std::to_string(response.status) + " " + response.body;
    }

    [[nodiscard]] std::string GetStatus() const
    {
        return Acsd::MakeStatusResponse({{{"mcs", true}}, {}, {}}, *world.engine).body;
    }
};

bool HasText(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("/status shows links, not-ready reasons, the outbox with its oldest time, and which arms are ready")
{
    PlanWorld world{1, true};
    world.bAcknowledges = false;
    const auto getStatus = [&world] {
        return Acsd::MakeStatusResponse(
                   {{{"mcs", true}, {"mqtt", false}}, {"the store cannot be written"}, {{"CR01", true}}},
                   *world.engine)
            .body;
    };
    CHECK(HasText(getStatus(), R"("links":{"mcs":true,"mqtt":false},"obstacles":["the store cannot be written"])"));
    CHECK(HasText(getStatus(), R"("outbox":{"reports":0,"oldest":null})"));
    CHECK(HasText(getStatus(), R"("armUp":null)"));
    CHECK(HasText(getStatus(), R"("armUp":true)"));
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    const std::vector<Planning::OutboxEntry> waiting = world.engine->GetUnacknowledged();
    REQUIRE_FALSE(waiting.empty());
    const std::string time = Core::FormatUTC(waiting.front().time);
    CHECK(HasText(
        getStatus(),
        R"("outbox":{"reports":)" + std::to_string(waiting.size()) + R"(,"oldest":")" + time + R"("})"));
}

TEST_CASE("/status shows where a robot is, why one without a plan is not available, and where it is expected")
{
    PlanWorld world{1, true};
    const auto getStatus = [&world] {
        Acsd::ProgramStatus program{{{"mcs", true}}, {}, {}};
        program.vehicles.emplace("LR01", Acsd::VehicleStatus{"uagv/v2/ACS/LR01", {"wrong version"}});
        return Acsd::MakeStatusResponse(program, *world.engine).body;
    };
    CHECK(HasText(getStatus(), R"("node":null,"nextNode":null)"));
    CHECK(HasText(
        getStatus(),
        R"("reason":"LR01: no connection.","topic":"uagv/v2/ACS/LR01","warnings":["wrong version"])"));
    CHECK(HasText(getStatus(), R"("reason":"LR02: no connection.","topic":null,"warnings":[])"));
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(HasText(getStatus(), R"("node":"D-CHG01","nextNode":null)"));
    CHECK(HasText(getStatus(), R"("reason":null,"topic":"uagv/v2/ACS/LR01")"));
    CHECK_FALSE(HasText(getStatus(), "no connection"));

    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(world, "P1", "Plan InProgress"));
    Planning::StateChanged state;
    state.bPoseKnown = true;
    state.x = -1000;
    state.lastNodeID = "D-CHG01";
    state.bDriving = true;
    world.Raise("LR01", state);
    CHECK(HasText(getStatus(), R"("node":"D-CHG01","nextNode":"L)"));
}

TEST_CASE("/status shows a charge as a percentage, whatever a robot reports")
{
    Operator user;
    Planning::StateChanged state;
    state.bPoseKnown = true;
    state.bAutomatic = true;
    state.lastNodeID = "N001";
    for (const auto& [charge, shown] : {std::pair(1e300, 100), std::pair(-1e300, 0), std::pair(41.6, 42)})
    {
        state.batteryPercent = charge;
        user.world.Raise("LR01", state);
        CHECK(HasText(user.GetStatus(), R"("battery":)" + std::to_string(shown) + ","));
    }
}

TEST_CASE("Requests need an address or a configured host name; web pages are refused")
{
    const Apps::HttpGuard guard = Acsd::MakeHttpGuard({{"acs.local", 8080}, {"acs.example"}});
    const auto bServed = [&guard](const std::string& method, const std::string& path, const Apps::HttpSource& source) {
        Apps::HttpRequest request = *Apps::ParseHttpTarget(path);
        request.method = method;
        return !guard.GetRejectionReasonOrNull(request, source).has_value();
    };
    for (const char* host : {"127.0.0.1:8080", "acs.local:8080", "acs.example"})
    {
        CHECK(bServed("POST", "/tsc/pause", {host, {}, {}}));
        CHECK_FALSE(bServed("POST", "/tsc/pause", {host, "http://evil.example", {}}));
    }
    CHECK_FALSE(bServed("POST", "/tsc/pause", {"evil.example", {}, {}}));
    for (const char* path : {"/status", "/livez", "/readyz", "/metrics"})
    {
        CHECK_FALSE(bServed("GET", path, {"evil.example", {}, {}}));
        CHECK(bServed("GET", path, {"acs.example", {}, {}}));
    }
}

TEST_CASE("/readyz and /status show why a link is down, /status the report that the MCS refused last")
{
    PlanWorld world{1, true};
    Acsd::ProgramStatus program{
        {{"mcs", false, "connected, not registered: mcs: registration refused"}, {"mqtt", false}},
        {"acsd draining for shutdown"},
        {}};
    const std::string ready = Acsd::MakeReadyResponse(program.links, program.obstacles).body;
    CHECK(
        ready
        == "connected, not registered: mcs: registration refused\nno connection: mqtt\n"
           "acsd draining for shutdown\n");
    std::string status = Acsd::MakeStatusResponse(program, *world.engine).body;
    CHECK(HasText(
        status,
        R"("obstacles":["connected, not registered: mcs: registration refused","acsd draining for shutdown"])"));
    CHECK(HasText(status, R"("refusedReports":{"count":0,"last":null})"));
    program.refusedReports = {3, "JobReport", "P1", "unknown job"};
    status = Acsd::MakeStatusResponse(program, *world.engine).body;
    CHECK(HasText(
        status,
        R"("refusedReports":{"count":3,"last":{"command":"JobReport","planId":"P1","message":"unknown job"}})"));
    program.refusedReports.planID.clear();
    CHECK(HasText(Acsd::MakeStatusResponse(program, *world.engine).body, R"("planId":null,"message":"unknown job")"));
}

TEST_CASE("POST /robots/ID/maintenance/on and off; /status shows it and why a plan waits for it")
{
    Operator user;
    CHECK(user.Post("/robots/LR01/maintenance/on") == "202 {\"message\":\"LR01 is taken out of service.\"}\n");
    CHECK(HasText(user.Post("/robots/LR02/maintenance/on"), "202 "));
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(user.world.TryRun());
    const std::string status = user.GetStatus();
    CHECK(HasText(status, R"("robotId":"LR01","type":"LR","status":"Stopped")"));
    CHECK(HasText(status, R"("battery":null,"armUp":null,"maintenance":true)"));
    CHECK(HasText(
        status,
        R"("waits":{"message":"No suitable robot is free.","queuePosition":1,"robots":[{"robotId":"LR01",)"
        R"("reason":"in maintenance"},{"robotId":"LR02","reason":"in maintenance"}]}})"));
    CHECK(HasText(user.Post("/robots/LR01/maintenance/off"), "202 "));
    REQUIRE(user.world.TryRun());
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(
        user.Post("/robots/LR09/maintenance/on")
        == "404 {\"error\":\"There is no robot LR09; /status lists the robots.\"}\n");
    CHECK(HasText(user.Post("/robots/LR01/maintenance/maybe"), "404 "));
}

TEST_CASE("POST /robots/ID/maintenance/on states what the robot completes first")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Plan InProgress"));
    CHECK(
        HasText(user.Post("/robots/LR01/maintenance/on"), "\"LR01 is taken out of service when plan P1 has ended.\""));
    user.Post("/robots/LR01/maintenance/off");
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Plan Completed"));
    REQUIRE(user.world.engine->GetRobotDetails().front().bHasDrive); // to its parking position
    CHECK(HasText(
        user.Post("/robots/LR01/maintenance/on"),
        "\"LR01 is taken out of service when it has completed its drive.\""));
    REQUIRE(user.world.TryRun());
    CHECK(HasText(user.GetStatus(), R"("robotId":"LR01","type":"LR","status":"Stopped")"));
    CHECK(HasText(user.Post("/robots/LR01/maintenance/on"), "\"LR01 is taken out of service.\""));
}

TEST_CASE("POST /robots/ID/carriers corrects the record of the ports, in their order")
{
    Operator user;
    CHECK(
        user.Post("/robots/CR01/carriers?carrier=TRAY_01&carrier=&carrier=TRAY%2003")
        == "202 {\"message\":\"The ports of CR01 are corrected.\"}\n");
    CHECK(HasText(user.GetStatus(), R"("carrierIds":["TRAY_01",null,"TRAY 03"])"));
    CHECK(HasText(user.Post("/robots/CR01/carriers?carrier=A"), "400 {\"error\":\"CR01 has 3 carrier ports"));
    CHECK(HasText(user.Post("/robots/LR01/carriers?carriers=A"), "400 {\"error\":\"Unknown parameter carriers"));
    CHECK(HasText(user.Post("/robots/LR02/carriers?carrier=TRAY_01"), "TRAY_01 is on CR01"));
    CHECK(HasText(
        user.Post("/robots/LR01/carriers?carrier=%FF%FE"),
        "400 {\"error\":\"The parameter carrier is not valid UTF-8"));
    CHECK(HasText(user.Post("/robots/LR09/carriers"), "404 "));
    CHECK(HasText(user.GetStatus(), R"("carrierIds":["TRAY_01",null,"TRAY 03"])"));
}

TEST_CASE("POST /plans/PLAN/jobs/JOB/done, failed and again resolve an unresolved job, and no other")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(HasText(
        user.Post("/plans/P1/jobs/P1-a4/done"),
        "404 {\"error\":\"LR01 is connected and will report the outcome of the job."));
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-zz/done"), "404 {\"error\":\"No robot has job P1-zz of plan P1."));
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    CHECK(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    CHECK(HasText(user.GetStatus(), R"("planId":"P1","stepNo":1,"jobId":"P1-a4"})"));
    CHECK(HasText(
        user.GetStatus(),
        "then answer done (the plan continues with the next job), failed (the plan fails) or again (the job was not done and "
        "nothing was moved: it is repeated). Or skip the step (the plan continues with the next step, and the job has no "
        "further report), or abort the plan from the MCS. To resolve the job, send POST /plans/P1/jobs/P1-a4/done to "
        "acsd's HTTP address, with the answer in the place of done. To skip the step, send POST /plans/P1/steps/1/skip."));
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-b2/done"), "404 "));
    CHECK(HasText(user.Post("/plans/P2/jobs/P1-a4/again"), "404 "));
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-a4/done"), "202 "));
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-a4/failed"), "404 "));
    REQUIRE(user.world.TryRun());
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("POST /plans/PLAN/steps/NO/skip skips a step that is Pending or whose job is unresolved, and no other")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    CHECK(HasText(user.Post("/plans/P1/steps/1/skip"), "409 {\"error\":\"Plan P1 has no robot yet"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(HasText(user.Post("/plans/P9/steps/1/skip"), "404 {\"error\":\"There is no plan P9."));
    CHECK(HasText(user.Post("/plans/P1/steps/9/skip"), "409 {\"error\":\"Plan P1 has no step 9."));
    CHECK(HasText(user.Post("/plans/P1/steps/1/skip"), "409 {\"error\":\"Step 1 is InProgress"));
    for (const std::string number : {"one", "1x", "%201", "99999999999"})
    {
        CHECK(HasText(user.Post("/plans/P1/steps/" + number + "/skip"), "400 {\"error\":\"Expected a stepNo"));
    }
    user.storeFault = "the store cannot be written";
    CHECK(HasText(user.Post("/plans/P1/steps/2/skip"), "503 "));
    user.storeFault.reset();
    CHECK(user.Post("/plans/P1/steps/2/skip") == "202 {\"message\":\"Step 2 of plan P1 is skipped.\"}\n");
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    CHECK(HasText(user.Post("/plans/P1/steps/1/skip"), "202 "));
    CHECK_FALSE(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(HasText(user.Post("/plans/P1/steps/1/skip"), "409 {\"error\":\"Plan P1 is already Completed."));
}

TEST_CASE("Unknown and repeated parameters and a body are refused by name")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    for (const std::string target :
         {"/tsc/pause",
          "/tsc/resume",
          "/robots/LR02/maintenance/on",
          "/robots/LR02/maintenance/off",
          "/robots/LR02/carriers",
          "/alarms/clear",
          "/plans/P1/jobs/P1-a4/done",
          "/plans/P1/jobs/P1-a4/failed",
          "/plans/P1/jobs/P1-a4/again",
          "/plans/P1/steps/2/skip"})
    {
        INFO(target);
        CHECK(HasText(user.Post(target + "?force=1"), "400 {\"error\":\"Unknown parameter force; "));
        CHECK(
            HasText(user.Post(target, R"({"force":true})"), R"(400 {"error":"Expected no body, found \"{\"force\":)"));
    }
    CHECK(
        user.Post("/tsc/pause?now") == "400 {\"error\":\"Unknown parameter now; this request has no parameters.\"}\n");
    CHECK(HasText(user.Post("/alarms/clear?step=1"), "known: robot, code, plan, job."));
    CHECK(HasText(
        user.Post("/alarms/clear?robot=LR01&code=A&robot=LR02"),
        "400 {\"error\":\"The parameter robot is given twice"));
    CHECK(user.world.engine->GetTscState() == Planning::ETscState::Auto);
    CHECK_FALSE(HasText(user.GetStatus(), R"("maintenance":true)"));
}

TEST_CASE("While acsd stops, commands of the operator are refused")
{
    Operator user;
    user.admission = Planning::EInputAdmission::Closed;
    for (const char* target :
         {"/tsc/pause", "/tsc/resume", "/robots/LR01/maintenance/on", "/robots/LR01/carriers?carrier="})
    {
        INFO(target);
        CHECK(HasText(user.Post(target), "503 {\"error\":\"acsd is stopping"));
        CHECK(user.retryAfter.count() == 0);
    }
}

TEST_CASE("While too many commands wait for the store, further ones are refused, with the time to wait")
{
    Operator user;
    user.admission = Planning::EInputAdmission::Full;
    CHECK(
        user.Post("/tsc/pause")
        == "503 {\"error\":\"Refused, because acsd has not stored earlier commands yet. Retry in 1 s.\"}\n");
    CHECK(user.retryAfter.count() == 1);
    CHECK(user.world.engine->GetTscState() == Planning::ETscState::Auto);
}

TEST_CASE(
    "While the store fails, commands are refused, except those that stop work, whose answer states that they are not stored")
{
    Operator user;
    user.world.Raise("LR01", Planning::LinkChanged{false});
    user.world.Submit(MakeLogisticsPlan("P1"));
    user.storeFault = "the store cannot be written";
    for (const char* target :
         {"/tsc/resume",
          "/robots/LR01/maintenance/off",
          "/robots/LR01/carriers?carrier=C_01",
          "/alarms/clear?robot=LR01&code=ACS-1002"})
    {
        INFO(target);
        CHECK(
            user.Post(target)
            == "503 {\"error\":\"Refused, because it would be lost in a crash: the store cannot be written. Retry when "
               "/readyz answers ready.\"}\n");
    }
    CHECK_FALSE(HasText(user.GetStatus(), R"("carrierIds":["C_01"])"));
    CHECK(
        user.Post("/robots/LR02/maintenance/on")
        == "202 {\"message\":\"LR02 is taken out of service. This is not stored and would be lost in a crash: the store "
           "cannot be written. After a restart, check /status and repeat the request if necessary.\"}\n");
    CHECK(HasText(user.GetStatus(), R"("maintenance":true)"));
    CHECK(HasText(
        user.Post("/tsc/pause"),
        "202 {\"message\":\"The TSC was commanded to pause; /status shows its state. This is not"));
    CHECK(user.world.engine->GetTscState() == Planning::ETscState::Paused);
    user.storeFault.reset();
    CHECK(
        user.Post("/tsc/resume")
        == "202 {\"message\":\"The TSC was commanded to resume; /status shows its state.\"}\n");
}

TEST_CASE("The resolution of a job waits for the store")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    user.storeFault = "the store cannot be written";
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-a4/done"), "503 "));
    CHECK(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    user.storeFault.reset();
    CHECK(HasText(user.Post("/plans/P1/jobs/P1-a4/done"), "202 "));
}

TEST_CASE("POST /alarms/clear clears by robot and code")
{
    Operator user;
    user.world.Raise("LR01", Planning::LinkChanged{false});
    CHECK(HasText(user.Post("/alarms/clear?robot=LR01&code=ACS-1002"), "202 "));
    CHECK(
        user.world.GetReportsOf("-")
        == std::vector<std::string>{"Error ACS-1002 set", "Error ACS-1002 cleared", "Error ACS-1002 set"});
    CHECK(HasText(user.Post("/alarms/clear?robot=LR01&code=ACS-1004"), "404 {\"error\":\"LR01 has no alarm ACS-1004"));
    CHECK(HasText(user.Post("/alarms/clear?robot=LR01"), "400 {\"error\":\"The parameters robot and code"));
    CHECK(HasText(user.Post("/alarms/clear?robot=LR01&code=ACS-1002&step=1"), "400 "));
}
