#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

// The inputs of a job's program are written after its selection and read back before its start. The counters are read last,
// because another program may run while MONITOR shows the inputs.

namespace ACS::Acsd
{

using Planning::AdapterActions;

void ArmProgram::WriteInput()
{
    _state = WritingInputs{};
    _controls.WriteInput(_work.inputs.GetCurrent());
}

void ArmProgram::ReadInputs(AdapterActions& out)
{
    _state = ReadingInputs{};
    _work.inputs.BeginReading();
    _requests.push_back(EArmRequest::ReadInputs);
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::INPUT, _options.inputTimeout});
}

void ArmProgram::OnInputsRead(const std::vector<ArmRelayWords>& ranges, AdapterActions& out)
{
    if (!Is<ReadingInputs>(_state) || !_work.inputs.TryVerify(ranges))
    {
        return;
    }
    out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::INPUT});
    _state = VerifyingCounters{};
    _requests.push_back(EArmRequest::VerifyCounters);
}

void ArmProgram::OnInputsRefused(const std::string& reason, AdapterActions& out)
{
    if (Is<ReadingInputs>(_state))
    {
        Fail(fmt::format("the inputs of the arm's program cannot be read back, it was not started: {}", reason), out);
    }
}

void ArmProgram::OnInputTimer(AdapterActions& out)
{
    if (!Is<ReadingInputs>(_state))
    {
        return;
    }
    if (_work.inputs.TryRetry())
    {
        WriteInput();
        return;
    }
    Fail(
        fmt::format(
            "the arm's controller does not store the inputs of the program, it was not started: {}",
            _work.inputs.DescribeDifference()),
        out);
}

} // namespace ACS::Acsd
