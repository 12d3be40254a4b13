#pragma once

#include "robots/ArmProgramState.hpp"

// Short names for the states of ArmProgram, for its sources only.

namespace ACS::Acsd
{

using ArmStates::ArmProgramState;
using ArmStates::Awaited;
using ArmStates::EArmHalt;
using ArmStates::EArmStart;
using ArmStates::Is;
using ArmStates::NoJob;
using ArmStates::Prepared;
using ArmStates::ReadingInputs;
using ArmStates::Refused;
using ArmStates::Resetting;
using ArmStates::ResumeRefused;
using ArmStates::Resuming;
using ArmStates::Rewinding;
using ArmStates::Running;
using ArmStates::Selecting;
using ArmStates::Starting;
using ArmStates::Stopped;
using ArmStates::Stopping;
using ArmStates::Unverified;
using ArmStates::VerifyingCounters;
using ArmStates::VerifyingSelection;
using ArmStates::WritingInputs;

} // namespace ACS::Acsd
