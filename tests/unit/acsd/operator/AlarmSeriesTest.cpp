#include "operator/AlarmSeries.hpp"

#include "Catch.hpp"

#include <string>

namespace ACS::Acsd::Test
{

namespace
{

Planning::Alarm MakeAlarm(const std::string& robotID, const std::string& code)
{
    Planning::Alarm alarm;
    alarm.robotID = robotID;
    alarm.errorCode = code;
    alarm.level = Planning::EAlarmLevel::Heavy;
    return alarm;
}

Apps::MetricsEndpoint::Labels MakeLabels(const std::string& robotID, const std::string& code)
{
    return {{"robot", robotID}, {"code", code}, {"level", "heavy"}};
}

} // namespace

TEST_CASE("A robot that invents error codes has a limited number of series, and the alarms of acsd stay visible")
{
    AlarmSeries series;
    for (int number = 0; number < 1'000; ++number)
    {
        const auto counted = series.Count({MakeAlarm("LR01", "AGV-" + std::to_string(number))});
        REQUIRE(counted.size() == 1);
    }
    const auto counted = series.Count(
        {MakeAlarm("LR01", "AGV-0"),
         MakeAlarm("LR01", "AGV-998"),
         MakeAlarm("LR01", "AGV-999"),
         MakeAlarm("LR01", "ACS-1002"),
         MakeAlarm("LR02", "AGV-999")});
    CHECK(counted.size() == 4);
    CHECK(counted.at(MakeLabels("LR01", "AGV-0")) == 1);
    CHECK(counted.at(MakeLabels("LR01", "other")) == 2);
    CHECK(counted.at(MakeLabels("LR01", "ACS-1002")) == 1);
    CHECK(counted.at(MakeLabels("LR02", "AGV-999")) == 1);
}

TEST_CASE("Alarms of a robot with the same code are one series")
{
    AlarmSeries series;
    const auto counted = series.Count({MakeAlarm("LR01", "ACS-1008"), MakeAlarm("LR01", "ACS-1008")});
    CHECK(counted == Apps::MetricsEndpoint::Series{{MakeLabels("LR01", "ACS-1008"), 2.0}});
    CHECK(series.Count({}).empty());
}

} // namespace ACS::Acsd::Test
