#include "Catch.hpp"
#include <acs/json/TaggedVariant.hpp>
#include <acs/json/TextCodec.hpp>
#include <acs/json/TickCount.hpp>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

namespace ACS::Json::Test
{

namespace
{

struct Begun
{
    bool operator==(const Begun&) const = default;
};

struct Span
{
    std::chrono::sys_time<std::chrono::nanoseconds> time;
    std::chrono::milliseconds duration{0};

    bool operator==(const Span&) const = default;
};

struct Moved
{
    double metres = 0;
    Span span; ///< Flat in an alternative, which is flat itself.

    bool operator==(const Moved&) const = default;
};

using Event = std::variant<Begun, Moved>;

struct Line
{
    std::string robotID;
    Event event;

    bool operator==(const Line&) const = default;
};

} // namespace

} // namespace ACS::Json::Test

namespace ACS::Json
{

template <>
struct JsonFields<Test::Begun>
{
    static constexpr auto FIELDS = std::make_tuple();
};

template <>
struct JsonFields<Test::Span>
{
    static constexpr auto FIELDS =
        std::make_tuple(RequiredTicks("time", &Test::Span::time), RequiredTicks("duration", &Test::Span::duration));
};

template <>
struct JsonFields<Test::Moved>
{
    static constexpr auto FIELDS = std::make_tuple(Nullable("metres", &Test::Moved::metres), Flat(&Test::Moved::span));
};

template <>
struct VariantTag<Test::Event>
{
    static constexpr std::string_view NAME = "event";
    static constexpr std::array<std::string_view, 2> WORDS{"Begun", "Moved"};
};

template <>
struct JsonFields<Test::Line>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("robotId", &Test::Line::robotID), Required("event", &Test::Line::event));
};

} // namespace ACS::Json

namespace ACS::Json::Test
{

namespace
{

std::string DescribeFailure(std::string_view event)
{
    const Core::Result<Line> line = DecodeText<Line>(fmt::format(R"({{"robotId":"LR01","event":{}}})", event));
    return line.has_value() ? "none" : Core::Describe(line.error());
}

} // namespace

TEST_CASE("A variant is written with the word of its alternative first, and read as it was")
{
    const Line moved{
        "LR01",
        Moved{
            1.5,
            {std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(-7)),
             std::chrono::milliseconds(20)}}};
    CHECK(EncodeText(moved) == R"({"robotId":"LR01","event":{"event":"Moved","metres":1.5,"time":-7,"duration":20}})");
    CHECK(DecodeText<Line>(EncodeText(moved)) == moved);
    const Line begun{"LR01", Begun{}};
    CHECK(EncodeText(begun) == R"({"robotId":"LR01","event":{"event":"Begun"}})");
    CHECK(DecodeText<Line>(EncodeText(begun)) == begun);
    CHECK(DecodeText<Event>(R"({"duration":20,"time":-7,"event":"Moved","metres":1.5})") == moved.event);
}

TEST_CASE("What is not an alternative of the variant is refused with its path")
{
    struct Refusal
    {
        std::string_view event;
        std::string_view part;
    };
    for (const auto& [event, part] :
         {Refusal{R"({"event":"Stopped"})", "event.event"},
          Refusal{R"({"event":"Stopped"})", "one of Begun, Moved"},
          Refusal{R"({"event":"begun"})", "event.event"},
          Refusal{R"({"event":7})", "event.event"},
          Refusal{"{}", "event.event"},
          Refusal{"[]", "an object"},
          Refusal{R"({"event":"Moved","metres":1})", "event.time"},
          Refusal{R"({"event":"Moved","time":1,"time":1,"duration":1})", "event.time"},
          Refusal{R"({"event":"Begun","event":"Begun"})", "event.event"}})
    {
        const std::string failure = DescribeFailure(event);
        INFO(failure);
        CHECK(failure.find(part) != std::string::npos);
    }
}

TEST_CASE("A nullable number that is not finite is written as null, and read as not finite")
{
    for (const double metres : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        const std::string text = EncodeText(Event(Moved{metres, {}}));
        CHECK(text == R"({"event":"Moved","metres":null,"time":0,"duration":0})");
        const Core::Result<Event> read = DecodeText<Event>(text);
        REQUIRE(read.has_value());
        CHECK_FALSE(std::isfinite(std::get<Moved>(*read).metres));
    }
}

} // namespace ACS::Json::Test
