#include "scenario/PatternMatch.hpp"

#include "Catch.hpp"

#include <optional>
#include <string>
#include <string_view>

using ACS::Core::JsonText;
using ACS::McsSim::FillPlaceholders;
using ACS::McsSim::FindMismatchOrNull;
using ACS::McsSim::MatchesGlob;

namespace
{

std::optional<std::string> ReadAOrNull(std::string_view name)
{
    return name == "A" ? std::optional<std::string>("PLAN-7") : std::nullopt;
}

std::string Find(const std::string& message, const std::string& members)
{
    return FindMismatchOrNull(message, {"PlanReport", JsonText::FromTrusted(members)}, ReadAOrNull).value_or("");
}

} // namespace

TEST_CASE("A star stands for any characters, and nothing else does")
{
    CHECK(MatchesGlob("PlanReport", "PlanReport"));
    CHECK(MatchesGlob("PlanReport", "*"));
    CHECK(MatchesGlob("", "*"));
    CHECK(MatchesGlob("Queue Full or Duplicated Plan", "*Duplicat*Plan*"));
    CHECK(MatchesGlob("aab", "*ab"));
    CHECK_FALSE(MatchesGlob("PlanReport", "planReport"));
    CHECK_FALSE(MatchesGlob("PlanReport", "Plan"));
    CHECK_FALSE(MatchesGlob("Plan", "Plan?"));
    CHECK_FALSE(MatchesGlob("", "a*"));
}

TEST_CASE("Placeholders are filled in, other braces stay")
{
    CHECK(FillPlaceholders("{A} and {B}, {{A}} {", ReadAOrNull) == "PLAN-7 and {B}, {PLAN-7} {");
    CHECK(FillPlaceholders("", ReadAOrNull).empty());
    const JsonText json = JsonText::FromTrusted(R"({"{A}":["{A}",1.5,null,true,{"x":"\"{A}"}]})");
    CHECK(FillPlaceholders(json, ReadAOrNull).GetText() == R"({"{A}":["PLAN-7",1.5,null,true,{"x":"\"PLAN-7"}]})");
}

TEST_CASE("A message matches where it has every member of the pattern, whatever else it has")
{
    const std::string message =
        R"({"command":"PlanReport","payload":{"planId":"PLAN-7","stepNo":2,"jobId":null,"list":[1,{"a":2,"b":3}]}})";
    CHECK(Find(message, "{}").empty());
    CHECK(Find(message, R"({"payload":{"planId":"{A}","stepNo":2}})").empty());
    CHECK(Find(message, R"({"payload":{"list":[1,{"b":3}]}})").empty());
    CHECK(Find(message, R"({"payload":{"stepNo":"*","list":"*"}})").empty());
    SECTION("null also stands for what is absent")
    {
        CHECK(Find(message, R"({"payload":{"jobId":null,"robotId":null}})").empty());
        CHECK(Find(message, R"({"payload":{"jobId":"*"}})") == R"(payload.jobId: expected "*", found null)");
    }
    SECTION("what does not match is named")
    {
        CHECK(
            Find(message, R"({"payload":{"planId":"{A}X"}})")
            == R"(payload.planId: expected "PLAN-7X", found "PLAN-7")");
        CHECK(Find(message, R"({"payload":{"stepNo":3}})") == "payload.stepNo: expected 3, found 2");
        CHECK(Find(message, R"({"payload":{"stepNo":"2"}})") == R"(payload.stepNo: expected "2", found 2)");
        CHECK(Find(message, R"({"result":"Fail"})") == R"(result: expected "Fail", found nothing)");
        CHECK(Find(message, R"({"payload":{"list":[1]}})") == "payload.list: expected an array, found an array");
        CHECK(Find(message, R"({"payload":{"list":[1,{"b":4}]}})") == "payload.list[1].b: expected 4, found 3");
        CHECK(Find(message, R"({"payload":3})") == "payload: expected 3, found an object");
    }
    SECTION("a text that is no JSON matches nothing")
    {
        CHECK(Find("{", "{}") == "no JSON");
    }
}
