#include "robots/ArmProgramState.hpp"

#include "Catch.hpp"

namespace ACS::Acsd::Test
{

TEST_CASE("A program awaits the CONTROL of its state and no other")
{
    CHECK(ArmStates::IsAwaiting(ArmStates::Selecting{}, EArmControl::SelectProgram));
    CHECK_FALSE(ArmStates::IsAwaiting(ArmStates::Rewinding{}, EArmControl::SelectProgram));
    CHECK(ArmStates::IsAwaiting(ArmStates::Stopping{}, EArmControl::StopProgram));
    CHECK_FALSE(ArmStates::IsAwaiting(ArmStates::NoJob{}, EArmControl::StopProgram));
    CHECK_FALSE(ArmStates::IsAwaiting(ArmStates::Resuming{}, EArmControl::StartProgram));
    CHECK_FALSE(ArmStates::IsAwaiting(ArmStates::NoJob{}, EArmControl::SwitchMotorOn));
}

TEST_CASE("A program is prepared between its verified selection and its start")
{
    CHECK_FALSE(ArmStates::IsPreparing(ArmStates::VerifyingSelection{}));
    CHECK(ArmStates::IsPreparing(ArmStates::WritingInputs{}));
    CHECK(ArmStates::IsPreparing(ArmStates::Prepared{}));
    CHECK_FALSE(ArmStates::IsPreparing(ArmStates::Starting{}));
    CHECK(ArmStates::IsBeforeStart(ArmStates::VerifyingSelection{}));
    CHECK(ArmStates::IsBeforeStart(ArmStates::Refused{}));
    CHECK_FALSE(ArmStates::IsBeforeStart(ArmStates::Selecting{}));
    CHECK_FALSE(ArmStates::IsBeforeStart(ArmStates::Starting{}));
}

} // namespace ACS::Acsd::Test
