#include "common/log/LogText.hpp"

#include "Catch.hpp"
#include "common/log/SpdlogSink.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

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

TEST_CASE("Characters that control a terminal or turn the text are escaped in a log line")
{
    for (const auto& [character, escaped] :
         {std::pair("\xC2\x80", R"(\xc2\x80)"),
          std::pair("\xC2\x9B", R"(\xc2\x9b)"),
          std::pair("\xC2\x9F", R"(\xc2\x9f)"),
          std::pair("\xD8\x9C", R"(\xd8\x9c)"),
          std::pair("\xE2\x80\x8F", R"(\xe2\x80\x8f)"),
          std::pair("\xE2\x80\xA8", R"(\xe2\x80\xa8)"),
          // NOLINTNEXTLINE(misc-misleading-bidirectional): what is tested
          std::pair("\xE2\x80\xAE", R"(\xe2\x80\xae)"),
          // NOLINTNEXTLINE(misc-misleading-bidirectional): what is tested
          std::pair("\xE2\x81\xA6", R"(\xe2\x81\xa6)"),
          std::pair("\x7F", R"(\x7f)")})
    {
        CAPTURE(escaped);
        const std::string text = std::string("a") + character + "b";
        CHECK(Apps::MakeLogText("x", text, {{"id", text}}) == fmt::format(R"(x: a{}b id="a{}b")", escaped, escaped));
        CHECK(Apps::MakePrintable(text) == fmt::format("a{}b", escaped));
    }
    // Their neighbours are text.
    for (const char* character :
         {"\xC2\xA0", "\xD8\x9B", "\xE2\x80\x90", "\xE2\x80\xAF", "\xE2\x81\xA5", "\xEA\xB0\x80", "\xF0\x9F\xA6\x84"})
    {
        CAPTURE(character);
        CHECK(Apps::MakePrintable(character) == character);
    }
    CHECK(Apps::MakePrintable("\x1b[31m\n\"\\\xEA\xB0\xFF") == R"(\x1b[31m\x0a"\\xea\xb0\xff)");
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
