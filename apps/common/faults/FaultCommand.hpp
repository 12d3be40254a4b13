#pragma once

#include "common/faults/FaultGrammar.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Apps
{

enum class EFaultVerb : std::uint8_t
{
    Begin,
    End,
    Trigger,
};

/// One line of a fault file, of a control channel or of --fault: "TARGETS FAULT [KEY=VALUE]…", "TARGETS end [FAULT]" or,
/// if the grammar has it, "TARGETS trigger".
template <typename TFault>
struct FaultCommand
{
    std::string targets; ///< A name, or a prefix and `*`.
    EFaultVerb verb = EFaultVerb::Begin;
    TFault fault;                                   ///< For Begin.
    std::optional<typename TFault::Kind> kindToEnd; ///< For End; nullopt: all kinds.

    bool operator==(const FaultCommand&) const = default;
};

/// Returns the command; an error if further words follow.
template <typename TFault>
[[nodiscard]] Core::Result<FaultCommand<TFault>> FinishFaultCommand(FaultCommand<TFault> command, std::string_view rest)
{
    const std::string_view surplus = TakeWord(rest);
    if (!surplus.empty())
    {
        return Core::Fail(Core::ECoreError::UnknownWord, {}, "no more words", Core::QuoteForError(surplus));
    }
    return command;
}

/// Reads what follows "end": the optional FAULT.
template <typename TFault>
[[nodiscard]] Core::Result<FaultCommand<TFault>> ParseEndCommand(
    const FaultGrammar<TFault>& grammar,
    FaultCommand<TFault> command,
    std::string_view rest)
{
    command.verb = EFaultVerb::End;
    const std::string_view name = TakeWord(rest);
    if (!name.empty())
    {
        const Core::Result<typename TFault::Kind> kind = ParseFaultKind(grammar, name);
        if (!kind.has_value())
        {
            return tl::make_unexpected(kind.error());
        }
        command.kindToEnd = *kind;
    }
    return FinishFaultCommand(std::move(command), rest);
}

/// Reads one command of at most 1000 bytes of UTF-8. The path of an error has no line number.
template <typename TFault>
[[nodiscard]] Core::Result<FaultCommand<TFault>> ParseFaultCommand(
    const FaultGrammar<TFault>& grammar,
    std::string_view line)
{
    const Core::Result<void> readable = CheckCommandLine(line);
    if (!readable.has_value())
    {
        return tl::make_unexpected(readable.error());
    }
    FaultCommand<TFault> command;
    command.targets = std::string(TakeWord(line));
    std::string_view rest = line;
    const std::string_view verb = TakeWord(rest);
    if (verb.empty() || command.targets.find('=') != std::string::npos)
    {
        return Core::Fail(
            Core::ECoreError::MissingField,
            {},
            fmt::format(
                "{0} FAULT [KEY=VALUE]...{2} {0} end [FAULT]{1}",
                grammar.target,
                grammar.bTriggers ? fmt::format(" or {} trigger", grammar.target) : "",
                grammar.bTriggers ? "," : " or"),
            Core::QuoteForError(command.targets));
    }
    if (verb == "end")
    {
        return ParseEndCommand(grammar, std::move(command), rest);
    }
    if (verb == "trigger" && grammar.bTriggers)
    {
        command.verb = EFaultVerb::Trigger;
        return FinishFaultCommand(std::move(command), rest);
    }
    Core::Result<TFault> fault = ParseFault(grammar, line);
    if (!fault.has_value())
    {
        return tl::make_unexpected(std::move(fault.error()));
    }
    command.fault = std::move(*fault);
    return command;
}

/// Reads the commands of a file or message (ReadCommandLines).
template <typename TFault>
[[nodiscard]] Core::Result<std::vector<FaultCommand<TFault>>> ParseFaultCommands(
    const FaultGrammar<TFault>& grammar,
    std::string_view text)
{
    std::vector<FaultCommand<TFault>> commands;
    const Core::Result<void> read = ReadCommandLines(text, [&](std::string_view line) -> Core::Result<void> {
        Core::Result<FaultCommand<TFault>> command = ParseFaultCommand(grammar, line);
        if (!command.has_value())
        {
            return tl::make_unexpected(std::move(command.error()));
        }
        commands.push_back(std::move(*command));
        return {};
    });
    if (!read.has_value())
    {
        return tl::make_unexpected(read.error());
    }
    return commands;
}

} // namespace ACS::Apps
