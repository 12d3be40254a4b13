#include "programs/PlaceTemplate.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using ACS::Core::ESegmentKind;

namespace
{

void Write(RelayMemory& relays, const char* name, double value)
{
    const auto relay = ParseRelayNameOrNull(name);
    REQUIRE(relay.has_value());
    REQUIRE(relays.Write(*relay, value).has_value());
}

PlaceTemplate Parse(const char* text)
{
    const auto place = PlaceTemplate::Parse(text);
    REQUIRE(place.has_value());
    return *place;
}

} // namespace

TEST_CASE("A template is filled with the numbers of its relays, each with at least two digits")
{
    RelayMemory relays;
    Write(relays, "ml106", 1);
    Write(relays, "mw214", 12);
    Write(relays, "ML108", 104);
    REQUIRE(Parse("A{ml106}.CP{mw214}.TP{ml108}").Fill(relays, "CR01") == "A01.CP12.TP104");
    REQUIRE(Parse("{robot}.TP{ml106}").Fill(relays, "CR07") == "CR07.TP01");
    REQUIRE(Parse("{robot}.TP{ml106}.MP{mw214}").Fill(relays, "CR07") == "CR07.TP01.MP12");
    REQUIRE(Parse("A01.SET02").Fill(relays, "CR01") == "A01.SET02");
}

TEST_CASE("A template with a number that no place has does not apply, and the error names the relay")
{
    RelayMemory relays;
    Write(relays, "ml106", 1);
    for (const double number : {0.0, -1.0, 10'000.0})
    {
        Write(relays, "ml107", number);
        const auto place = Parse("A{ml106}.CP{ml107}").Fill(relays, "CR01");
        REQUIRE_FALSE(place.has_value());
        REQUIRE(place.error().path == "ml107");
        REQUIRE(place.error().found == std::to_string(static_cast<int>(number)));
    }
    Write(relays, "ml107", 9'999.0);
    REQUIRE(Parse("A{ml106}.CP{ml107}").Fill(relays, "CR01") == "A01.CP9999");
}

TEST_CASE("A template knows the kind of its places and whether they need the robot's name")
{
    REQUIRE(Parse("A{ml1}.CP{ml2}").GetKind() == ESegmentKind::CassettePort);
    REQUIRE(Parse("{robot}.TP{ml2}").GetKind() == ESegmentKind::TrayPort);
    REQUIRE(Parse("A{ml1}.SET{ml2}.MP{ml3}").GetKind() == ESegmentKind::MemoryPort);
    REQUIRE(Parse("{robot}.TP{ml2}").HasRobotName());
    REQUIRE_FALSE(Parse("A{ml1}.SET{ml2}").HasRobotName());
}

TEST_CASE("An invalid place, or one with a tag that is not a whole-number relay, is refused")
{
    for (const char* text :
         {"",
          "{",
          "}",
          "{}",
          "A{ml106",
          "A{ml106}.",
          "A{}.CP01",
          "A{robot}.CP01",
          "{robot}",
          "{robot}{robot}.CP01",
          "{robot}01.CP01",
          "A{ml106}.XX{ml107}",
          "A01.CP{ml99999}",
          "A01.CP{q1}",
          "A01.CP{mf107}",
          "A01.CP{from.cp}",
          "A01.CP{ml107}}",
          "ml106"})
    {
        INFO(text);
        REQUIRE_FALSE(PlaceTemplate::Parse(text).has_value());
    }
    REQUIRE(
        PlaceTemplate::Parse("A01.CP{q1}").error().expected
        == "{robot} or a relay that holds a whole number, such as {ml106}");
    REQUIRE(PlaceTemplate::Parse("A01.CP{q1}").error().found == "{q1}");
}
