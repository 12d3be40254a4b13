#include "config/ErrorNames.hpp"

#include "common/config/ConfigReader.hpp"
#include "operator/AlarmCatalog.hpp"

#include <algorithm>
#include <iterator>

namespace ACS::Acsd
{

ErrorNames ReadErrorNames(const std::string& fileName, std::vector<std::string>& errors)
{
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadFile(fileName, {});
    const Apps::ConfigSection root = reader.GetRoot();
    ErrorNames names;
    for (const std::string& ownCode : root.GetNames())
    {
        const Apps::ConfigSection section = root.GetSection(ownCode);
        if (ownCode.starts_with("ACS-") && DescribeAlarm(ownCode).errorCode != ownCode)
        {
            root.AddError(ownCode, "is no alarm of acsd; docs/reference/alarms.md lists the codes");
        }
        ErrorName name;
        name.code = section.GetStringOrNull("code");
        name.message = section.GetStringOrNull("message");
        if (name.code.has_value() && name.code->empty())
        {
            section.AddError("code", "is empty; leave it out to keep acsd's own code");
        }
        if (section.HasKey("level"))
        {
            const bool bHeavy = section.GetWord("level", {"heavy", "light"}) == "heavy";
            name.level = bHeavy ? Planning::EAlarmLevel::Heavy : Planning::EAlarmLevel::Light;
        }
        names.emplace(ownCode, std::move(name));
    }
    std::ranges::copy(reader.GetErrors(), std::back_inserter(errors));
    return names;
}

std::map<std::string, std::string, std::less<>> MakeMcsCodes(const ErrorNames& names)
{
    std::map<std::string, std::string, std::less<>> codes;
    for (const auto& [ownCode, name] : names)
    {
        codes.emplace(ownCode, name.code.value_or(ownCode));
    }
    return codes;
}

Planning::Alarm Rename(Planning::Alarm alarm, const ErrorNames& names)
{
    const auto found = names.find(alarm.errorCode);
    if (found != names.end())
    {
        const ErrorName& name = found->second;
        alarm.errorCode = name.code.value_or(alarm.errorCode);
        alarm.level = name.level.value_or(alarm.level);
        alarm.message = name.message.value_or(alarm.message);
    }
    // Otherwise a version that did not keep it has set the alarm.
    alarm.errorCode = alarm.mcsCode.value_or(alarm.errorCode);
    return alarm;
}

} // namespace ACS::Acsd
