#include <acs/plan_json/PlanEnumNames.hpp>

namespace ACS::Planning
{

std::string_view GetText(EPlanState value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EStepState value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EJobState value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EJobResolution value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(ERobotType value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(ERobotStatus value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EAlarmLevel value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EPlanControl value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EControlOrigin value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(EBlockKind value) noexcept
{
    return Json::GetWord(value);
}

std::string_view GetText(ETscState value) noexcept
{
    return Json::GetWord(value);
}

} // namespace ACS::Planning
