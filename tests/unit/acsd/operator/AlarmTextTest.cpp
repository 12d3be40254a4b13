#include "operator/AlarmText.hpp"

#include "Catch.hpp"
#include "mcs/ReportMapper.hpp"

namespace ACS::Acsd::Test
{

TEST_CASE("The text of ACS-1008 has the command that resolves the job; a message of the site is sent unchanged")
{
    Planning::Alarm alarm;
    alarm.robotID = "LR01";
    alarm.errorCode = "ACS-1008";
    alarm.message = "Look.";
    alarm.planID = "P'1 ü";
    alarm.jobID = "J-1";
    const std::string text = MakeAlarmText(alarm);
    CHECK(text == R"(Look. To resolve the job: acsctl resolve 'P'\''1 ü' J-1 done (or failed).)");
    CHECK(MakeErrorReport(alarm, true).message == text);

    alarm.stepNo = 3;
    CHECK(MakeAlarmText(alarm) == text); // its plan has ended
    alarm.message = "Look. Answer again (the job was not done). Or skip the step.";
    CHECK(MakeAlarmText(alarm).find(" J-1 done (or failed, or again). ") != std::string::npos);
    CHECK(MakeAlarmText(alarm).ends_with(R"( To skip the step: acsctl skip 'P'\''1 ü' 3.)"));
    alarm.message = "Look.";

    MessageStyle style;
    style.errors["ACS-1008"].message = "Call 110";
    CHECK(MakeErrorReport(alarm, true, style).message == "Call 110");
    alarm.errorCode = "ACS-1007";
    CHECK(MakeAlarmText(alarm) == "Look.");
}

} // namespace ACS::Acsd::Test
