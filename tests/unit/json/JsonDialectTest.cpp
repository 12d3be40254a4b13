#include "Catch.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Json::Test
{

constexpr DialectFlags OLD = 1;
constexpr DialectFlags NEW = 2;

struct Dialects
{
    std::string name;
    std::optional<double> speed;
    std::optional<double> added;

    bool operator==(const Dialects&) const = default;
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
        Optional("added", &Test::Dialects::added).WrittenIn(Test::NEW));
};

} // namespace ACS::Json

namespace ACS::Json::Test
{

namespace
{

std::optional<Dialects> ReadOrNull(std::string_view text)
{
    JsonDocument document;
    const Core::Result<const Value*> root = document.Parse(text, {});
    DecodeContext context;
    Dialects message;
    if (!root || !TryDecode(**root, message, {}, context))
    {
        return std::nullopt;
    }
    return message;
}

std::string Write(const Dialects& message, DialectFlags dialect)
{
    std::string text;
    JsonWriter writer(text, dialect);
    Encode(message, writer);
    return text;
}

} // namespace

TEST_CASE("A field is read by its other name, required or optional")
{
    CHECK(ReadOrNull(R"({"nom":"x","Speed":2})") == Dialects{"x", 2.0, {}});
    CHECK(ReadOrNull(R"({"name":"x","speed":2})") == Dialects{"x", 2.0, {}});
}

TEST_CASE("A field under both of its names is a repeated member, under none a missing one")
{
    CHECK_FALSE(ReadOrNull(R"({"name":"x","nom":"y"})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"nom":"x","name":"y"})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"speed":1})").has_value());
    CHECK_FALSE(ReadOrNull(R"({"nom":null})").has_value());
}

TEST_CASE("A field is written under its own name, and only in its dialects")
{
    const Dialects message{"x", 2.5, 1.5};
    CHECK(Write(message, OLD) == R"({"name":"x","speed":2.5})");
    CHECK(Write(message, NEW) == R"({"name":"x","speed":2.5,"added":1.5})");
    CHECK(ReadOrNull(R"({"name":"x","added":1.5})") == Dialects{"x", {}, 1.5});
}

} // namespace ACS::Json::Test
