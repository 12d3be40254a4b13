#pragma once

#include "common/config/CommandLine.hpp"
#include "common/config/TextFile.hpp"
#include "common/faults/FaultCommand.hpp"

#include <CLI/CLI.hpp>

#include <iterator>
#include <string>
#include <vector>

namespace ACS::Apps
{

/// Appends the commands; each must begin a fault. Returns an empty text, or the error.
template <typename TFault>
[[nodiscard]] std::string AppendFaults(
    const Core::Result<std::vector<FaultCommand<TFault>>>& commands,
    std::vector<FaultCommand<TFault>>& faults)
{
    if (!commands.has_value())
    {
        return Core::Describe(commands.error());
    }
    for (const FaultCommand<TFault>& command : *commands)
    {
        if (command.verb != EFaultVerb::Begin)
        {
            const bool bEnd = command.verb == EFaultVerb::End;
            return fmt::format(
                "{}: '{}' is not allowed at the start; give a fault",
                command.targets,
                bEnd ? "end" : "trigger");
        }
    }
    faults.insert(faults.end(), commands->begin(), commands->end());
    return {};
}

template <typename TFault>
[[nodiscard]] std::string AppendFaultFile(
    const FaultGrammar<TFault>& grammar,
    const std::string& path,
    std::vector<FaultCommand<TFault>>& faults)
{
    const tl::expected<std::string, std::string> text = ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("{} cannot be read: {}", path, text.error());
    }
    const std::string error = AppendFaults(ParseFaultCommands(grammar, *text), faults);
    return error.empty() ? error : fmt::format("{}: {}", path, error);
}

/// --fault LINE and --fault-file FILE; both may be repeated. The grammar and the target must outlive parsing.
template <typename TFault>
void AddFaultOptions(
    CLI::App& app,
    const FaultGrammar<TFault>& grammar,
    std::vector<FaultCommand<TFault>>& faults,
    const std::string& help)
{
    AddRepeatedOption(
        app,
        "--fault",
        [&grammar, &faults](const std::string& text) {
            const Core::Result<FaultCommand<TFault>> command = ParseFaultCommand(grammar, text);
            if (!command.has_value())
            {
                return Core::Describe(command.error());
            }
            return AppendFaults<TFault>(std::vector{*command}, faults);
        },
        help)
        .type_name(fmt::format("'{} FAULT [KEY=VALUE]...'", grammar.target));
    AddRepeatedOption(
        app,
        "--fault-file",
        [&grammar, &faults](const std::string& path) { return AppendFaultFile(grammar, path, faults); },
        "File with one fault per line. May be repeated")
        .type_name("FILE");
}

} // namespace ACS::Apps
