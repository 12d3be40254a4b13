#pragma once

#include "api/ApiCall.hpp"
#include "api/ApiMessages.hpp"
#include "controller/ControllerMachine.hpp"

/// The endpoints of the operating conditions, the signals, the relays, the tasks and the console.
namespace ACS::OpenStreamSim::ControlAPI
{

[[nodiscard]] OpenStream::ApiResponse GetConditions(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SetConditions(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetInput(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetOutput(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SetOutput(ControllerMachine& machine, const OutputCommand& command);
[[nodiscard]] OpenStream::ApiResponse GetSystemInput(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetSystemOutput(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetRelayWords(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SetRelay(ControllerMachine& machine, const RelayCommand& command);
[[nodiscard]] OpenStream::ApiResponse StartProgram(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse StopProgram(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ResetTasks(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ResetTask(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ExecuteServiceCode(ControllerMachine& machine, const ServiceCode& code);
[[nodiscard]] OpenStream::ApiResponse SetProgramCounter(
    ControllerMachine& machine,
    const ProgramCounterCommand& command);
[[nodiscard]] OpenStream::ApiResponse SetPcIndex(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ReleaseWait(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ExecuteMove(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse ExecuteCommand(ControllerMachine& machine, const ConsoleCommand& command);

} // namespace ACS::OpenStreamSim::ControlAPI
