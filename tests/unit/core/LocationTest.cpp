#include "Catch.hpp"
#include <acs/core/Location.hpp>

#include <algorithm>
#include <array>
#include <unordered_set>

using ACS::Core::ECoreError;
using ACS::Core::ESegmentKind;
using ACS::Core::Location;
using ACS::Core::LocationSegment;
using ACS::Core::ParseLocationRange;
using ACS::Core::Result;
using ACS::Core::RobotID;

namespace
{

Location Make(std::string_view text)
{
    return Location::Parse(text).value();
}

void CheckRefused(std::string_view text)
{
    INFO("location " << text);
    const Result<Location> location = Location::Parse(text);
    REQUIRE_FALSE(location.has_value());
    CHECK(location.error().code == ECoreError::InvalidLocation);
    CHECK_FALSE(Location::IsLocation(text));
}

struct Example
{
    std::string_view text;
    ESegmentKind kind;
    std::size_t segments;
    std::string_view dockingPlace;
};

constexpr std::array<Example, 32> EXAMPLES{{
    {"ST01", ESegmentKind::Stocker, 1, "ST01"},
    {"ST02", ESegmentKind::Stocker, 1, "ST02"},
    {"A01", ESegmentKind::Area, 1, "A01"},
    {"A02", ESegmentKind::Area, 1, "A02"},
    {"SET01", ESegmentKind::Set, 1, "SET01"},
    {"SET12", ESegmentKind::Set, 1, "SET12"},
    {"A01.CP01", ESegmentKind::CassettePort, 2, "A01.CP01"},
    {"A01.CP02", ESegmentKind::CassettePort, 2, "A01.CP02"},
    {"A01.CP03", ESegmentKind::CassettePort, 2, "A01.CP03"},
    {"A02.CP03", ESegmentKind::CassettePort, 2, "A02.CP03"},
    {"A02.CP04", ESegmentKind::CassettePort, 2, "A02.CP04"},
    {"ST01.CP02", ESegmentKind::CassettePort, 2, "ST01.CP02"},
    {"ST02.CP05", ESegmentKind::CassettePort, 2, "ST02.CP05"},
    {"A01.CP01.TP01", ESegmentKind::TrayPort, 3, "A01.CP01"},
    {"A01.CP01.TP02", ESegmentKind::TrayPort, 3, "A01.CP01"},
    {"A01.CP01.TP03", ESegmentKind::TrayPort, 3, "A01.CP01"},
    {"A01.CP01.TP04", ESegmentKind::TrayPort, 3, "A01.CP01"},
    {"A01.CP01.TP04.MP25", ESegmentKind::MemoryPort, 4, "A01.CP01"},
    {"ST01.CP01.TP01", ESegmentKind::TrayPort, 3, "ST01.CP01"},
    {"ST01.CP01.TP01.MP01", ESegmentKind::MemoryPort, 4, "ST01.CP01"},
    {"A01.SET01", ESegmentKind::Set, 2, "A01.SET01"},
    {"A01.SET02", ESegmentKind::Set, 2, "A01.SET02"},
    {"A01.SET03", ESegmentKind::Set, 2, "A01.SET03"},
    {"A01.SET01.MP01", ESegmentKind::MemoryPort, 3, "A01.SET01"},
    {"A01.SET01.MP02", ESegmentKind::MemoryPort, 3, "A01.SET01"},
    {"A01.T03", ESegmentKind::Table, 2, "A01.T03"},
    {"SET02.MP15", ESegmentKind::MemoryPort, 2, "SET02"},
    {"A01.CP100", ESegmentKind::CassettePort, 2, "A01.CP100"},
    {"A9999.SET9999.MP9999", ESegmentKind::MemoryPort, 3, "A9999.SET9999"},
    {"ST01.CP06", ESegmentKind::CassettePort, 2, "ST01.CP06"},
    {"A01.SET12.MP32", ESegmentKind::MemoryPort, 3, "A01.SET12"},
    {"A02.SET18", ESegmentKind::Set, 2, "A02.SET18"},
}};

} // namespace

TEST_CASE("10 Every fixed place of the document is a location in its canonical form")
{
    for (const Example& example : EXAMPLES)
    {
        INFO("location " << example.text);
        const Result<Location> location = Location::Parse(example.text);
        REQUIRE(location.has_value());
        CHECK(Location::IsLocation(example.text));
        CHECK(location->GetText() == example.text);
        CHECK(location->GetOriginalText() == example.text);
        CHECK_FALSE(location->WasNormalised());
        CHECK(location->GetKind() == example.kind);
        CHECK(location->GetSegments().size() == example.segments);
        CHECK(location->IsCassettePort() == (example.kind == ESegmentKind::CassettePort));
        CHECK(location->IsTrayPort() == (example.kind == ESegmentKind::TrayPort));
        CHECK(location->IsMemoryPort() == (example.kind == ESegmentKind::MemoryPort));
        CHECK(location->HasArea() == example.text.starts_with('A'));
        CHECK_FALSE(location->IsRobotPort());
        CHECK_FALSE(location->GetRobotOrNull().has_value());
        CHECK(location->GetDockingPlace().GetText() == example.dockingPlace);
        CHECK_FALSE(location->GetDockingPlace().WasNormalised());
    }
}

TEST_CASE("10 Every robot port of the document, and those of named robots, are locations")
{
    for (const std::string_view text :
         {"AMR.CP01",
          "AMR.TP01",
          "AMR.TP02",
          "AMR.TP03",
          "AMR.TP01.MP01",
          "AMR.TP02.MP01",
          "LR01.CP01",
          "RBT01.CP01",
          "CR01.TP01",
          "CR02.TP03.MP25",
          "lr-01_b.CP01"})
    {
        INFO("location " << text);
        const Result<Location> location = Location::Parse(text);
        REQUIRE(location.has_value());
        CHECK(Location::IsLocation(text));
        CHECK(location->GetText() == text);
        CHECK_FALSE(location->WasNormalised());
        CHECK(location->IsRobotPort());
        CHECK_FALSE(location->HasArea());
        REQUIRE(location->GetRobotOrNull().has_value());
        CHECK(location->GetRobotOrNull()->GetText() == text.substr(0, text.find('.')));
        CHECK(location->GetRobotOrNull()->IsAlias() == text.starts_with("AMR."));
        CHECK(location->GetSegments().front() == LocationSegment{ESegmentKind::Robot, 0});
        CHECK(location->GetDockingPlace() == *location);
    }
}

TEST_CASE("10 The element id of a port alone is not a location")
{
    for (const std::string_view text : {"CP01", "CP02", "TP01", "TP15", "MP01", "MP25", "T01", "AMR", "LR01"})
    {
        CheckRefused(text);
    }
}

TEST_CASE("10 The number 00 in a location is invalid")
{
    for (const std::string_view text :
         {"A00", "ST00", "A01.CP00", "A01.SET0", "A01.CP01.TP000", "AMR.CP00", "A00.CP01"})
    {
        CheckRefused(text);
    }
}

TEST_CASE("10 Segments follow each other as defined by the grammar")
{
    for (const std::string_view text :
         {"A01.ST01",     "A01.TP01",      "A01.MP01",       "A01.A02",       "ST01.SET01",
          "ST01.T01",     "ST01.TP01",     "SET01.CP01",     "SET01.TP01",    "A01.T01.SET01",
          "A01.T01.CP01", "T01.SET01",     "A01.SET01.TP01", "A01.CP01.MP01", "A01.CP01.TP01.MP01.MP02",
          "A01.LR01",     "AMR.SET01",     "AMR.MP01",       "AMR.CP01.TP01", "AMR.TP01.TP02",
          "AMR.A01.CP01", "AMR.LR01.CP01", "CP01.TP01"})
    {
        CheckRefused(text);
    }
}

TEST_CASE("10 Other text is not a location")
{
    for (const std::string_view text :
         {"",
          ".",
          "A01.",
          ".CP01",
          "A01..CP01",
          " A01",
          "A01 ",
          "A01.CP-1",
          "A01.CP+1",
          "A01.CP",
          "A01.CP0x1",
          "A01.CP01x",
          "A01.CP12345",
          "A01.XP01",
          "A01.SET01.MP01~MP32",
          "A01/CP01",
          "A 1.CP01",
          "N\xC3\xB6.CP01"})
    {
        CheckRefused(text);
    }
    CheckRefused(std::string_view("A01\0.CP01", 9));
}

TEST_CASE("10 Lower case and missing or superfluous zeros are accepted and marked")
{
    struct Spelling
    {
        std::string_view text;
        std::string_view canonical;
    };
    constexpr std::array<Spelling, 7> SPELLINGS{{
        {"a01.cp01", "A01.CP01"},
        {"A1.CP1.TP4", "A01.CP01.TP04"},
        {"St1.Cp02", "ST01.CP02"},
        {"A001.SET0012.MP1", "A01.SET12.MP01"},
        {"A01.CP0100", "A01.CP100"},
        {"amr.tp1", "AMR.TP01"},
        {"lr01.cp1", "lr01.CP01"},
    }};
    for (const Spelling& spelling : SPELLINGS)
    {
        INFO("location " << spelling.text);
        const Result<Location> location = Location::Parse(spelling.text);
        REQUIRE(location.has_value());
        CHECK(Location::IsLocation(spelling.text));
        CHECK(location->GetText() == spelling.canonical);
        CHECK(location->GetOriginalText() == spelling.text);
        CHECK(location->WasNormalised());
    }
}

TEST_CASE("R17 Every number below ten is written with two digits, whatever the sender wrote")
{
    for (unsigned number = 1; number <= 12; ++number)
    {
        const std::string bare = std::to_string(number);
        const std::string padded = number < 10 ? "0" + bare : bare;
        const auto expand = [](std::string text, const std::string& digits) {
            for (std::size_t at = text.find('#'); at != std::string::npos; at = text.find('#'))
            {
                text.replace(at, 1, digits);
            }
            return text;
        };
        for (const std::string form :
             {"ST#.CP#.TP#.MP#", "A#.CP#.TP#.MP#", "A#.SET#.MP#", "A#.T#", "SET#.MP#", "AMR.CP#", "AMR.TP#.MP#"})
        {
            const Location location = Make(expand(form, bare));
            CHECK(location.GetText() == expand(form, padded));
            CHECK(location.WasNormalised() == (number < 10));
            CHECK(Make(expand(form, padded)).GetText() == expand(form, padded));
        }
    }
}

TEST_CASE("10 Locations compare, sort and hash by their canonical text")
{
    CHECK(Make("a1.cp1") == Make("A01.CP01"));
    CHECK(Make("A01.CP01") != Make("A01.CP02"));
    CHECK(Make("A01.CP01") < Make("A01.CP02"));
    CHECK(Make("LR01.CP01") != Make("lr01.CP01"));
    const std::unordered_set<Location> places{Make("a1.cp1"), Make("A01.CP01"), Make("A01.CP02")};
    CHECK(places.size() == 2);
}

TEST_CASE("10 A location has at most 64 characters, also after it is normalised")
{
    const std::string robot(Location::MAX_LENGTH - 5, 'r');
    CHECK(Location::Parse(robot + ".CP01").has_value());
    CheckRefused(robot + "r.CP01");
    CheckRefused(robot + "r.CP1");
    const std::string shorter = robot.substr(5);
    CHECK(Make(shorter + ".TP1.MP1").GetText().size() == Location::MAX_LENGTH);
    CheckRefused(shorter + "r.TP1.MP1");
    CHECK(Location::Parse(shorter + ".TP01.MP01").has_value());
    CheckRefused(shorter + ".TP01.MP001");
}

TEST_CASE("10 A NUL before an element is refused")
{
    const std::string nul(1, '\0');
    for (const std::string& text : {nul + "A01", nul + nul + "A01.CP01", "A01." + nul + "CP01", nul + "ST01"})
    {
        CheckRefused(text);
        CHECK_FALSE(RobotID::IsRobotID(text));
    }
}

TEST_CASE("10 The alias becomes the robot that executes the plan, and the spelling of the sender is kept")
{
    const RobotID robotID = RobotID::Parse("LR01").value();
    const Location resolved = Make("amr.cp1").WithRobot(robotID).value();
    CHECK(resolved == Make("LR01.CP01"));
    CHECK(resolved.GetRobotOrNull() == robotID);
    CHECK(resolved.GetOriginalText() == "amr.cp1");
    CHECK(resolved.WasNormalised());
    CHECK_FALSE(Make("AMR.TP01.MP01").WithRobot(robotID).value().WasNormalised());

    CHECK(Make("LR02.CP01").WithRobot(robotID).value() == Make("LR02.CP01"));
    CHECK(Make("A01.CP01").WithRobot(robotID).value() == Make("A01.CP01"));
}

TEST_CASE("10 A robot's name that is too long for its ports is refused")
{
    const RobotID longID = RobotID::Parse(std::string(RobotID::MAX_LENGTH, 'r')).value();
    const Result<Location> location = Make("AMR.CP01").WithRobot(longID);
    REQUIRE_FALSE(location.has_value());
    CHECK(location.error().code == ECoreError::InvalidLocation);
}

TEST_CASE("10 The short form of a set takes its area from another location")
{
    const Location resolved = Make("SET02.MP15").WithAreaOf(Make("A01.CP03"));
    CHECK(resolved.GetText() == "A01.SET02.MP15");
    CHECK(resolved.GetOriginalText() == "SET02.MP15");
    CHECK_FALSE(resolved.WasNormalised());
    CHECK(resolved.GetAreaNumberOrNull() == 1);
    CHECK(resolved.GetDockingPlace().GetText() == "A01.SET02");
    CHECK(Make("SET2").WithAreaOf(Make("A02")).GetText() == "A02.SET02");

    CHECK(Make("SET02").WithAreaOf(Make("ST01.CP01")) == Make("SET02"));
    CHECK(Make("A02.SET02").WithAreaOf(Make("A01")) == Make("A02.SET02"));
    CHECK(Make("AMR.CP01").WithAreaOf(Make("A01")) == Make("AMR.CP01"));
    CHECK_FALSE(Make("SET02").GetAreaNumberOrNull().has_value());
}

TEST_CASE("10 A range is every location from its first to its last number")
{
    const auto expand = [](std::string_view text) {
        std::vector<std::string> texts;
        const std::vector<Location> locations = ParseLocationRange(text).value();
        for (const Location& location : locations)
        {
            CHECK_FALSE(location.WasNormalised());
            texts.push_back(location.GetText());
        }
        return texts;
    };
    using Texts = std::vector<std::string>;
    CHECK(expand("A01.CP01.TP01-04") == Texts{"A01.CP01.TP01", "A01.CP01.TP02", "A01.CP01.TP03", "A01.CP01.TP04"});
    CHECK(expand("A01.CP01") == Texts{"A01.CP01"});
    CHECK(expand("A01.SET09-11") == Texts{"A01.SET09", "A01.SET10", "A01.SET11"});
    CHECK(expand("ST01-2") == Texts{"ST01", "ST02"});
    CHECK(expand("A01.CP03-03") == Texts{"A01.CP03"});
    CHECK(expand("lr-01.TP01-02") == Texts{"lr-01.TP01", "lr-01.TP02"});
    CHECK(expand("LR-01.CP01") == Texts{"LR-01.CP01"});
    CHECK(expand("A01.SET01.MP0001-999").size() == 999);
    CHECK(expand("A01.SET01.MP99-100").back() == "A01.SET01.MP100");
}

TEST_CASE("10 A range that is empty, descending, too long or of another form is refused")
{
    for (const std::string_view text :
         {"",
          "A01.CP01.TP01-",
          "A01.CP01.TP-04",
          "A01.CP01.TP04-01",
          "A01.CP01.TP01-00",
          "A01.CP01.TP00-04",
          "A01.CP01.TP01-1000",
          "A01.CP01.TP01-99999",
          "A01.CP01.TP01-TP04",
          "A01.CP01.TP01~TP04",
          "A01.CP01.TP01-02-03",
          "A01.CP01-02.TP01",
          "LR-01"})
    {
        INFO("range " << text);
        const Result<std::vector<Location>> locations = ParseLocationRange(text);
        REQUIRE_FALSE(locations.has_value());
        CHECK(locations.error().code == ECoreError::InvalidLocation);
    }
}
