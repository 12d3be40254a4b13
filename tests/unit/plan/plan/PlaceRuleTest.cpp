#include "plan/PlaceRule.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Core::Location;

namespace
{

bool IsAllowed(const char* place, EPlaceRule rule)
{
    return IsPlaceAllowed(Location::Parse(place).value(), rule);
}

} // namespace

TEST_CASE("Place rules: ports of the site and of the robot, and memory ports of both")
{
    CHECK(IsAllowed("A01.CP01", EPlaceRule::FixedCassette));
    CHECK_FALSE(IsAllowed("AMR.CP01", EPlaceRule::FixedCassette));
    CHECK(IsAllowed("A01.CP01.TP01", EPlaceRule::FixedTray));
    CHECK_FALSE(IsAllowed("A01.CP01", EPlaceRule::FixedTray));
    CHECK(IsAllowed("AMR.CP01", EPlaceRule::RobotCassette));
    CHECK_FALSE(IsAllowed("A01.CP01", EPlaceRule::RobotCassette));
    CHECK(IsAllowed("AMR.TP01", EPlaceRule::RobotTray));
    CHECK_FALSE(IsAllowed("AMR.CP01", EPlaceRule::RobotTray));
    CHECK(IsAllowed("A01.SET01.MP01", EPlaceRule::Memory));
    CHECK(IsAllowed("AMR.TP01.MP01", EPlaceRule::Memory));
    CHECK_FALSE(IsAllowed("AMR.TP01", EPlaceRule::Memory));
    CHECK(IsAllowed("A01.CP01", EPlaceRule::None));
}

TEST_CASE("Place rules: the example in a description is a place that the rule allows")
{
    for (const EPlaceRule rule :
         {EPlaceRule::FixedCassette, EPlaceRule::FixedTray, EPlaceRule::RobotCassette, EPlaceRule::RobotTray})
    {
        const std::string text(DescribePlaceRule(rule));
        const std::size_t begin = text.find('(') + 1;
        CHECK(IsAllowed(text.substr(begin, text.find(')') - begin).c_str(), rule));
    }
}
