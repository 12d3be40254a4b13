#pragma once

#include <span>
#include <string_view>

namespace ACS::Acsd
{

/// What an alarm means and what to do about it. The texts have static storage.
struct AlarmDescription
{
    std::string_view errorCode; ///< "ACS-1002"; "AGV-*" for the errors of vehicles, "*" for every other code.
    std::string_view title;     ///< A noun phrase.
    std::string_view cause;     ///< One or two sentences.
    /// At most two sentences. Commands of acsctl are between backticks; ROBOT, CODE, PLAN and JOB in them stand for the members
    /// robotId, errorCode, planId and jobId of the alarm.
    std::string_view remedy;
};

/// Every entry, by code; then "AGV-*" and "*".
[[nodiscard]] std::span<const AlarmDescription> GetAlarmCatalog() noexcept;

/// The entry of a code. It must be acsd's own code, as in Planning::Alarm::errorCode: `errors.map` renames codes only in the
/// messages to the MCS (Rename of ErrorNames.hpp), and two of acsd's codes may get one name there. A code without an entry of
/// its own has that of "AGV-*" if it begins with "AGV-", otherwise that of "*".
[[nodiscard]] const AlarmDescription& DescribeAlarm(std::string_view errorCode) noexcept;

} // namespace ACS::Acsd
