#include "common/log/LogText.hpp"

#include "Catch.hpp"
#include "common/log/SpdlogSink.hpp"

namespace Apps = ACS::Apps;
namespace Core = ACS::Core;

TEST_CASE("A log line has component, message and fields")
{
    REQUIRE(
        Apps::MakeLogText("mcs", "Plan accepted", {{"planId", "PLAN-1"}, {"steps", "3"}})
        == "mcs: Plan accepted planId=PLAN-1 steps=3");
}

TEST_CASE("An ambiguous value is quoted")
{
    REQUIRE(
        Apps::MakeLogText("x", "m", {{"a", ""}, {"b", "two words"}, {"c", R"(the "hi" \)"}, {"d", "k=v"}})
        == R"(x: m a="" b="two words" c="the \"hi\" \\" d="k=v")");
}

TEST_CASE("Text of a peer cannot start a new log line")
{
    REQUIRE(
        Apps::MakeLogText("x", "bad\nline", {{"text", "a\r\nb\x1b[0m"}}) == R"(x: bad\nline text="a\x0d\nb\x1b[0m")");
}

TEST_CASE("A log line is UTF-8, whatever the text of a peer is")
{
    REQUIRE(Apps::MakeLogText("x", "m", {{"text", "\xEA\xB0\x80"}}) == "x: m text=\xEA\xB0\x80");
    REQUIRE(Apps::MakeLogText("x", "m", {{"text", "a\xFFz\xB0"}}) == R"(x: m text=a\xffz\xb0)");
}

TEST_CASE("A log level is one of four names")
{
    REQUIRE(Apps::ParseLogLevel("debug") == Core::ELogLevel::Debug);
    REQUIRE(Apps::ParseLogLevel("info") == Core::ELogLevel::Info);
    REQUIRE(Apps::ParseLogLevel("warning") == Core::ELogLevel::Warning);
    REQUIRE(Apps::ParseLogLevel("error") == Core::ELogLevel::Error);
    REQUIRE_FALSE(Apps::ParseLogLevel("INFO").has_value());
}

TEST_CASE("A sink writes lines of its level and of higher ones")
{
    const Apps::SpdlogSink sink(
        Core::ELogLevel::Warning,
        GENERATE(Apps::ELogWriting::Direct, Apps::ELogWriting::Queued));
    REQUIRE_FALSE(sink.ShouldWrite(Core::ELogLevel::Debug));
    REQUIRE_FALSE(sink.ShouldWrite(Core::ELogLevel::Info));
    REQUIRE(sink.ShouldWrite(Core::ELogLevel::Warning));
    REQUIRE(sink.ShouldWrite(Core::ELogLevel::Error));
}
