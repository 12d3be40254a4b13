#include "operator/AlarmText.hpp"

#include "Catch.hpp"
#include "common/http/HttpMessage.hpp"
#include "mcs/ReportMapper.hpp"

namespace ACS::Acsd::Test
{

TEST_CASE("The text of ACS-1008 has the request that resolves the job; a message of the site is sent unchanged")
{
    Planning::Alarm alarm;
    alarm.robotID = "LR01";
    alarm.errorCode = "ACS-1008";
    alarm.message = "Look.";
    alarm.planID = "P/1 ü";
    alarm.jobID = "J-1";
    const std::string text = MakeAlarmText(alarm);
    CHECK(
        text
        == "Look. To resolve the job, send POST /plans/P%2F1%20%C3%BC/jobs/J-1/done to acsd's HTTP address, with the answer in "
           "the place of done.");
    const std::size_t begin = text.find("/plans/");
    const Core::Result<Apps::HttpRequest> target =
        Apps::ParseHttpTarget(std::string_view(text).substr(begin, text.find(' ', begin) - begin));
    REQUIRE(target.has_value());
    CHECK(target->segments == std::vector<std::string>{"plans", "P/1 ü", "jobs", "J-1", "done"});
    CHECK(MakeErrorReport(alarm, true).message == text);

    alarm.stepNo = 3;
    CHECK(MakeAlarmText(alarm) == text); // its plan has ended
    alarm.message = "Look. Or skip the step.";
    CHECK(MakeAlarmText(alarm).ends_with(" To skip the step, send POST /plans/P%2F1%20%C3%BC/steps/3/skip."));
    alarm.message = "Look.";

    MessageStyle style;
    style.errors["ACS-1008"].message = "Call 110";
    CHECK(MakeErrorReport(alarm, true, style).message == "Call 110");
    alarm.errorCode = "ACS-1007";
    CHECK(MakeAlarmText(alarm) == "Look.");
}

} // namespace ACS::Acsd::Test
