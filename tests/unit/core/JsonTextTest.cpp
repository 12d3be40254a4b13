#include "Catch.hpp"
#include <acs/core/JsonText.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

using ACS::Core::JsonText;

namespace
{

std::optional<std::string> ReadStringOrNull(std::string_view text)
{
    return JsonText::FromTrusted(std::string(text)).GetStringOrNull();
}

} // namespace

TEST_CASE("A JSON text is null until it is given a value")
{
    const JsonText json;
    CHECK(json.GetText() == "null");
    CHECK_FALSE(json.GetStringOrNull().has_value());
    CHECK_FALSE(json.GetNumberOrNull().has_value());
    CHECK_FALSE(json.GetBooleanOrNull().has_value());
}

TEST_CASE("A JSON string is escaped and can be read again")
{
    using namespace std::string_literals;
    const std::string text = "quote \" backslash \\ line\n tab\t nul\0 \xED\x95\x9C \xF0\x9F\xA4\x96"s;
    const JsonText json = JsonText::FromString(text);
    CHECK(json.GetText().find('\n') == std::string::npos);
    CHECK(json.GetText().find("\\u0000") != std::string::npos);
    CHECK(json.GetStringOrNull() == text);
    CHECK(JsonText::FromString("").GetText() == "\"\"");
    CHECK(JsonText::FromString("").GetStringOrNull() == "");
}

TEST_CASE("Bytes that are not valid UTF-8 become the replacement character in a JSON string")
{
    CHECK(JsonText::FromString("a\xFFz").GetText() == "\"a\xEF\xBF\xBDz\"");
    CHECK(JsonText::FromString("\xED\x95").GetText() == "\"\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

TEST_CASE("Every escape of a JSON string is read")
{
    CHECK(ReadStringOrNull(R"("\"\\\/\b\f\n\r\t")") == "\"\\/\b\f\n\r\t");
    CHECK(ReadStringOrNull(R"("\u002B\u00e4\uD55C")") == "+\xC3\xA4\xED\x95\x9C");
    CHECK(ReadStringOrNull(R"("\uD83E\uDD16")") == "\xF0\x9F\xA4\x96");
    CHECK(ReadStringOrNull(R"("\u0000")") == std::string(1, '\0'));
}

TEST_CASE("Half a surrogate pair becomes the replacement character and does not swallow the text after it")
{
    CHECK(ReadStringOrNull(R"("\uD83E")") == "\xEF\xBF\xBD");
    CHECK(ReadStringOrNull(R"("\uDD16x")") == "\xEF\xBF\xBDx");
    CHECK(
        ReadStringOrNull(R"("\uD83Eabcdef")")
        == "\xEF\xBF\xBD"
           "abcdef");
    CHECK(
        ReadStringOrNull(R"("\uD83E\u0041")")
        == "\xEF\xBF\xBD"
           "A");
}

TEST_CASE("Invalid text that was passed as trusted is not a string, and is not read beyond its end")
{
    for (const std::string_view text :
         {R"(")", R"("abc)", R"(abc")", R"("\")", R"("a"b")", R"("\u12")", R"("\u12x4")", R"("\x")", ""})
    {
        INFO(text);
        CHECK_FALSE(ReadStringOrNull(text).has_value());
    }
}

TEST_CASE("A JSON number keeps its value exactly")
{
    for (const double value : {0.0, -1.5, 0.1, 1e300, 123456789.125, std::numeric_limits<double>::denorm_min()})
    {
        CHECK(JsonText::FromNumber(value).GetNumberOrNull() == value);
    }
    CHECK(JsonText::FromInteger(std::numeric_limits<std::int64_t>::min()).GetText() == "-9223372036854775808");
    CHECK(JsonText::FromNumber(std::numeric_limits<double>::infinity()).GetText() == "null");
    CHECK(JsonText::FromNumber(std::nan("")).GetText() == "null");
    CHECK_FALSE(JsonText::FromTrusted("1e999").GetNumberOrNull().has_value());
    CHECK_FALSE(JsonText::FromTrusted("inf").GetNumberOrNull().has_value());
    CHECK_FALSE(JsonText::FromTrusted("\"1\"").GetNumberOrNull().has_value());
}

TEST_CASE("Only true and false are JSON booleans")
{
    CHECK(JsonText::FromBoolean(true).GetBooleanOrNull() == true);
    CHECK(JsonText::FromBoolean(false).GetBooleanOrNull() == false);
    CHECK_FALSE(JsonText::FromInteger(1).GetBooleanOrNull().has_value());
}

TEST_CASE("A JSON text is null after its text was moved out")
{
    JsonText text = JsonText::FromTrusted(R"({"a":1})");
    CHECK(text.TakeText() == R"({"a":1})");
    CHECK(text == JsonText());
}
