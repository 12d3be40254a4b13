#include "wire/CommandNames.hpp"

#include "scenario/PatternMatch.hpp"

namespace ACS::McsSim
{

using Protocol::EAcsCommand;

namespace
{

constexpr std::string_view ACK = "Ack";

/// Whether '*' in the name stands for something.
bool MatchesAnyFromAcs(std::string_view name)
{
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        const auto command = static_cast<EAcsCommand>(i);
        const std::string sent = std::string(GetText(command)) + (IsSentByAcs(command) ? "" : std::string(ACK));
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

bool IsSentByAcs(EAcsCommand command)
{
    return !Protocol::IsSentByMcs(command);
}

bool IsAckedByMcs(EAcsCommand command)
{
    return IsSentByAcs(command) && HasAck(command);
}

bool CanComeFromAcs(std::string_view name)
{
    if (name.find('*') != std::string_view::npos)
    {
        return MatchesAnyFromAcs(name);
    }
    const bool bAck = name.ends_with(ACK);
    const std::optional<EAcsCommand> command =
        FindCommandOrNull(bAck ? name.substr(0, name.size() - ACK.size()) : name);
    // Unknown commands are refused by the ACS under their own name.
    return bAck ? !command.has_value() || Protocol::IsSentByMcs(*command)
                : command.has_value() && IsSentByAcs(*command);
}

} // namespace ACS::McsSim
