#include "ProtocolEnumNames.hpp"

namespace ACS::Protocol
{

std::string_view GetText(EAcsCommand command)
{
    return Json::GetWord(command);
}

std::string_view GetText(EAckResult result)
{
    return Json::GetWord(result);
}

std::string_view GetText(EReportResult result)
{
    return Json::GetWord(result);
}

std::string_view GetText(EPlanStatus status)
{
    return Json::GetWord(status);
}

std::string_view GetText(EStepStatus status)
{
    return Json::GetWord(status);
}

std::string_view GetText(EJobStatus status)
{
    return Json::GetWord(status);
}

std::string_view GetText(EErrorLevel level)
{
    return Json::GetWord(level);
}

std::string_view GetText(ERobotType type)
{
    return Json::GetWord(type);
}

std::string_view GetText(ERobotStatus status)
{
    return Json::GetWord(status);
}

std::string_view GetText(ETscState state)
{
    return Json::GetWord(state);
}

std::string_view GetText(EProtocolNote note)
{
    return Json::GetWord(note);
}

bool IsSentByMCS(EAcsCommand command) noexcept
{
    return command < EAcsCommand::Registration;
}

bool HasAck(EAcsCommand command) noexcept
{
    return command != EAcsCommand::RobotPositionUpdate;
}

} // namespace ACS::Protocol
