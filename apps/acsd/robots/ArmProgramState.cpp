#include "robots/ArmProgramState.hpp"

namespace ACS::Acsd::ArmStates
{

bool IsAwaiting(const ArmProgramState& state, EArmControl kind)
{
    switch (kind)
    {
        case EArmControl::SelectProgram:
            return Is<Selecting>(state);
        case EArmControl::RewindProgram:
            return Is<Rewinding>(state);
        case EArmControl::WriteInput:
            return Is<WritingInputs>(state);
        case EArmControl::StartProgram:
            return Is<Starting>(state);
        case EArmControl::StopProgram:
            return Is<Stopping>(state);
        case EArmControl::ResumeProgram:
            return Is<Resuming>(state);
        case EArmControl::ResetProgram:
            return Is<Resetting>(state);
        case EArmControl::SwitchMotorOn:
        default:
            return false;
    }
}

bool IsPreparing(const ArmProgramState& state)
{
    return Is<WritingInputs>(state) || Is<ReadingInputs>(state) || Is<VerifyingCounters>(state) || Is<Prepared>(state);
}

bool IsBeforeStart(const ArmProgramState& state)
{
    return Is<VerifyingSelection>(state) || Is<Refused>(state) || IsPreparing(state);
}

} // namespace ACS::Acsd::ArmStates
