#include "vda-sim/FaultCommand.hpp"

#include "vda-sim/WordReader.hpp"
#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr std::size_t MAX_LINE_LENGTH = 1000; ///< A fault's words come back in the log and in states.
constexpr std::size_t MAX_COMMANDS = 1000;
constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";
constexpr char EVERY = '*';
constexpr char REMARK = '#';
constexpr std::string_view VERB_END = "end";
constexpr std::string_view VERB_TRIGGER = "trigger";

Core::Result<FaultCommand> Finish(FaultCommand command, std::string_view rest)
{
    const std::string_view surplus = TakeWord(rest);
    if (!surplus.empty())
    {
        return Core::Fail(Core::ECoreError::UnknownWord, {}, "no more words", Core::QuoteForError(surplus));
    }
    return command;
}

} // namespace

Core::Result<FaultCommand> ParseFaultCommand(std::string_view line)
{
    if (line.size() > MAX_LINE_LENGTH)
    {
        return Core::Fail(
            Core::ECoreError::TooLarge,
            {},
            fmt::format("at most {} bytes", MAX_LINE_LENGTH),
            fmt::format("{} bytes", line.size()));
    }
    if (!Core::JsonText::IsUtf8(line))
    {
        return Core::Fail(Core::ECoreError::InvalidIdentifier, {}, "text in UTF-8", Core::QuoteForError(line));
    }
    FaultCommand command;
    command.vehicles = std::string(TakeWord(line));
    std::string_view rest = line;
    const std::string_view verb = TakeWord(rest);
    if (verb.empty() || command.vehicles.find('=') != std::string::npos)
    {
        return Core::Fail(
            Core::ECoreError::MissingField,
            {},
            "VEHICLE FAULT [KEY=VALUE]..., VEHICLE end [FAULT] or VEHICLE trigger",
            Core::QuoteForError(command.vehicles));
    }
    if (verb == VERB_END)
    {
        command.verb = EFaultVerb::End;
        const std::string_view name = TakeWord(rest);
        if (!name.empty())
        {
            const Core::Result<EFaultKind> kind = ParseFaultKind(name);
            if (!kind.has_value())
            {
                return tl::make_unexpected(kind.error());
            }
            command.kindToEnd = *kind;
        }
        return Finish(std::move(command), rest);
    }
    if (verb == VERB_TRIGGER)
    {
        command.verb = EFaultVerb::Trigger;
        return Finish(std::move(command), rest);
    }
    Core::Result<Fault> fault = ParseFault(line);
    if (!fault.has_value())
    {
        return tl::make_unexpected(std::move(fault.error()));
    }
    command.fault = std::move(*fault);
    return command;
}

Core::Result<std::vector<FaultCommand>> ParseFaultCommands(std::string_view text)
{
    std::vector<FaultCommand> commands;
    if (text.starts_with(BYTE_ORDER_MARK))
    {
        text.remove_prefix(BYTE_ORDER_MARK.size());
    }
    for (std::size_t number = 1; !text.empty(); ++number)
    {
        const std::size_t end = text.find('\n');
        const std::string_view whole = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        std::string_view line = whole.substr(0, whole.find(REMARK));
        std::string_view probe = line;
        if (TakeWord(probe).empty())
        {
            continue;
        }
        if (commands.size() >= MAX_COMMANDS)
        {
            return Core::Fail(
                Core::ECoreError::TooLarge,
                fmt::format("line {}", number),
                fmt::format("at most {} commands", MAX_COMMANDS));
        }
        Core::Result<FaultCommand> command = ParseFaultCommand(line);
        if (!command.has_value())
        {
            Core::Error error = std::move(command.error());
            error.path =
                error.path.empty() ? fmt::format("line {}", number) : fmt::format("line {}, {}", number, error.path);
            return tl::make_unexpected(std::move(error));
        }
        commands.push_back(std::move(*command));
    }
    return commands;
}

bool IsFor(const FaultCommand& command, std::string_view name)
{
    const std::string_view pattern = command.vehicles;
    return pattern.ends_with(EVERY) ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
}

} // namespace ACS::VdaSim
