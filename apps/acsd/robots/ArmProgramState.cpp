#include "robots/ArmProgramState.hpp"

namespace ACS::Acsd::ArmStates
{

bool IsAwaiting(const ArmProgramState& state, EArmControl kind)
{
    switch (kind)
    {
        case EArmControl::SelectProgram:
            return std::holds_alternative<Selecting>(state);
        case EArmControl::RewindProgram:
            return std::holds_alternative<Rewinding>(state);
        case EArmControl::WriteInput:
            return std::holds_alternative<WritingInputs>(state);
        case EArmControl::StartProgram:
            return std::holds_alternative<Starting>(state);
        case EArmControl::StopProgram:
            return std::holds_alternative<Stopping>(state);
        case EArmControl::ResumeProgram:
            return std::holds_alternative<Resuming>(state);
        case EArmControl::ResetProgram:
            return std::holds_alternative<Resetting>(state);
        case EArmControl::SwitchMotorOn:
        default:
            return false;
    }
}

bool IsPreparing(const ArmProgramState& state)
{
    return std::holds_alternative<WritingInputs>(state) || std::holds_alternative<ReadingInputs>(state)
        || std::holds_alternative<VerifyingCounters>(state) || std::holds_alternative<Prepared>(state);
}

bool IsBeforeStart(const ArmProgramState& state)
{
    return std::holds_alternative<VerifyingSelection>(state) || std::holds_alternative<Refused>(state)
        || IsPreparing(state);
}

} // namespace ACS::Acsd::ArmStates
