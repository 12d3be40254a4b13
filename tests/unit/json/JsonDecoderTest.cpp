#include "Catch.hpp"
#include "JsonLayerSample.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ACS::Json::Test
{

namespace
{

constexpr std::string_view FULL =
    R"({"headerId":7,"version":"2.0.0","planId":"P","priority":-3,"jobs":[{"jobId":"a"},{"jobId":"b","from":"A01"}],)"
    R"("tags":["t"],"x":1.5,"colour":"Green","carriers":[null,"C"],"stepId":null,"value":{"deep":[1,2.5]},"on":true})";

struct Outcome
{
    bool bGood = false;
    SampleMessage message;
    DecodeNotes notes;
    Core::Error error;
};

Outcome Decode(std::string_view text, const DecodeOptions& options = {}, const ParseLimits& limits = {})
{
    Outcome outcome;
    JsonDocument document;
    const auto root = document.Parse(text, limits);
    if (!root)
    {
        outcome.error = root.error();
        return outcome;
    }
    DecodeContext context(options);
    outcome.bGood = TryDecode(**root, outcome.message, FieldBounds{}, context);
    outcome.notes = context.GetNotes();
    outcome.error = context.TakeError();
    return outcome;
}

/// The smallest valid message, with one member replaced or added.
std::string MakeMinimal(std::string_view member)
{
    return fmt::format(R"({{"headerId":1,"version":"v","planId":"P","colour":"Red","on":false,{}}})", member);
}

std::string Encode(const SampleMessage& message)
{
    std::string text;
    JsonWriter writer(text);
    Json::Encode(message, writer);
    return text;
}

} // namespace

TEST_CASE("A described message is decoded, and encoded to the same bytes")
{
    const Outcome outcome = Decode(FULL);
    REQUIRE(outcome.bGood);
    CHECK(outcome.message.header.headerID == 7);
    CHECK(outcome.message.priority == -3);
    CHECK(outcome.message.jobs.at(1).from == "A01");
    CHECK(outcome.message.carriers == std::vector<std::optional<std::string>>{std::nullopt, "C"});
    CHECK(outcome.message.value.GetText() == R"({"deep":[1,2.5]})");
    CHECK(Encode(outcome.message) == FULL);
}

TEST_CASE("Members are accepted in any order")
{
    const Outcome outcome = Decode(R"({"on":true,"x":2,"colour":"Red","planId":"P","version":"v","headerId":1})");
    REQUIRE(outcome.bGood);
    CHECK(outcome.message.x == 2.0);
}

TEST_CASE("An optional member is left out when it has no value, a nullable one is written as null")
{
    const Outcome outcome = Decode(MakeMinimal(R"("x":1)"));
    REQUIRE(outcome.bGood);
    CHECK(
        Encode(outcome.message)
        == R"({"headerId":1,"version":"v","planId":"P","jobs":[],"x":1,"colour":"Red","carriers":[],"stepId":null,)"
           R"("value":null,"on":false})");
}

TEST_CASE("Tolerated deviations are counted")
{
    DecodeOptions options;
    options.bNumericStringsAccepted = true;
    const Outcome outcome = Decode(
        R"({"headerId":"1","version":"v","planId":"P","priority":null,"x":"2.5","colour":"green","on":true,"more":{"a":1}})",
        options);
    REQUIRE(outcome.bGood);
    CHECK(outcome.message.x == 2.5);
    CHECK(outcome.message.colour == EColour::Green);
    CHECK(outcome.notes == DecodeNotes{1, 1, 1, 2});
}

TEST_CASE("An error has the path, what was expected and what was found")
{
    struct Row
    {
        std::string text;
        std::string sentence;
    };
    const std::string longText(41, 'z');
    const std::vector<Row> rows{
        {MakeMinimal(R"("x":11)"), "x: expected a number from -10 to 10, found 11"},
        {MakeMinimal(R"("x":"2")"), "x: expected a number, found \"2\""},
        {MakeMinimal(R"("x":1,"jobs":[{"jobId":"a"},{"jobId":""}])"),
         "jobs[1].jobId: expected a string of 1 to 8 bytes, found 0 bytes"},
        {MakeMinimal(R"("x":1,"jobs":[3])"), "jobs[0]: expected an object, found 3"},
        {MakeMinimal(R"("x":1,"jobs":{})"), "jobs: expected an array, found an object"},
        {MakeMinimal(R"("x":1,"carriers":[null,4])"), "carriers[1]: expected a string, found 4"},
        {MakeMinimal(R"("x":1,"priority":1.5)"),
         "priority: expected an integer from -9223372036854775808 to 9223372036854775807, found 1.5"},
        {R"({"headerId":4294967296})", "headerId: expected an integer from 0 to 4294967295, found 4294967296"},
        {R"({"headerId":-1})", "headerId: expected an integer from 0 to 4294967295, found -1"},
        {R"({"headerId":null})", "headerId: expected an integer from 0 to 4294967295, found null"},
        {R"({"version":"v","planId":"P","x":1,"colour":"Red","on":true})",
         "headerId: expected a value, found nothing (the member is missing)"},
        {R"({"headerId":1,"version":"v","colour":"Blue"})", "colour: expected one of Red, Green, found \"Blue\""},
        {R"({"on":1})", "on: expected true or false, found 1"},
        {R"([])", "expected an object, found an array"},
        {fmt::format(R"({{"on":"{}"}})", longText),
         fmt::format("on: expected true or false, found \"{}...", longText.substr(0, 39))},
    };
    for (const Row& row : rows)
    {
        const Outcome outcome = Decode(row.text);
        CHECK_FALSE(outcome.bGood);
        CHECK(Core::Describe(outcome.error) == row.sentence);
    }
}

TEST_CASE("A repeated member is refused, known or not, at any depth")
{
    for (const std::string& text :
         {std::string(R"({"headerId":1,"headerId":1})"),
          std::string(R"({"a":1,"a":2})"),
          std::string(R"({"more":{"deep":[{"a":1,"a":2}]}})"),
          MakeMinimal(R"("x":1,"value":{"a":1,"b":{"c":1,"c":2}})")})
    {
        const Outcome outcome = Decode(text);
        CHECK_FALSE(outcome.bGood);
        CHECK(outcome.error.code == Core::ECoreError::InvalidJSON);
    }
}

TEST_CASE("Repeated members are found among many unknown ones")
{
    std::string members = R"("x":1)";
    for (int i = 0; i < 100; ++i)
    {
        members += fmt::format(R"(,"m{}":0)", i);
    }
    const Outcome good = Decode(MakeMinimal(members));
    CHECK(good.bGood);
    CHECK(good.notes.unknownMembers == 100);
    CHECK_FALSE(Decode(MakeMinimal(members + R"(,"m42":1)")).bGood);
}

TEST_CASE("Unknown members can be refused")
{
    DecodeOptions options;
    options.bUnknownMembersRefused = true;
    const Outcome outcome = Decode(MakeMinimal(R"("x":1,"more":1)"), options);
    CHECK_FALSE(outcome.bGood);
    CHECK(outcome.error.path == "more");
}

TEST_CASE("Enum texts are matched exactly if the options require it")
{
    DecodeOptions options;
    options.bWordsInAnyCase = false;
    CHECK_FALSE(Decode(R"({"colour":"red"})", options).bGood);
}

TEST_CASE("Strings and arrays without a limit of their field have the limit of the options")
{
    DecodeOptions options;
    options.maximumString = 4;
    options.maximumArray = 2;
    CHECK(Decode(R"({"planId":"abcde"})", options).error.path == "planId");
    CHECK(Decode(R"({"tags":["a","b","c"]})", options).error.path == "tags");
}

} // namespace ACS::Json::Test
