#include "plans/PlanFile.hpp"

#include "Catch.hpp"

#include <string>

using ACS::Core::Describe;
using ACS::Core::Result;
using ACS::McsSim::ParsePlanFile;
using ACS::McsSim::PlannedPlan;

namespace
{

const char* const PAYLOAD =
    R"({"planId":"P1","lotId":"L1","priority":3,"steps":[{"stepNo":1,"action":"CassetteLoad","position":"A01.CP01",)"
    R"("carrierIds":["C1"],"jobs":[{"jobId":"J1","from":"A01.CP01","to":"AMR.CP01"}]}]})";

std::string MakeMessage(const std::string& command, const std::string& payload)
{
    return R"({"command":")" + command
        + R"(","transactionId":"T1","timestamp":"2025-07-02T21:00:00.123+09:00","payload":)" + payload + "}";
}

std::string GetPlanError(const std::string& text)
{
    const Result<PlannedPlan> planned = ParsePlanFile(text);
    return planned.has_value() ? "none" : Describe(planned.error());
}

} // namespace

TEST_CASE("A plan file with a payload gives the plan, and no transactionId")
{
    const Result<PlannedPlan> planned = ParsePlanFile(PAYLOAD);
    REQUIRE(planned.has_value());
    CHECK(planned->plan.planID == "P1");
    REQUIRE(planned->plan.steps.size() == 1);
    CHECK(planned->plan.steps[0].jobs[0].to == "AMR.CP01");
    CHECK(planned->transactionID.empty());
}

TEST_CASE("A plan file with a whole message gives the plan and its transactionId")
{
    const Result<PlannedPlan> planned = ParsePlanFile(MakeMessage("ExecutionPlan", PAYLOAD));
    REQUIRE(planned.has_value());
    CHECK(planned->plan.planID == "P1");
    CHECK(planned->transactionID == "T1");
}

TEST_CASE("A plan file may begin with a byte order mark")
{
    CHECK(ParsePlanFile("\xEF\xBB\xBF" + std::string(PAYLOAD)).has_value());
}

TEST_CASE("An invalid plan file is refused with the position of the error")
{
    CHECK(GetPlanError("{\"planId\":").find("JSON") != std::string::npos);
    CHECK(GetPlanError("").find("JSON") != std::string::npos);
    CHECK(GetPlanError("[]") != "none");
    CHECK(GetPlanError(R"({"planId":"P1"})").find("payload.steps") != std::string::npos);
    CHECK(GetPlanError(MakeMessage("ExecutionPlan", R"({"planId":"P1"})")).find("steps") != std::string::npos);
    // A payload cannot break out of the message that it is put into.
    CHECK(GetPlanError(std::string(PAYLOAD) + R"(,"command":"AbortPlan")") != "none");
}

TEST_CASE("A plan file with another command or an Ack is refused")
{
    CHECK(GetPlanError(MakeMessage("AbortPlan", R"({"planId":"P1"})")).find("ExecutionPlan") != std::string::npos);
    CHECK(GetPlanError(MakeMessage("ExecutionPlanAck", R"({"planId":"P1"})")) != "none");
    CHECK(GetPlanError(MakeMessage("Frobnicate", "{}")) != "none");
}

TEST_CASE("A plan file that is not there is named")
{
    const auto planned = ACS::McsSim::ReadPlanFile("/nowhere/plan.json");
    REQUIRE_FALSE(planned.has_value());
    CHECK(planned.error() == "the plan file /nowhere/plan.json cannot be read: No such file or directory");
}
