#include "api/ControlAPI.hpp"

#include "api/ApiAnswers.hpp"
#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::OpenStreamSim::ControlAPI
{

namespace
{

using OpenStream::ApiResponse;

constexpr std::int64_t LAST_BLOCK = 9;
constexpr std::size_t TASKS = 8;
constexpr auto LONG_BYTES = static_cast<std::int64_t>(sizeof(std::int32_t));

/// The relay of that type and number in a block, if the path serves its area.
Core::Result<RelayName> MakeName(std::string_view type, RelayBlock block, std::size_t number)
{
    const std::optional<RelayType> parsed = ParseRelayTypeOrNull(type);
    if (!parsed.has_value() || parsed->area != block.area)
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "type",
            "the area of the path, optionally followed by b, w, l or f (dib, dof)",
            Core::QuoteForError(type));
    }
    const RelayName name{block, parsed->width, number};
    if (!IsInside(name))
    {
        return Core::Fail(Core::ECoreError::OutOfRange, "sig_no", "a signal of the block", std::to_string(number));
    }
    return name;
}

ApiResponse ReadSignal(ControllerMachine& machine, const ApiCall& call, RelayBlock block, std::string_view byDefault)
{
    const Core::Result<std::int64_t> blockNo = ReadInteger(call.request, "blk_no", 0, 0, LAST_BLOCK);
    const Core::Result<std::int64_t> number =
        ReadInteger(call.request, "sig_no", 0, 0, std::numeric_limits<std::int32_t>::max());
    if (!blockNo.has_value() || !number.has_value())
    {
        return Refuse(blockNo.has_value() ? number.error() : blockNo.error());
    }
    if (block.bus == ERelayBus::Fb)
    {
        block.index = static_cast<std::uint8_t>(*blockNo);
    }
    const std::string* typeOrNull = call.request.GetParameterOrNull("type");
    const Core::Result<RelayName> name =
        MakeName(typeOrNull == nullptr ? byDefault : *typeOrNull, block, static_cast<std::size_t>(*number));
    if (!name.has_value())
    {
        return Refuse(name.error());
    }
    const double value = machine.GetRelays().Read(*name);
    if (name->width == ERelayWidth::Float)
    {
        return Succeed(FloatAnswer{value});
    }
    return Succeed(NumberAnswer{static_cast<std::int64_t>(value)});
}

/// A number, or a string that holds one.
std::optional<double> ReadNumberOrNull(const Core::JsonText& value)
{
    const std::optional<std::string> text = value.GetStringOrNull();
    return text.has_value() ? Core::ParseNumberOrNull<double>(*text) : value.GetNumberOrNull();
}

bool IsTask(std::string_view argument)
{
    return Core::ParseNumberOrNull<std::size_t>(argument).value_or(TASKS) < TASKS;
}

ApiResponse RefuseTask()
{
    return RefusePath("no such task; there are tasks 0 to 7");
}

} // namespace

ApiResponse GetConditions(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Succeed(machine.GetSettings().conditions, "CondGrp");
}

ApiResponse SetConditions(ControllerMachine& machine, const ApiCall& call)
{
    ControllerSettings& settings = machine.GetSettings();
    const Core::Result<OperatingConditions> conditions = ReadBody(call.request, settings.conditions);
    if (!conditions.has_value())
    {
        return Refuse(conditions.error());
    }
    settings.conditions = *conditions;
    return ApiResponse{200, Core::JsonText::FromTrusted(R"({"_text":""})")};
}

ApiResponse GetInput(ControllerMachine& machine, const ApiCall& call)
{
    return ReadSignal(machine, call, RelayBlock{ERelayBus::Fb, 0, ERelayArea::Di}, "di");
}

ApiResponse GetOutput(ControllerMachine& machine, const ApiCall& call)
{
    return ReadSignal(machine, call, RelayBlock{ERelayBus::Fb, 0, ERelayArea::Do}, "do");
}

ApiResponse SetOutput(ControllerMachine& machine, const OutputCommand& command)
{
    const RelayBlock block{ERelayBus::Fb, static_cast<std::uint8_t>(command.blkNo), ERelayArea::Do};
    const Core::Result<RelayName> name = MakeName(command.type, block, command.sigNo);
    if (!name.has_value())
    {
        return Refuse(name.error());
    }
    // A manual's own sample sets a bit with the value of a byte.
    const bool bOn = name->width == ERelayWidth::Bit && command.val != 0.0;
    const Core::Result<void> written = machine.GetRelays().Write(*name, bOn ? 1.0 : command.val);
    return written.has_value() ? Succeed() : Refuse(written.error());
}

ApiResponse GetSystemInput(ControllerMachine& machine, const ApiCall& call)
{
    return ReadSignal(machine, call, RelayBlock{ERelayBus::None, 0, ERelayArea::Si}, "si");
}

ApiResponse GetSystemOutput(ControllerMachine& machine, const ApiCall& call)
{
    return ReadSignal(machine, call, RelayBlock{ERelayBus::None, 0, ERelayArea::So}, "so");
}

ApiResponse GetRelayWords(ControllerMachine& machine, const ApiCall& call)
{
    constexpr std::int64_t DEFAULT_WORDS = 8;
    constexpr auto BLOCK_BYTES = static_cast<std::int64_t>(RELAY_BYTES);
    const std::optional<RelayBlock> block = ParseRelayBlockOrNull(call.argument);
    if (!block.has_value())
    {
        return RefusePath(
            "no such block; there are di, do, x, y, m, s, r and k, alone or after fb0_ to fb9_ or fn0_ to fn63_");
    }
    const Core::Result<std::int64_t> first = ReadInteger(call.request, "st", 0, 0, BLOCK_BYTES - LONG_BYTES);
    if (!first.has_value())
    {
        return Refuse(first.error());
    }
    const std::int64_t rest = (BLOCK_BYTES - *first) / LONG_BYTES;
    const Core::Result<std::int64_t> count = ReadInteger(call.request, "len", std::min(DEFAULT_WORDS, rest), 1, rest);
    if (!count.has_value())
    {
        return Refuse(count.error());
    }
    std::string text = std::move(call.room);
    Json::JsonWriter writer(text);
    writer.BeginArray();
    for (std::int64_t word = 0; word < *count; ++word)
    {
        writer.WriteInteger(machine.GetRelays().ReadS32(*block, static_cast<std::size_t>(*first + word * LONG_BYTES)));
    }
    writer.EndArray();
    return ApiResponse{200, Core::JsonText::FromTrusted(std::move(text))};
}

ApiResponse SetRelay(ControllerMachine& machine, const RelayCommand& command)
{
    const std::optional<RelayName> name = ParseRelayNameOrNull(command.name);
    if (!name.has_value())
    {
        return RefuseInput("name", "a relay (m100, ml100, fb0.di23)", Core::QuoteForError(command.name));
    }
    const std::optional<double> value = ReadNumberOrNull(command.value);
    if (!value.has_value())
    {
        return RefuseInput("value", "a number", Core::QuoteForError(command.value.GetText()));
    }
    const Core::Result<void> written = machine.WriteRelay(*name, *value);
    return written.has_value() ? Succeed() : Refuse(written.error());
}

ApiResponse StartProgram(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Answer(machine.StartProgram());
}

ApiResponse StopProgram(ControllerMachine& machine, const ApiCall& /*call*/)
{
    machine.StopProgram();
    return Succeed();
}

ApiResponse ResetTasks(ControllerMachine& machine, const ApiCall& /*call*/)
{
    machine.ResetTasks();
    return Succeed();
}

ApiResponse ResetTask(ControllerMachine& machine, const ApiCall& call)
{
    if (!IsTask(call.argument))
    {
        return RefuseTask();
    }
    if (call.argument == "0")
    {
        machine.ResetTasks();
    }
    return Succeed();
}

ApiResponse ExecuteServiceCode(ControllerMachine& machine, const ServiceCode& code)
{
    constexpr int CLEAR_COUNTER = 0;
    machine.ResetTasks();
    if (code.code == CLEAR_COUNTER)
    {
        machine.ClearSelection();
    }
    return Succeed(code);
}

ApiResponse SetProgramCounter(ControllerMachine& machine, const ProgramCounterCommand& command)
{
    const EApiError refusal = machine.CheckSelection(command.extSel == 1);
    if (refusal != EApiError::None)
    {
        return Answer(refusal);
    }
    if (command.pno == 0)
    {
        return RefuseInput("pno", "-1 or a program from 1 to 9999", "0");
    }
    if (command.pno < 0 && command.sno < 0 && command.fno < 0)
    {
        return Succeed(ProgramCounterAnswer{});
    }
    const int number = command.pno < 0 ? machine.GetProgram() : command.pno;
    if (number == 0)
    {
        return Answer(EApiError::BadCounter);
    }
    const EApiError error = machine.SelectProgram(number);
    if (error != EApiError::None)
    {
        return Answer(error);
    }
    // A simulated program has no lines: it always starts at its beginning.
    return Succeed(ProgramCounterAnswer{});
}

ApiResponse SetPcIndex(ControllerMachine& machine, const ApiCall& call)
{
    if (!IsTask(call.argument))
    {
        return RefuseTask();
    }
    const Core::Result<PcIndexCommand> command = ReadBody<PcIndexCommand>(call.request);
    if (!command.has_value())
    {
        return Refuse(command.error());
    }
    // Only task 0 has a program.
    return Answer(call.argument == "0" ? machine.SetCursor(command->idx) : EApiError::None);
}

ApiResponse ReleaseWait(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Answer(machine.ReleaseWait());
}

ApiResponse ExecuteMove(ControllerMachine& machine, const ApiCall& call)
{
    if (!IsTask(call.argument))
    {
        return RefuseTask();
    }
    const Core::Result<MoveCommand> command = ReadBody<MoveCommand>(call.request);
    return command.has_value() ? Answer(machine.ExecuteMove(command->stmt)) : Refuse(command.error());
}

ApiResponse ExecuteCommand(ControllerMachine& machine, const ConsoleCommand& command)
{
    constexpr std::string_view ADD = "rl.i ";
    const std::string_view line = command.cmdLine;
    if (line == "rl.start")
    {
        return Answer(machine.StartConsole());
    }
    if (line == "rl.stop")
    {
        machine.StopProgram();
        return Succeed();
    }
    if (line == "rl.reinit")
    {
        machine.ClearConsole();
        return Succeed();
    }
    if (line == "rl.exit")
    {
        machine.ExitConsole();
        return Succeed();
    }
    const bool bAdded = line.starts_with(ADD) && machine.AddStatement(line.substr(ADD.size())) == EApiError::None;
    return bAdded ? Succeed() : Succeed(ConsoleAnswer{});
}

} // namespace ACS::OpenStreamSim::ControlAPI
