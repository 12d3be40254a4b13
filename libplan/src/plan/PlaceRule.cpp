#include "plan/PlaceRule.hpp"

namespace ACS::Planning
{

std::string_view DescribePlaceRule(EPlaceRule rule)
{
    switch (rule)
    {
        case EPlaceRule::None:
            return "nothing";
        case EPlaceRule::FixedCassette:
            return "a cassette port of the site (A01.CP01)";
        case EPlaceRule::FixedTray:
            return "a tray port of the site (A01.CP01.TP01)";
        case EPlaceRule::RobotCassette:
            return "a cassette port of the robot (AMR.CP01)";
        case EPlaceRule::RobotTray:
            return "a tray port of the robot (AMR.TP01)";
        case EPlaceRule::Memory:
            return "a memory port (A01.SET01.MP01 or AMR.TP01.MP01)";
        default:
            return "a place";
    }
}

bool IsPlaceAllowed(const Core::Location& place, EPlaceRule rule)
{
    switch (rule)
    {
        case EPlaceRule::None:
            return true;
        case EPlaceRule::FixedCassette:
            return place.IsCassettePort() && !place.IsRobotPort();
        case EPlaceRule::FixedTray:
            return place.IsTrayPort() && !place.IsRobotPort();
        case EPlaceRule::RobotCassette:
            return place.IsCassettePort() && place.IsRobotPort();
        case EPlaceRule::RobotTray:
            return place.IsTrayPort() && place.IsRobotPort();
        case EPlaceRule::Memory:
            return place.IsMemoryPort();
        default:
            return false;
    }
}

} // namespace ACS::Planning
