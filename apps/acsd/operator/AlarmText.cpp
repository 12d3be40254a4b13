#include "operator/AlarmText.hpp"

#include "common/config/ShellCommand.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view WAITS_FOR_ANSWER = "ACS-1008";
// They are in the engine's message if the job can be repeated and the step skipped, which is impossible after the end of the plan.
constexpr std::string_view REPETITION_OFFERED = "again (the job";
constexpr std::string_view SKIP_OFFERED = "skip the step";

} // namespace

std::string MakeAlarmText(const Planning::Alarm& alarm)
{
    if (alarm.errorCode != WAITS_FOR_ANSWER || !alarm.planID.has_value() || !alarm.jobID.has_value())
    {
        return alarm.message;
    }
    std::string text = fmt::format(
        "{} To resolve the job: {} ({}).",
        alarm.message,
        Apps::MakeShellCommand("resolve", {*alarm.planID, *alarm.jobID, "done"}),
        alarm.message.find(REPETITION_OFFERED) != std::string::npos ? "or failed, or again" : "or failed");
    if (alarm.stepNo.has_value() && alarm.message.find(SKIP_OFFERED) != std::string::npos)
    {
        text += fmt::format(
            " To skip the step: {}.",
            Apps::MakeShellCommand("skip", {*alarm.planID, std::to_string(*alarm.stepNo)}));
    }
    return text;
}

} // namespace ACS::Acsd
