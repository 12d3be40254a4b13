#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

#include <string_view>

// The inputs of a job's program: written after its selection, read back before its start. The counters are read last: while
// MONITOR shows the inputs, another program may run.

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;

constexpr std::string_view WRITE_URL = "/project/plc/set_relay_value";

} // namespace

void ArmProgram::Prepare()
{
    if (_work.job.inputs.empty())
    {
        _state = Prepared{true};
    }
    else
    {
        WriteInput({});
    }
}

void ArmProgram::WriteInput(WritingInputs writing)
{
    _state = writing;
    const ArmInput& input = _work.job.inputs[writing.next];
    _controls.Send(
        EArmControl::WriteInput,
        WRITE_URL,
        fmt::format(R"({{"name":"{}","value":{}}})", input.relay.name, input.value));
}

void ArmProgram::ReadInputs(std::size_t attempt, AdapterActions& out)
{
    _state = ReadingInputs{attempt, {}};
    _requests.push_back(EArmRequest::ReadInputs);
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::INPUT, _options.inputTimeout});
}

void ArmProgram::OnInputsRead(const std::vector<ArmRelayWords>& ranges, AdapterActions& out)
{
    ReadingInputs* const readingOrNull = std::get_if<ReadingInputs>(&_state);
    if (readingOrNull == nullptr)
    {
        return;
    }
    readingOrNull->difference.clear();
    for (const ArmInput& input : _work.job.inputs)
    {
        std::optional<std::int32_t> value;
        for (const ArmRelayWords& shown : ranges)
        {
            value = value.has_value() ? value : ReadRelayOrNull(input.relay, shown.range, shown.words);
        }
        if (!value.has_value() || !IsSameValue(input.relay, input.value, *value))
        {
            readingOrNull->difference = fmt::format(
                "relay {} was written as {} and reads {}",
                input.relay.name,
                input.value,
                value.has_value() ? fmt::format("{}", *value) : "nothing");
            return;
        }
    }
    out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::INPUT});
    _state = VerifyingCounters{};
    _requests.push_back(EArmRequest::VerifyCounters);
}

void ArmProgram::OnInputsRefused(const std::string& reason, AdapterActions& out)
{
    if (Is<ReadingInputs>())
    {
        Fail(fmt::format("the inputs of the arm's program cannot be read back, it was not started: {}", reason), out);
    }
}

void ArmProgram::OnInputTimer(AdapterActions& out)
{
    const ReadingInputs* const readingOrNull = std::get_if<ReadingInputs>(&_state);
    if (readingOrNull == nullptr)
    {
        return;
    }
    if (readingOrNull->attempt < _options.inputRetries)
    {
        WriteInput({readingOrNull->attempt + 1, 0});
        return;
    }
    Fail(
        fmt::format(
            "the arm's controller does not store the inputs of the program, it was not started: {}",
            readingOrNull->difference.empty() ? std::string("the relays are not shown") : readingOrNull->difference),
        out);
}

void ArmProgram::OnInputWritten(AdapterActions& out)
{
    const WritingInputs writing = std::get<WritingInputs>(_state);
    if (writing.next + 1 < _work.job.inputs.size())
    {
        WriteInput({writing.attempt, writing.next + 1});
    }
    else
    {
        ReadInputs(writing.attempt, out);
    }
}

} // namespace ACS::Acsd
