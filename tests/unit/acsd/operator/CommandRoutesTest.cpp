#include "operator/CommandRoutes.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "view/StateViewMaker.hpp"
#include "view/ViewCodec.hpp"

#include <optional>
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

private:
    Acsd::StateViewMaker _maker{*world.engine, Core::WallTime()};

public:
    Planning::EInputAdmission admission = Planning::EInputAdmission::Accepted;
    std::chrono::seconds retryAfter{}; ///< Of the last answer.
    std::optional<std::string> storeFault;
    std::optional<Planning::CommandReceipt> receipt; ///< Of the last command.

    Operator()
    {
        Acsd::AddCommandRoutes(
            _routes,
            *world.engine,
            {[this](const Planning::PlanCommand& command, std::optional<Planning::CommandReceipt> receiptOrNull) {
                 receipt = std::move(receiptOrNull);
                 if (admission == Planning::EInputAdmission::Accepted)
                 {
                     world.Ask(command);
                 }
                 return admission;
             },
             [](const Apps::HttpResponse& answer) {
                 return Planning::CommandReceipt{"lee", "k", answer.body, {}};
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

    /// All views in one text.
    [[nodiscard]] std::string GetStatus()
    {
        Acsd::ProgramState program;
        program.links.push_back({"mcs", true});
        return Acsd::EncodeSnapshot(_maker.Make(program, Core::WallTime()), 0, Core::WallTime());
    }
};

constexpr const char* ON = R"({"on":true})";
constexpr const char* OFF = R"({"on":false})";
constexpr const char* DONE = R"({"outcome":"done"})";
constexpr const char* FAILED = R"({"outcome":"failed"})";
constexpr const char* AGAIN = R"({"outcome":"again"})";
constexpr const char* CLEAR = R"({"robotId":"LR01","errorCode":"ACS-1002"})";

bool HasText(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("POST /v1/robots/ID/maintenance; the robot shows it and why a plan waits for it")
{
    Operator user;
    CHECK(user.Post("/v1/robots/LR01/maintenance", ON) == "202 {\"message\":\"LR01 is taken out of service.\"}\n");
    CHECK(HasText(user.Post("/v1/robots/LR02/maintenance", ON), "202 "));
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(user.world.TryRun());
    const std::string status = user.GetStatus();
    CHECK(HasText(status, R"("robotId":"LR01","type":"LR","driver":"","status":"Stopped")"));
    CHECK(HasText(status, R"("maintenance":true)"));
    CHECK(HasText(
        status,
        R"("queuePosition":1,"robots":[{"robotId":"LR01","reason":"in maintenance"},)"
        R"({"robotId":"LR02","reason":"in maintenance"}]})"));
    CHECK(HasText(user.Post("/v1/robots/LR01/maintenance", OFF), "202 "));
    REQUIRE(user.world.TryRun());
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(
        user.Post("/v1/robots/LR09/maintenance", ON)
        == "404 {\"error\":\"There is no robot \\\"LR09\\\"; /v1/robots and acsctl robots list them.\"}\n");
    CHECK(HasText(user.Post("/v1/robots/LR01/maintenance", R"({"on":"maybe"})"), "400 "));
}

TEST_CASE("POST /v1/robots/ID/maintenance states what the robot completes first")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Plan InProgress"));
    CHECK(HasText(
        user.Post("/v1/robots/LR01/maintenance", ON),
        "\"LR01 is taken out of service when plan P1 has ended.\""));
    user.Post("/v1/robots/LR01/maintenance", OFF);
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Plan Completed"));
    REQUIRE(user.world.engine->GetRobotDetails().front().bHasDrive); // to its parking position
    CHECK(HasText(
        user.Post("/v1/robots/LR01/maintenance", ON),
        "\"LR01 is taken out of service when it has completed its drive.\""));
    REQUIRE(user.world.TryRun());
    CHECK(HasText(user.GetStatus(), R"("robotId":"LR01","type":"LR","driver":"","status":"Stopped")"));
    CHECK(HasText(user.Post("/v1/robots/LR01/maintenance", ON), "\"LR01 is taken out of service.\""));
}

TEST_CASE("POST /v1/robots/ID/carriers corrects the record of the ports, in their order")
{
    Operator user;
    CHECK(
        user.Post("/v1/robots/CR01/carriers", R"({"carrierIds":["TRAY_01",null,"TRAY 03"]})")
        == "202 {\"message\":\"The ports of CR01 are corrected.\"}\n");
    CHECK(HasText(user.GetStatus(), R"("carrierIds":["TRAY_01",null,"TRAY 03"])"));
    CHECK(HasText(
        user.Post("/v1/robots/CR01/carriers", R"({"carrierIds":["A"]})"),
        "400 {\"error\":\"CR01 has 3 carrier ports"));
    CHECK(HasText(user.Post("/v1/robots/LR01/carriers", R"({"carriers":["A"]})"), "400 {\"error\":\"Invalid body: "));
    CHECK(HasText(user.Post("/v1/robots/LR02/carriers", R"({"carrierIds":["TRAY_01"]})"), "TRAY_01 is on CR01"));
    CHECK(HasText(user.Post("/v1/robots/LR01/carriers", "{\"carrierIds\":[\"\xFF\xFE\"]}"), "400 "));
    CHECK(HasText(user.Post("/v1/robots/LR09/carriers", R"({"carrierIds":[]})"), "404 "));
    CHECK(HasText(user.GetStatus(), R"("carrierIds":["TRAY_01",null,"TRAY 03"])"));
}

TEST_CASE("POST /v1/plans/PLAN/jobs/JOB/resolve resolves an unresolved job, and no other")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(HasText(
        user.Post("/v1/plans/P1/jobs/P1-a4/resolve", DONE),
        "404 {\"error\":\"LR01 is connected and will report the outcome of the job."));
    CHECK(HasText(
        user.Post("/v1/plans/P1/jobs/P1-zz/resolve", DONE),
        "404 {\"error\":\"There is no job \\\"P1-zz\\\" of a plan \\\"P1\\\"."));
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    CHECK(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    CHECK(HasText(user.GetStatus(), R"("planId":"P1","stepNo":1,"jobId":"P1-a4"})"));
    CHECK(HasText(
        user.GetStatus(),
        "then answer done (the plan continues with the next job), failed (the plan fails) or again (the job was not done and "
        "nothing was moved: it is repeated). Or skip the step (the plan continues with the next step, and the job has no "
        "further report), or abort the plan from the MCS."));
    CHECK(HasText(user.Post("/v1/plans/P1/jobs/P1-b2/resolve", DONE), "404 "));
    CHECK(HasText(user.Post("/v1/plans/P2/jobs/P1-a4/resolve", AGAIN), "404 "));
    CHECK(HasText(user.Post("/v1/plans/P1/jobs/P1-a4/resolve", DONE), "202 "));
    CHECK(HasText(user.Post("/v1/plans/P1/jobs/P1-a4/resolve", FAILED), "404 "));
    REQUIRE(user.world.TryRun());
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A command has the receipt of its answer, unless the store cannot be written")
{
    Operator user;
    const std::string answer = user.Post("/v1/robots/LR01/maintenance", R"({"on":true})");
    REQUIRE(HasText(answer, "202 "));
    REQUIRE(user.receipt.has_value());
    CHECK("202 " + user.receipt->answer == answer);
    user.storeFault = "the store cannot be written";
    REQUIRE(HasText(user.Post("/v1/tsc/pause"), "202 "));
    CHECK_FALSE(user.receipt.has_value());
}

TEST_CASE("POST /v1/plans/PLAN/steps/NO/skip skips a step that is Pending or whose job is unresolved, and no other")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    CHECK(HasText(user.Post("/v1/plans/P1/steps/1/skip"), "409 {\"error\":\"Plan P1 has no robot yet"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(HasText(user.Post("/v1/plans/P9/steps/1/skip"), "404 {\"error\":\"There is no plan \\\"P9\\\"; "));
    CHECK(HasText(user.Post("/v1/plans/P1/steps/9/skip"), "404 {\"error\":\"Plan P1 has no step 9."));
    CHECK(HasText(user.Post("/v1/plans/P1/steps/1/skip"), "409 {\"error\":\"Step 1 is InProgress"));
    for (const std::string number : {"one", "1x", "%201", "99999999999", "-1", "0"})
    {
        CHECK(HasText(user.Post("/v1/plans/P1/steps/" + number + "/skip"), "400 {\"error\":\"Expected a stepNo"));
    }
    user.storeFault = "the store cannot be written";
    CHECK(HasText(user.Post("/v1/plans/P1/steps/2/skip"), "503 "));
    user.storeFault.reset();
    CHECK(user.Post("/v1/plans/P1/steps/2/skip") == "202 {\"message\":\"Step 2 of plan P1 is skipped.\"}\n");
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    CHECK(HasText(user.Post("/v1/plans/P1/steps/1/skip"), "202 "));
    CHECK_FALSE(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(HasText(user.Post("/v1/plans/P1/steps/1/skip"), "409 {\"error\":\"Plan P1 is already Completed."));
}

TEST_CASE("POST /v1/plans/PLAN/pause, resume, abort and cancel control a plan like the MCS, without a result report")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    CHECK(HasText(user.Post("/v1/plans/P1/resume"), "409 {\"error\":"));
    CHECK(HasText(user.Post("/v1/plans/P9/abort"), "404 {\"error\":"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Plan InProgress"));
    CHECK(
        user.Post("/v1/plans/P1/pause", R"({"reason":"door"})")
        == "202 {\"message\":\"Pause of plan P1 is accepted; /v1/plans shows its effect.\"}\n");
    REQUIRE(user.world.TryRun());
    CHECK(HasText(user.GetStatus(), R"("status":"Paused")"));
    CHECK(HasText(user.Post("/v1/plans/P1/resume"), "202 "));
    REQUIRE(user.world.TryRun());
    CHECK(user.world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(HasText(user.Post("/v1/plans/P1/cancel"), "409 {\"error\":"));
    user.storeFault = "the store cannot be written";
    user.world.Submit(MakeLogisticsPlan("P2"));
    CHECK(HasText(user.Post("/v1/plans/P2/cancel"), "503 "));
    CHECK(HasText(user.Post("/v1/plans/P2/cancel", R"({"reason":1})"), "400 "));
}

TEST_CASE("POST /v1/plans/PLAN/priority changes the order of the queue")
{
    Operator user;
    CHECK(HasText(user.Post("/v1/robots/LR01/maintenance", ON), "202 "));
    CHECK(HasText(user.Post("/v1/robots/LR02/maintenance", ON), "202 "));
    user.world.Submit(MakeLogisticsPlan("P1"));
    user.world.Submit(MakeLogisticsPlan("P2"));
    std::string status = user.GetStatus();
    CHECK(status.find(R"("planId":"P1")") < status.find(R"("planId":"P2")"));
    const std::optional<std::int32_t> usual = user.world.engine->GetPlanRecordOrNull("P1")->GetPriorityOrNull();
    CHECK(
        user.Post("/v1/plans/P2/priority", R"({"priority":100})")
        == "202 {\"message\":\"The priority of plan P2 is 100.\"}\n");
    CHECK(
        user.Post("/v1/plans/P1/priority", R"({"priority":-100})")
        == "202 {\"message\":\"The priority of plan P1 is -100.\"}\n");
    status = user.GetStatus();
    CHECK(status.find(R"("planId":"P2")") != status.find(R"("planId":"P1")"));
    CHECK(HasText(status, R"("priority":100)"));
    CHECK(user.world.engine->GetPlanRecordOrNull("P1")->GetPriorityOrNull() != usual);
    CHECK(HasText(user.Post("/v1/plans/P9/priority", R"({"priority":1})"), "404 "));
    CHECK(HasText(user.Post("/v1/plans/P1/priority", R"({"priority":1.5})"), "400 "));
    CHECK(HasText(user.Post("/v1/plans/P1/priority"), "400 "));
}

TEST_CASE("POST /v1/site/block allows a reason of the length that the engine allows")
{
    Operator user;
    const auto makeBlock = [](std::size_t length) {
        return R"({"kind":"station","id":"CHG02","reason":")" + std::string(length, 'x') + R"("})";
    };
    CHECK(HasText(user.Post("/v1/site/block", makeBlock(Planning::MAXIMUM_REASON_LENGTH + 1)), "400 "));
    CHECK(HasText(user.Post("/v1/site/block", makeBlock(Planning::MAXIMUM_REASON_LENGTH)), "202 "));
}

TEST_CASE("POST /v1/site/block and unblock close and open a place of the map")
{
    Operator user;
    const std::string block = R"({"kind":"station","id":"CHG01","reason":"wet floor"})";
    CHECK(user.Post("/v1/site/block", block) == "202 {\"message\":\"The station CHG01 is blocked.\"}\n");
    REQUIRE(user.world.engine->GetBlocks().size() == 1);
    CHECK(user.world.engine->GetBlocks().front().reason == "wet floor");
    CHECK(HasText(user.GetStatus(), R"("siteRevision":1)"));
    CHECK(HasText(user.Post("/v1/site/block", block), "409 {\"error\":"));
    for (const char* path : {"/v1/site/block", "/v1/site/unblock"})
    {
        for (const std::string kind : {"node", "edge", "station"})
        {
            CAPTURE(path, kind);
            CHECK(HasText(
                user.Post(path, "{\"kind\":\"" + kind + R"(","id":"none"})"),
                "404 {\"error\":\"There is no " + kind + R"( \"none\"; /v1/site lists them.)"));
        }
    }
    CHECK(HasText(
        user.Post("/v1/site/block", R"({"kind":"robot","id":"LR01"})"),
        "400 {\"error\":\"Expected kind: node, edge or station; found \\\"robot\\\"."));
    CHECK(HasText(user.Post("/v1/site/unblock", block), "400 {\"error\":\"Invalid body"));
    user.storeFault = "the store cannot be written";
    CHECK(HasText(user.Post("/v1/site/unblock", R"({"kind":"station","id":"CHG01"})"), "503 "));
    user.storeFault.reset();
    CHECK(HasText(user.Post("/v1/site/unblock", R"({"kind":"station","id":"CHG01"})"), "202 "));
    CHECK(user.world.engine->GetBlocks().empty());
    CHECK(HasText(user.GetStatus(), R"("siteRevision":2)"));
    CHECK(HasText(user.Post("/v1/site/unblock", R"({"kind":"station","id":"CHG01"})"), "409 "));
}

TEST_CASE("An unknown id is quoted and cut in the answer")
{
    Operator user;
    const std::string longID = "%1B" + std::string(9'000, 'x');
    const std::string body = R"({"robotId":"\u001b)" + std::string(9'000, 'x') + R"(","errorCode":"E"})";
    for (const std::string& answer :
         {user.Post("/v1/robots/" + longID + "/maintenance", ON),
          user.Post("/v1/robots/" + longID + "/carriers", R"({"carrierIds":[]})"),
          user.Post("/v1/alarms/clear", body),
          user.Post("/v1/plans/" + longID + "/abort"),
          user.Post("/v1/plans/" + longID + "/priority", R"({"priority":1})"),
          user.Post("/v1/plans/" + longID + "/steps/1/skip"),
          user.Post(std::string("/v1/plans/").append(longID).append("/jobs/").append(longID).append("/resolve"), DONE),
          user.Post("/v1/site/block", R"({"kind":"node","id":"\u001b)" + std::string(9'000, 'x') + R"("})")})
    {
        CAPTURE(answer.substr(0, 300));
        CHECK(HasText(answer, "404 "));
        CHECK(answer.size() < 500);
        CHECK(answer.find("u001b") == std::string::npos);
    }
}

TEST_CASE("Parameters in the query, unknown and repeated members and invalid bodies are refused by name")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    for (const std::string target :
         {"/v1/tsc/pause",
          "/v1/tsc/resume",
          "/v1/robots/LR02/maintenance",
          "/v1/robots/LR02/carriers",
          "/v1/alarms/clear",
          "/v1/plans/P1/jobs/P1-a4/resolve",
          "/v1/plans/P1/steps/2/skip"})
    {
        INFO(target);
        CHECK(HasText(user.Post(target + "?force=1"), "400 {\"error\":\"Unknown parameter \\\"force\\\"; "));
        for (const std::string body : {R"({"force":true})", "[]", "on", R"({"on":true,"on":false})", "{\"on\":true}}"})
        {
            INFO(body);
            CHECK(HasText(user.Post(target, body), "400 {\"error\":\"Invalid body: "));
        }
    }
    CHECK(HasText(user.Post("/v1/tsc/pause?now"), "; this request has no parameters."));
    CHECK(HasText(
        user.Post("/v1/plans/P1/jobs/P1-a4/resolve", R"({"outcome":"perhaps"})"),
        "400 {\"error\":\"Expected outcome: done, failed or again; found \\\"perhaps\\\"."));
    CHECK(user.world.engine->GetTscState() == Planning::ETscState::Auto);
    CHECK_FALSE(HasText(user.GetStatus(), R"("maintenance":true)"));
}

TEST_CASE("While acsd stops, commands of the operator are refused")
{
    Operator user;
    user.admission = Planning::EInputAdmission::Closed;
    for (const auto& [target, body] :
         {std::pair("/v1/tsc/pause", ""),
          std::pair("/v1/tsc/resume", ""),
          std::pair("/v1/robots/LR01/maintenance", ON),
          std::pair("/v1/robots/LR01/carriers", R"({"carrierIds":[null]})")})
    {
        INFO(target);
        CHECK(HasText(user.Post(target, body), "503 {\"error\":\"acsd is stopping"));
        CHECK(user.retryAfter.count() == 0);
    }
}

TEST_CASE("While too many commands wait for the store, further ones are refused, with the time to wait")
{
    Operator user;
    user.admission = Planning::EInputAdmission::Full;
    CHECK(
        user.Post("/v1/tsc/pause")
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
    for (const auto& [target, body] :
         {std::pair("/v1/tsc/resume", ""),
          std::pair("/v1/robots/LR01/maintenance", OFF),
          std::pair("/v1/robots/LR01/carriers", R"({"carrierIds":["C_01"]})"),
          std::pair("/v1/alarms/clear", CLEAR)})
    {
        INFO(target);
        CHECK(
            user.Post(target, body)
            == "503 {\"error\":\"Refused, because it would be lost in a crash: the store cannot be written. Retry when "
               "/readyz answers ready.\"}\n");
    }
    CHECK_FALSE(HasText(user.GetStatus(), R"("carrierIds":["C_01"])"));
    CHECK(
        user.Post("/v1/robots/LR02/maintenance", ON)
        == "202 {\"message\":\"LR02 is taken out of service. This is not stored and would be lost in a crash: the store "
           "cannot be written. It may take effect only when the store answers. Check /v1/status, also after a restart, and repeat the "
           "request if necessary.\"}\n");
    CHECK(HasText(user.GetStatus(), R"("maintenance":true)"));
    CHECK(HasText(
        user.Post("/v1/tsc/pause"),
        "202 {\"message\":\"The TSC was commanded to pause; /v1/status shows its state. This is not"));
    CHECK(user.world.engine->GetTscState() == Planning::ETscState::Paused);
    user.storeFault.reset();
    CHECK(
        user.Post("/v1/tsc/resume")
        == "202 {\"message\":\"The TSC was commanded to resume; /v1/status shows its state.\"}\n");
}

TEST_CASE("The resolution of a job waits for the store")
{
    Operator user;
    user.world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(Testing::TryRunUntil(user.world, "P1", "Job 1 P1-a4 InProgress"));
    user.world.Raise("LR01", Planning::JobUnresolved{"P1-a4", "it was switched off"});
    user.storeFault = "the store cannot be written";
    CHECK(HasText(user.Post("/v1/plans/P1/jobs/P1-a4/resolve", DONE), "503 "));
    CHECK(HasText(user.GetStatus(), R"("errorCode":"ACS-1008")"));
    user.storeFault.reset();
    CHECK(HasText(user.Post("/v1/plans/P1/jobs/P1-a4/resolve", DONE), "202 "));
}

TEST_CASE("POST /v1/alarms/clear clears by robot and code")
{
    Operator user;
    user.world.Raise("LR01", Planning::LinkChanged{false});
    CHECK(HasText(user.Post("/v1/alarms/clear", CLEAR), "202 "));
    CHECK(
        user.world.GetReportsOf("-")
        == std::vector<std::string>{"Error ACS-1002 set", "Error ACS-1002 cleared", "Error ACS-1002 set"});
    CHECK(HasText(
        user.Post("/v1/alarms/clear", R"({"robotId":"LR01","errorCode":"ACS-1004"})"),
        "404 {\"error\":\"\\\"LR01\\\" has no alarm \\\"ACS-1004\\\""));
    CHECK(HasText(
        user.Post("/v1/alarms/clear", R"({"robotId":"LR01","errorCode":"ACS-1002","planId":"P9"})"),
        "404 {\"error\":\"\\\"LR01\\\" has no alarm \\\"ACS-1002\\\" of plan \\\"P9\\\";"));
    CHECK(HasText(user.Post("/v1/alarms/clear", R"({"robotId":"LR01"})"), "400 {\"error\":\"Invalid body: "));
    CHECK(HasText(user.Post("/v1/alarms/clear", R"({"robotId":"LR01","errorCode":"ACS-1002","stepNo":1})"), "400 "));
}
