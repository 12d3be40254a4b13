#include "Catch.hpp"
#include <acs/core/RobotID.hpp>

#include <unordered_set>

using ACS::Core::ECoreError;
using ACS::Core::Result;
using ACS::Core::RobotID;

TEST_CASE("10 A robot's name is 1 to 64 letters, digits, underscores and hyphens")
{
    const std::string longest(RobotID::MAX_LENGTH, 'x');
    for (const std::string& text : {std::string("LR01"), std::string("RBT01"), std::string("cr-02_b"), longest})
    {
        INFO(text);
        const Result<RobotID> robotID = RobotID::Parse(text);
        REQUIRE(robotID.has_value());
        CHECK(robotID->GetText() == text);
        CHECK_FALSE(robotID->IsAlias());
    }
    for (const std::string& text :
         {std::string(),
          longest + "x",
          std::string("LR 01"),
          std::string("LR.01"),
          std::string("L\xC3\xA4R"),
          std::string("LR\0", 3)})
    {
        INFO(text);
        const Result<RobotID> robotID = RobotID::Parse(text);
        REQUIRE_FALSE(robotID.has_value());
        CHECK(robotID.error().code == ECoreError::InvalidIdentifier);
    }
}

TEST_CASE("10 A robot's name cannot be read as an element of a location")
{
    for (const std::string_view text :
         {"A01", "a1", "A00", "A12345", "ST01", "st1", "SET12", "T01", "CP01", "TP15", "mp25"})
    {
        INFO(text);
        CHECK_FALSE(RobotID::Parse(text).has_value());
    }
    for (const std::string_view text : {"A", "A01B", "AB01", "SETX", "ST-01", "01", "AGV01"})
    {
        INFO(text);
        CHECK(RobotID::Parse(text).has_value());
    }
}

TEST_CASE("10 AMR is the alias of the robot that executes the plan")
{
    CHECK(RobotID::Parse("AMR").value().IsAlias());
    CHECK_FALSE(RobotID::Parse("AMR01").value().IsAlias());
}

TEST_CASE("10 Robots' names compare, sort and hash by their text, with case")
{
    const RobotID lower = RobotID::Parse("lr01").value();
    const RobotID upper = RobotID::Parse("LR01").value();
    CHECK(lower != upper);
    CHECK(upper < lower);
    CHECK(upper == RobotID::Parse("LR01").value());
    const std::unordered_set<RobotID> fleet{lower, upper, upper};
    CHECK(fleet.size() == 2);
}
