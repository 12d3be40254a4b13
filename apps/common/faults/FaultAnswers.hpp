#pragma once

#include "common/faults/FaultCommand.hpp"
#include <acs/core/Logger.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

// Prefixes of the answer to a command.
inline constexpr std::string_view COMMAND_DONE = "ok: ";
inline constexpr std::string_view COMMAND_WRONG = "error: ";

/// The answer to a message of a control channel: one line per command, returned by the function that executes it. If a command
/// is invalid, none is executed.
/// @param check The error line of a command that fits no target; empty if it fits.
template <typename TFault>
[[nodiscard]] std::string AnswerCommands(
    const FaultGrammar<TFault>& grammar,
    std::string_view text,
    const Core::Logger& logger,
    const std::function<std::string(const FaultCommand<TFault>&)>& check,
    const std::function<std::string(const FaultCommand<TFault>&)>& apply)
{
    const Core::Result<std::vector<FaultCommand<TFault>>> commands = ParseFaultCommands(grammar, text);
    std::string error = commands.has_value() ? std::string() : Core::Describe(commands.error());
    for (std::size_t i = 0; error.empty() && i < commands->size(); ++i)
    {
        error = check((*commands)[i]);
    }
    if (!error.empty())
    {
        logger.Warning("invalid command: no command of the message was executed", {{"reason", error}});
        return std::string(COMMAND_WRONG) + error;
    }
    std::string answer;
    for (const FaultCommand<TFault>& command : *commands)
    {
        answer += (answer.empty() ? "" : "\n") + apply(command);
    }
    return answer.empty() ? std::string(COMMAND_WRONG) + "the message has no command" : answer;
}

} // namespace ACS::Apps
