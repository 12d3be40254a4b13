#include "Catch.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Json::Test
{

constexpr DialectFlags OLD = 1;
constexpr DialectFlags NEW = 2;

struct Dialects
{
    std::string name;
    std::optional<double> speed;
    std::optional<double> added;
    std::optional<double> angle;
    double charge = 0.0;
    std::vector<double> knots;

    bool operator==(const Dialects&) const = default;
};

struct Free
{
    Core::JsonText value;
    std::optional<Core::JsonText> object;
    std::optional<Core::JsonText> text;
};

} // namespace ACS::Json::Test

namespace ACS::Json
{

template <>
struct JsonFields<Test::Dialects>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("name", &Test::Dialects::name),
        Alias("nom", &Test::Dialects::name),
        Optional("speed", &Test::Dialects::speed),
        Alias("Speed", &Test::Dialects::speed),
        Optional("added", &Test::Dialects::added).WrittenIn(Test::NEW),
        Optional("angle", &Test::Dialects::angle).Between(-3.2, 3.2).WrittenBetween(-3.0, 3.0),
        Defaulted("charge", &Test::Dialects::charge).WholeIn(Test::OLD).WrittenIn(Test::OLD),
        Optional("knots", &Test::Dialects::knots).Between(0, 1));
};

template <>
struct JsonFields<Test::Free>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("value", &Test::Free::value),
        Optional("object", &Test::Free::object).WrittenIfObject(),
        Optional("text", &Test::Free::text).WrittenIfString());
};

} // namespace ACS::Json

namespace ACS::Json::Test
{

namespace
{

template <typename T = Dialects>
std::optional<T> ReadOrNull(std::string_view text)
{
    JsonDocument document;
    const Core::Result<const Value*> root = document.Parse(text, {});
    DecodeContext context;
    T message;
    if (!root || !TryDecode(**root, message, {}, context))
    {
        return std::nullopt;
    }
    return message;
}

template <typename T>
std::string Write(const T& message, DialectFlags dialect)
{
    std::string text;
    JsonWriter writer(text, dialect);
    Encode(message, writer);
    return text;
}

} // namespace

TEST_CASE("A required or optional field is read by its other name")
{
    CHECK(ReadOrNull(R"({"nom":"x","Speed":2})") == Dialects{"x", 2.0, {}, {}, 0.0, {}});
    CHECK(ReadOrNull(R"({"name":"x","speed":2})") == Dialects{"x", 2.0, {}, {}, 0.0, {}});
}

TEST_CASE("A field under both of its names is a repeated member, a required one under neither is missing")
{
    CHECK_FALSE(ReadOrNull(R"({"name":"x","nom":"y"})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"nom":"x","name":"y"})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"speed":1})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"nom":null})").has_value());
}

TEST_CASE("A field is written under its own name, and only in its dialects")
{
    const Dialects message{"x", 2.5, 1.5, {}, 0.0, {}};
    CHECK(Write(message, OLD) == R"({"name":"x","speed":2.5,"charge":0})");
    CHECK(Write(message, NEW) == R"({"name":"x","speed":2.5,"added":1.5})");
    CHECK(ReadOrNull(R"({"name":"x","added":1.5})") == Dialects{"x", {}, 1.5, {}, 0.0, {}});
}

TEST_CASE("A number is written within narrower bounds than it is read, and as an integer in a dialect that requires it")
{
    const std::optional<Dialects> read = ReadOrNull(R"({"name":"x","angle":3.1,"charge":97.5})");
    REQUIRE(read.has_value());
    CHECK(read->angle == 3.1);
    CHECK(Write(*read, OLD) == R"({"name":"x","angle":3,"charge":98})");
    CHECK(
        Write(*ReadOrNull(R"({"name":"x","angle":-3.1,"charge":0})"), OLD) == R"({"name":"x","angle":-3,"charge":0})");
    CHECK(
        Write(*ReadOrNull(R"({"name":"x","angle":2.5,"charge":0})"), OLD) == R"({"name":"x","angle":2.5,"charge":0})");
    CHECK_FALSE(ReadOrNull(R"({"name":"x","angle":3.3})").has_value());
}

TEST_CASE("The bounds of an array of numbers apply to each of them")
{
    CHECK(ReadOrNull(R"({"name":"x","knots":[0,0.5,1]})")->knots == std::vector{0.0, 0.5, 1.0});
    CHECK_FALSE(ReadOrNull(R"({"name":"x","knots":[0,1.5]})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"name":"x","knots":[-0.5,1]})").has_value());
}

TEST_CASE("A free value of a kind that strict readers refuse is read and not written")
{
    const std::string strict = R"({"value":1.5,"object":{"a":1},"text":"b"})";
    CHECK(Write(*ReadOrNull<Free>(strict), OLD) == strict);
    CHECK(Write(*ReadOrNull<Free>(R"({"value":"","object":[],"text":{}})"), OLD) == R"({"value":""})");
}

TEST_CASE("A required free value is anything but null")
{
    CHECK(ReadOrNull<Free>(R"({"value":{"a":[null]}})")->value.GetText() == R"({"a":[null]})");
    CHECK_FALSE(ReadOrNull<Free>(R"({"value":null})").has_value());
}

} // namespace ACS::Json::Test
