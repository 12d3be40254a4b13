#include "Catch.hpp"
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Json::Test
{

namespace
{

std::error_code GetParseError(std::string_view text, const ParseLimits& limits = {})
{
    JsonDocument document;
    const auto root = document.Parse(text, limits);
    return root ? std::error_code() : root.error().code;
}

void CheckFailsAt(std::size_t byte, std::string_view text)
{
    JsonDocument document;
    const auto root = document.Parse(text, {});
    REQUIRE_FALSE(root.has_value());
    CHECK(root.error().found.starts_with(fmt::format("byte {}:", byte)));
}

} // namespace

TEST_CASE("An error in a text of several lines has line and column")
{
    JsonDocument document;
    const auto missing = document.Parse("\xEF\xBB\xBF{\n  \"a\": 1\n  \"b\": 2\n}", {});
    REQUIRE_FALSE(missing.has_value());
    CHECK(missing.error().found.starts_with("line 3, column 3: "));
    const auto cut = document.Parse("[1,\n", {});
    REQUIRE_FALSE(cut.has_value());
    CHECK(cut.error().found.starts_with("line 2, column 1: "));
    const auto early = document.Parse("x\n", {});
    REQUIRE_FALSE(early.has_value());
    CHECK(early.error().found.starts_with("line 1, column 1: "));
    const auto nul = document.Parse(std::string_view("[1]\n\0", 5), {});
    REQUIRE_FALSE(nul.has_value());
    CHECK(nul.error().found == "a NUL at line 2, column 1");
}

TEST_CASE("Five megabytes of opening brackets are refused without a crash")
{
    ParseLimits limits;
    limits.bytes = 8U * 1024U * 1024U;
    CHECK(GetParseError(std::string(5U * 1024U * 1024U, '['), limits) == Core::ECoreError::TooLarge);
    limits.depth = limits.bytes;
    limits.values = limits.bytes;
    CHECK(GetParseError(std::string(5U * 1024U * 1024U, '['), limits) == Core::ECoreError::InvalidJSON);
}

TEST_CASE("Nesting is accepted up to the limit")
{
    const ParseLimits limits{1024, 3};
    CHECK_FALSE(GetParseError("[[[1]]]", limits));
    CHECK(GetParseError("[[[[1]]]]", limits) == Core::ECoreError::TooLarge);
}

TEST_CASE("The parse ends at the first value beyond the limit, whatever its kind and depth")
{
    ParseLimits limits;
    limits.values = 4;
    for (const std::string_view text :
         {"[1,2,3]", R"({"a":1,"b":{"c":[]}})", R"(["a",null,true])", "[[],{},-1]", "[18446744073709551615,1e3,0]"})
    {
        INFO(text);
        CHECK_FALSE(GetParseError(text, limits));
        const std::string more = fmt::format("[{},", text); // not JSON, but the limit comes first
        CHECK(GetParseError(more, limits) == Core::ECoreError::TooLarge);
    }
    JsonDocument document;
    const auto root = document.Parse("[1,2,3,4]", limits);
    REQUIRE_FALSE(root.has_value());
    CHECK(root.error().expected == "at most 4 values");
}

TEST_CASE("Four megabytes of numbers are refused after 250,000 of them")
{
    std::string text = "[0";
    while (text.size() < 4U * 1024U * 1024U - 8)
    {
        text += ",0";
    }
    CHECK(GetParseError(text + "]") == Core::ECoreError::TooLarge);
    CHECK(GetParseError(text.substr(0, 2 * 249'999) + "]") == std::error_code());
}

TEST_CASE("Commas inside a string are no values")
{
    ParseLimits limits;
    limits.values = 2;
    CHECK_FALSE(GetParseError(R"([",,,,,,\",,,,,,"])", limits));
    CHECK(GetParseError(R"(["","",""])", limits) == Core::ECoreError::TooLarge);
    CHECK(GetParseError(R"(["\\",0,0,0,0,0])", limits) == Core::ECoreError::TooLarge);
}

TEST_CASE("A text longer than the limit is refused before it is parsed")
{
    CHECK(GetParseError("[1,2,3]", {6, 3}) == Core::ECoreError::TooLarge);
    CHECK_FALSE(GetParseError("[1,2,3]", {7, 3}));
}

TEST_CASE("A number of any length and exponent is read exactly, as zero, or refused")
{
    struct Number
    {
        std::string text;
        double value;
    };
    const std::string zeros(200, '0');
    const std::vector<Number> numbers{
        {"-22222222222222222.000123423577" + zeros + "20496382104121721e-373", 0.0},
        {"-2.5e-320", -2.5e-320},
        {"1e-400", 0.0},
        {"0." + zeros + zeros + "1", 0.0},
        {"0." + zeros + zeros + "1e5", 0.0},
        {"1e-99999999999999999999", 0.0},
        {"0.1", 0.1},
        {"9007199254740993", 9007199254740992.0},
        {"18446744073709551615", 18446744073709551615.0},
        {"18446744073709551616", 18446744073709551616.0},
        {"-9223372036854775809", -9223372036854775809.0},
        {"-0", 0.0},
        {"1.7976931348623157e308", 1.7976931348623157e308},
    };
    for (const Number& number : numbers)
    {
        INFO(number.text);
        JsonDocument document;
        const auto root = document.Parse(number.text, {});
        REQUIRE(root.has_value());
        CHECK((*root)->GetDouble() == number.value);
    }
    const std::string longInteger = '1' + std::string(2 * zeros.size(), '0');
    for (const std::string& text :
         {std::string("1e309"), std::string("1.8e308"), longInteger, std::string("01"), std::string("1.")})
    {
        INFO(text);
        CHECK(GetParseError(text) == Core::ECoreError::InvalidJSON);
    }
}

TEST_CASE("Half a surrogate pair is refused, in a value and in a name, and a complete pair is read")
{
    for (const std::string_view text :
         {R"("\ud83d")", R"("\uddDD")", R"("\ude00\ud83d")", R"("x\uDFFFy")", R"({"\udc00":1})", R"(["\ud83d\u0041"])"})
    {
        INFO(text);
        CHECK(GetParseError(text) == Core::ECoreError::InvalidJSON);
    }
    for (const std::string_view text :
         {R"("\ud83d\ude00")", R"("\ud7ff")", R"("\ue000")", "\"\xED\x95\x9C\\n\"", "\"\xED\x9F\xBF\\t\xEE\x80\x80\""})
    {
        INFO(text);
        CHECK_FALSE(GetParseError(text));
    }
}

TEST_CASE("Text that is not JSON is refused")
{
    using namespace std::string_view_literals;
    const std::string large = "[1" + std::string(400, '0') + "e-5]";
    for (const std::string_view text :
         {""sv,
          " "sv,
          "{"sv,
          R"({"a":})"sv,
          "[1,]"sv,
          "{} {}"sv,
          "NaN"sv,
          "Infinity"sv,
          "[1e999]"sv,
          "[1e+99999999999999999999]"sv,
          std::string_view(large),
          "\"\xC3\x28\""sv,
          "\"\xED\xA0\x80\""sv,
          "{\"a\":1}\0{\"b\":2}"sv,
          "// c\n1"sv,
          "'a'"sv,
          "01"sv})
    {
        CAPTURE(text);
        CHECK(GetParseError(text) == Core::ECoreError::InvalidJSON);
    }
}

TEST_CASE("A character that must be checked is found at each place of a string of any length")
{
    using namespace std::string_view_literals;
    struct Piece
    {
        std::string_view text;
        std::string_view meaning;
    };
    constexpr std::size_t LONGEST = 40;
    for (std::size_t length = 0; length <= LONGEST; ++length)
    {
        for (std::size_t place = 0; place <= length; ++place)
        {
            const std::string before(place, 'x');
            const std::string behind(length - place, '\x7F');
            CAPTURE(length, place);
            for (const Piece& piece :
                 {Piece{"", ""},
                  Piece{R"(\n)", "\n"},
                  Piece{R"(\")", "\""},
                  Piece{R"(\\)", "\\"},
                  Piece{R"(\u0000)", "\0"sv},
                  Piece{R"(\ud83d\ude00)", "\xF0\x9F\x98\x80"},
                  Piece{"\xED\x95\x9C", "\xED\x95\x9C"}})
            {
                CAPTURE(piece.text);
                const std::string inside = fmt::format("{}{}{}{}", before, piece.text, behind, piece.text);
                const std::string meaning = fmt::format("{}{}{}{}", before, piece.meaning, behind, piece.meaning);
                JsonDocument document;
                const auto root = document.Parse(fmt::format(R"({{"{}":"{}"}})", inside, inside), {});
                REQUIRE(root.has_value());
                const auto member = (*root)->MemberBegin();
                CHECK(std::string_view(member->name.GetString(), member->name.GetStringLength()) == meaning);
                CHECK(std::string_view(member->value.GetString(), member->value.GetStringLength()) == meaning);
            }
            for (const std::string_view bad : {"\0"sv, "\x01"sv, "\x1F"sv})
            {
                CheckFailsAt(place + 1, fmt::format(R"("{}{}{}")", before, bad, behind));
            }
            CheckFailsAt(length + 1, fmt::format(R"("{}{})", before, behind));
        }
    }
}

TEST_CASE("A document does not depend on the lifetime of the text that it was parsed from")
{
    for (const std::size_t length : {std::size_t{3}, std::size_t{100}, std::size_t{100'000}})
    {
        const std::string word(length, 'x');
        std::string text = fmt::format(R"({{"{0}":["{0}","\n{0}",-12.5e1]}})", word);
        JsonDocument document;
        const auto root = document.Parse(text, {});
        REQUIRE(root.has_value());
        text.assign(text.size(), ' ');
        CHECK(WriteText(**root) == fmt::format(R"({{"{0}":["{0}","\n{0}",-125.0]}})", word));
    }
}

TEST_CASE("White space and a byte order mark around the text are accepted")
{
    CHECK_FALSE(GetParseError("\xEF\xBB\xBF {\"a\": 1} \r\n"));
}

TEST_CASE("A document can be parsed repeatedly in the same buffers")
{
    JsonDocument document;
    for (int i = 0; i < 1000; ++i)
    {
        const auto root = document.Parse(R"({"a":[1,2,3],"b":"text"})", {});
        REQUIRE(root);
        REQUIRE((*root)->MemberCount() == 2);
    }
    CHECK_FALSE(document.Parse("{", {}));
    CHECK(document.Parse("{}", {}));
}

TEST_CASE("A repeated name is found at any depth")
{
    JsonDocument document;
    CHECK(HasDuplicateNames(**document.Parse(R"([{"a":{"b":1,"b":2}}])", {})));
    CHECK_FALSE(HasDuplicateNames(**document.Parse(R"([{"a":{"b":1}},{"a":{"b":1}}])", {})));
}

} // namespace ACS::Json::Test
