#include "api/ApiCodec.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace Acsctl = ACS::Acsctl;

namespace
{

constexpr std::string_view PLANS =
    R"({"plans":[{"planId":"P1","lotId":"","priority":5,"status":"Pending","robotId":null,
"stepNo":1,"waits":{"message":"No.","since":null,"queuePosition":1,"robots":[{"robotId":"LR01","reason":"busy"}]},
"steps":[{"stepNo":1,"action":"LOAD","carrierIds":["C",null],"jobs":[{"jobId":"J","from":null,"to":"A"}]}],"later":{"a":[1]}}]})";

} // namespace

TEST_CASE("An answer is decoded, and members that this version does not know are ignored")
{
    const auto answer = Acsctl::DecodeAnswer<Acsctl::PlansAnswer>(PLANS);
    REQUIRE(answer.has_value());
    const Acsctl::PlanInfo& plan = answer->plans.at(0);
    CHECK(plan.planID == "P1");
    CHECK(plan.waits->robots.at(0).reason == "busy");
    CHECK(plan.steps.at(0).carrierIDs.size() == 2);
    CHECK(plan.steps.at(0).jobs.at(0).to == "A");
    CHECK_FALSE(plan.robotID.has_value());
}

TEST_CASE("Any text gives a value or an error with its path")
{
    for (std::size_t size = 0; size < PLANS.size(); ++size)
    {
        CHECK_FALSE(Acsctl::DecodeAnswer<Acsctl::PlansAnswer>(PLANS.substr(0, size)).has_value());
    }
    for (std::size_t at = 0; at < PLANS.size(); ++at)
    {
        for (const char letter : {'"', '{', ']', '0', '\0', '\xff'})
        {
            std::string text(PLANS);
            text[at] = letter;
            static_cast<void>(Acsctl::DecodeAnswer<Acsctl::PlansAnswer>(text));
            static_cast<void>(Acsctl::MakeOneLine(text));
        }
    }
    const auto wrong = Acsctl::DecodeAnswer<Acsctl::PlansAnswer>(R"({"plans":[{"planId":7,"status":"x"}]})");
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().path == "plans[0].planId");
    CHECK_FALSE(Acsctl::DecodeAnswer<Acsctl::PlansAnswer>(std::string(1'000'000, '[')).has_value());
    CHECK_FALSE(Acsctl::DecodeAnswer<Acsctl::StatusInfo>(R"({"robots":{"byStatus":{"Idle":-1}}})").has_value());
}

TEST_CASE("Counts keep the order of the answer")
{
    const auto status = Acsctl::DecodeAnswer<Acsctl::StatusInfo>(
        R"({"version":"1","ready":true,"links":[],"tsc":"Auto","robots":{"total":3,"byStatus":{"Moving":2,"Idle":1}}})");
    REQUIRE(status.has_value());
    CHECK(status->robots.byStatus.counts.at(0).first == "Moving");
    CHECK(status->robots.byStatus.counts.at(1).second == 1);
}
