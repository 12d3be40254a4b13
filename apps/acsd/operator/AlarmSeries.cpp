#include "operator/AlarmSeries.hpp"

#include <acs/plan/EAlarmLevel.hpp>

#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view OTHER_CODES = "other";
/// Of acsd's own alarms. Robots have other codes.
constexpr std::string_view OWN_PREFIX = "ACS-";

} // namespace

Apps::MetricsEndpoint::Series AlarmSeries::Count(const std::vector<Planning::Alarm>& alarms)
{
    Apps::MetricsEndpoint::Series series;
    for (const Planning::Alarm& alarm : alarms)
    {
        ++series[{{"robot", alarm.robotID}, {"code", GetCode(alarm)}, {"level", std::string(GetText(alarm.level))}}];
    }
    return series;
}

std::string AlarmSeries::GetCode(const Planning::Alarm& alarm)
{
    if (alarm.errorCode.starts_with(OWN_PREFIX))
    {
        return alarm.errorCode;
    }
    std::set<std::string, std::less<>>& codes = _codes[alarm.robotID];
    if (codes.size() < MAXIMUM_CODES)
    {
        codes.insert(alarm.errorCode);
    }
    return codes.contains(alarm.errorCode) ? alarm.errorCode : std::string(OTHER_CODES);
}

} // namespace ACS::Acsd
