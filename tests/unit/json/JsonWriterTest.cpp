#include "Catch.hpp"
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace ACS::Json::Test
{

namespace
{

std::string WriteOne(std::string_view value)
{
    std::string text;
    JsonWriter(text).WriteString(value);
    return text;
}

} // namespace

TEST_CASE("A string of any length and content is escaped in the same way")
{
    // Each position in and around a block of eight, so that all branches of the scan are tested.
    for (std::size_t length = 0; length < 20; ++length)
    {
        const std::string plain(length, 'x');
        CHECK(WriteOne(plain) == '"' + plain + '"');
        for (std::size_t i = 0; i < length; ++i)
        {
            const std::string front = plain.substr(0, i);
            const std::string back = plain.substr(i + 1);
            const auto writes = [&front, &back](std::string_view raw, std::string_view written) {
                return WriteOne(fmt::format("{}{}{}", front, raw, back))
                    == fmt::format("\"{}{}{}\"", front, written, back);
            };
            CHECK(writes("\"", R"(\")"));
            CHECK(writes("\\", R"(\\)"));
            CHECK(writes("\x1F", R"(\u001f)"));
            CHECK(writes(std::string_view("\0", 1), R"(\u0000)"));
            CHECK(writes("\x7F\x20!#[]", "\x7F\x20!#[]"));
            CHECK(writes("\xED\x95\x9C", "\xED\x95\x9C"));
            CHECK(writes("\xFF", "\xEF\xBF\xBD"));
        }
    }
}

TEST_CASE("A number that is not finite is written as null")
{
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(),
          std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()})
    {
        std::string text;
        JsonWriter writer(text);
        writer.BeginArray();
        writer.WriteNumber(1);
        writer.WriteNumber(value);
        writer.EndArray();
        CHECK(text == "[1,null]");
    }
}

TEST_CASE("A number is written as the shortest text that reads as the same number")
{
    const auto write = [](double value) {
        std::string text;
        JsonWriter(text).WriteNumber(value);
        return text;
    };
    CHECK(write(0) == "0");
    CHECK(write(-0.001) == "-0.001");
    CHECK(write(0.1) == "0.1");
    CHECK(write(10.24) == "10.24");
    CHECK(write(-12.305) == "-12.305");
    CHECK(write(1e11) == "100000000000");
    CHECK(write(1e300) == "1e+300");
    CHECK(write(0.0005) == "0.0005");
    CHECK(write(1.0 / 3.0) == "0.3333333333333333");
    // The neighbours of thousandths are other numbers and must stay distinct.
    for (int step = -20'000; step <= 20'000; step += 7)
    {
        const double value = step / 1000.0;
        for (const double near : {value, std::nextafter(value, 1e9), std::nextafter(value, -1e9), value * 1e9})
        {
            REQUIRE(std::stod(write(near)) == near);
        }
        REQUIRE(write(value).size() <= 7);
    }
}

TEST_CASE("A string in two pieces is one string, and a plain string is written as an escaped one would be")
{
    std::string text;
    JsonWriter writer(text);
    writer.BeginArray();
    writer.WriteString("Plan\"", "Ack\n");
    writer.WriteString("", "");
    writer.WriteString("", "b");
    writer.WritePlainString("Auto");
    writer.EndArray();
    CHECK(text == R"(["Plan\"Ack\n","","b","Auto"])");
}

TEST_CASE("Objects and arrays have commas between their elements")
{
    std::string text;
    JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("empty");
    writer.BeginObject();
    writer.EndObject();
    writer.Key("list");
    writer.BeginArray();
    writer.WriteInteger(-1);
    writer.WriteUnsigned(std::numeric_limits<std::uint64_t>::max());
    writer.WriteNumber(0.1);
    writer.WriteBoolean(true);
    writer.WriteNull();
    writer.WriteString("a:[");
    writer.WriteRaw(Core::JsonText::FromTrusted("{}"));
    writer.BeginArray();
    writer.EndArray();
    writer.EndArray();
    writer.EndObject();
    CHECK(text == R"({"empty":{},"list":[-1,18446744073709551615,0.1,true,null,"a:[",{},[]]})");
}

TEST_CASE("Control characters, quotes and backslashes are escaped, UTF-8 is kept")
{
    CHECK(WriteOne("a\"b\\c\n\x01") == R"("a\"b\\c\n\u0001")");
    CHECK(WriteOne("\xED\x8F\xAC \xF0\x9F\xA4\x96") == "\"\xED\x8F\xAC \xF0\x9F\xA4\x96\"");
}

TEST_CASE("Bytes that are not valid UTF-8 are written as the replacement character")
{
    CHECK(WriteOne("a\xFFz") == "\"a\xEF\xBF\xBDz\"");
    CHECK(WriteOne("\xC3") == "\"\xEF\xBF\xBD\"");
    CHECK(WriteOne("\xED\xA0\x80") == "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

TEST_CASE("A number is written so that reading it gives the same number")
{
    for (const double value : {0.1, 1e-300, 12345678.9, -0.0, 1.0 / 3.0})
    {
        std::string text;
        JsonWriter(text).WriteNumber(value);
        CHECK(std::stod(text) == value);
    }
}

} // namespace ACS::Json::Test
