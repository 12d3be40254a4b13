#include "operator/AlarmText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view WAITS_FOR_ANSWER = "ACS-1008";
/// Is in the engine's message if the step can be skipped, which it cannot after the end of its plan.
constexpr std::string_view SKIP_OFFERED = "skip the step";

/// An argument of a command line in a shell.
std::string QuoteArgument(std::string_view text)
{
    constexpr std::string_view PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._:/@";
    if (!text.empty() && text.find_first_not_of(PLAIN) == std::string_view::npos)
    {
        return std::string(text);
    }
    std::string quoted = "'";
    for (const char character : text)
    {
        quoted += character == '\'' ? std::string("'\\''") : std::string(1, character);
    }
    return quoted + "'";
}

} // namespace

std::string MakeAlarmText(const Planning::Alarm& alarm)
{
    if (alarm.errorCode != WAITS_FOR_ANSWER || !alarm.planID.has_value() || !alarm.jobID.has_value())
    {
        return alarm.message;
    }
    const std::string planID = QuoteArgument(*alarm.planID);
    std::string text = fmt::format(
        "{} To resolve the job: acsctl resolve {} {} done (or failed, or again).",
        alarm.message,
        planID,
        QuoteArgument(*alarm.jobID));
    if (alarm.stepNo.has_value() && alarm.message.find(SKIP_OFFERED) != std::string::npos)
    {
        text += fmt::format(" To skip the step: acsctl skip {} {}.", planID, *alarm.stepNo);
    }
    return text;
}

} // namespace ACS::Acsd
