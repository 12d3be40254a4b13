#include "wire/CommandNames.hpp"

#include "scenario/PatternMatch.hpp"

namespace ACS::McsSim
{

using Protocol::EAcsCommand;

namespace
{

constexpr std::string_view ACK = "Ack";

/// Whether '*' in the name stands for something.
bool MatchesAnyFromACS(std::string_view name)
{
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        const std::string sent = std::string(GetText(command)) + (IsSentByACS(command) ? "" : std::string(ACK));
        if (MatchesGlob(sent, name))
        {
            return true;
        }
    }
    return false;
}

} // namespace

std::optional<EAcsCommand> FindCommandOrNull(std::string_view name)
{
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        if (GetText(static_cast<EAcsCommand>(i)) == name)
        {
            return static_cast<EAcsCommand>(i);
        }
    }
    return std::nullopt;
}

std::string ListCommands(bool (*isListed)(EAcsCommand))
{
    std::string list;
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        if (isListed(command))
        {
            list += list.empty() ? "" : ", ";
            list += GetText(command);
        }
    }
    return list;
}

bool IsSentByACS(EAcsCommand command)
{
    return !Protocol::IsSentByMCS(command);
}

bool IsAckedByMCS(EAcsCommand command)
{
    return IsSentByACS(command) && HasAck(command);
}

bool CanComeFromACS(std::string_view name)
{
    if (name.find('*') != std::string_view::npos)
    {
        return MatchesAnyFromACS(name);
    }
    const bool bAck = name.ends_with(ACK);
    const std::optional<EAcsCommand> command =
        FindCommandOrNull(bAck ? name.substr(0, name.size() - ACK.size()) : name);
    // Unknown commands are refused by the ACS under their own name.
    return bAck ? !command.has_value() || Protocol::IsSentByMCS(*command)
                : command.has_value() && IsSentByACS(*command);
}

} // namespace ACS::McsSim
