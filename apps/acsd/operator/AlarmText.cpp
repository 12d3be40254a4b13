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

/// A segment of a path.
std::string EncodeSegment(std::string_view text)
{
    constexpr std::string_view PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
    std::string encoded;
    for (const char character : text)
    {
        const bool bPlain = PLAIN.find(character) != std::string_view::npos;
        encoded += bPlain ? std::string(1, character)
                          : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(character)));
    }
    return encoded;
}

} // namespace

std::string MakeAlarmText(const Planning::Alarm& alarm)
{
    if (alarm.errorCode != WAITS_FOR_ANSWER || !alarm.planID.has_value() || !alarm.jobID.has_value())
    {
        return alarm.message;
    }
    const std::string planID = EncodeSegment(*alarm.planID);
    std::string text = fmt::format(
        "{} To resolve the job, send POST /plans/{}/jobs/{}/done to acsd's HTTP address, with the answer in the place of done.",
        alarm.message,
        planID,
        EncodeSegment(*alarm.jobID));
    if (alarm.stepNo.has_value() && alarm.message.find(SKIP_OFFERED) != std::string::npos)
    {
        text += fmt::format(" To skip the step, send POST /plans/{}/steps/{}/skip.", planID, *alarm.stepNo);
    }
    return text;
}

} // namespace ACS::Acsd
