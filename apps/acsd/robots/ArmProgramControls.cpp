#include "robots/ArmProgramControls.hpp"

#include <fmt/format.h>

#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view SELECT_URL = "/project/context/tasks[0]/cur_prog_cnt";
constexpr std::string_view REWIND_URL = "/project/context/tasks[0]/set_cur_pc_idx";
constexpr std::string_view WRITE_URL = "/project/plc/set_relay_value";
constexpr std::string_view START_URL = "/project/robot/start";
constexpr std::string_view STOP_URL = "/project/robot/stop";
constexpr std::string_view RCODE_URL = "/project/service/r_code/execute";
constexpr std::string_view RESET_URL = "/project/context/tasks[0]/reset";

/// Bad program counter: a selection needs set_cur_pc_idx first.
constexpr std::int64_t BAD_COUNTER = -1'245'280;

} // namespace

ArmProgramControls::ArmProgramControls(ArmControls& controls)
    : _controls(controls)
{
}

void ArmProgramControls::Select(std::uint32_t program)
{
    // ext_sel 1 is required in remote mode, and a start is accepted in remote mode only.
    _controls.Send(
        EArmControl::SelectProgram,
        SELECT_URL,
        fmt::format(R"({{"pno":{},"sno":0,"fno":0,"ext_sel":1}})", program));
}

void ArmProgramControls::Rewind()
{
    _controls.Send(EArmControl::RewindProgram, REWIND_URL, R"({"idx":1})");
}

void ArmProgramControls::WriteInput(const ArmInput& input)
{
    _controls.Send(
        EArmControl::WriteInput,
        WRITE_URL,
        fmt::format(R"({{"name":"{}","value":{}}})", input.relay.name, input.value));
}

void ArmProgramControls::Start()
{
    _controls.Send(EArmControl::StartProgram, START_URL, "{}");
}

void ArmProgramControls::Stop()
{
    _controls.Send(EArmControl::StopProgram, STOP_URL, "{}");
}

void ArmProgramControls::Resume()
{
    _controls.Send(EArmControl::ResumeProgram, START_URL, "{}");
}

void ArmProgramControls::Reset()
{
    SendReset(_acceptedResetOrNull.value_or(EReset::RCode));
}

void ArmProgramControls::SendReset(EReset reset)
{
    _sentReset = reset;
    const bool bRCode = reset == EReset::RCode;
    _controls.Send(EArmControl::ResetProgram, bRCode ? RCODE_URL : RESET_URL, bRCode ? R"({"code":1})" : "{}");
}

bool ArmProgramControls::TryOtherReset()
{
    if (_acceptedResetOrNull.has_value() || _sentReset == EReset::TaskReset)
    {
        return false;
    }
    SendReset(EReset::TaskReset);
    return true;
}

void ArmProgramControls::OnResetVerified() noexcept
{
    _acceptedResetOrNull = _sentReset;
}

void ArmProgramControls::OnSettled(EArmControl kind, OpenStream::EControlOutcome outcome)
{
    const bool bAccepted = outcome == OpenStream::EControlOutcome::Accepted;
    switch (kind)
    {
        case EArmControl::StartProgram:
        case EArmControl::StopProgram:
        case EArmControl::ResumeProgram:
            _bRewindDue = _bRewindDue || outcome != OpenStream::EControlOutcome::NotSent;
            break;
        case EArmControl::RewindProgram:
            _bRewindDue = _bRewindDue && !bAccepted;
            break;
        case EArmControl::ResetProgram:
        case EArmControl::SwitchMotorOn:
        case EArmControl::SelectProgram:
        case EArmControl::WriteInput:
        default:
            break;
    }
}

void ArmProgramControls::OnLost() noexcept
{
    _acceptedResetOrNull.reset();
}

bool ArmProgramControls::IsRewindDue() const noexcept
{
    return _bRewindDue;
}

bool ArmProgramControls::IsRewindWanted(const ArmRefusal& refusal) noexcept
{
    return refusal.codeOrNull == BAD_COUNTER;
}

} // namespace ACS::Acsd
