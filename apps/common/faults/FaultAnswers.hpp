#pragma once

#include "common/faults/FaultCommand.hpp"
#include <acs/core/Logger.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

// Prefixes of the answer to a command.
inline constexpr std::string_view COMMAND_DONE = "ok: ";
inline constexpr std::string_view COMMAND_WRONG = "error: ";

/// The answer to a message of a control channel: one line per command, from the function that executes it. If one of them is
/// invalid, none is executed.
template <typename TFault>
[[nodiscard]] std::string AnswerCommands(
    const FaultGrammar<TFault>& grammar,
    std::string_view text,
    const Core::Logger& logger,
    const std::function<std::string(const FaultCommand<TFault>&)>& apply)
{
    const Core::Result<std::vector<FaultCommand<TFault>>> commands = ParseFaultCommands(grammar, text);
    if (!commands.has_value())
    {
        const std::string mistake = Core::Describe(commands.error());
        logger.Warning("a command is wrong, none of the message is done", {{"reason", mistake}});
        return std::string(COMMAND_WRONG) + mistake;
    }
    std::string answer;
    for (const FaultCommand<TFault>& command : *commands)
    {
        answer += (answer.empty() ? "" : "\n") + apply(command);
    }
    return answer.empty() ? std::string(COMMAND_WRONG) + "there is no command in it" : answer;
}

} // namespace ACS::Apps
