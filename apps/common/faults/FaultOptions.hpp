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

/// Appends commands that begin a fault. Returns what is wrong, if anything.
template <typename TFault>
[[nodiscard]] std::string TakeFaults(
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
                "{}: at the start there is {}",
                command.targets,
                bEnd ? "no fault to end" : "no action to trigger");
        }
    }
    faults.insert(faults.end(), commands->begin(), commands->end());
    return {};
}

template <typename TFault>
[[nodiscard]] std::string TakeFaultFile(
    const FaultGrammar<TFault>& grammar,
    const std::string& path,
    std::vector<FaultCommand<TFault>>& faults)
{
    const tl::expected<std::string, std::string> text = ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("{} cannot be read: {}", path, text.error());
    }
    const std::string mistake = TakeFaults(ParseFaultCommands(grammar, *text), faults);
    return mistake.empty() ? mistake : fmt::format("{}: {}", path, mistake);
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
            return TakeFaults<TFault>(std::vector{*command}, faults);
        },
        help)
        .type_name(fmt::format("'{} FAULT [KEY=VALUE]...'", grammar.target));
    AddRepeatedOption(
        app,
        "--fault-file",
        [&grammar, &faults](const std::string& path) { return TakeFaultFile(grammar, path, faults); },
        "a file with a fault on each line. May be repeated")
        .type_name("FILE");
}

} // namespace ACS::Apps
