#pragma once

#include "api/ApiCall.hpp"
#include "api/ApiMessages.hpp"
#include "controller/ControllerMachine.hpp"

/// The endpoints below /project/robot and those about the controller as a whole.
namespace ACS::OpenStreamSim::RobotAPI
{

[[nodiscard]] OpenStream::ApiResponse GetHealth(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetApiVersion(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetSystemVersions(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetRobot(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetJointStates(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetPose(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetGeneral(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetMotorState(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SwitchMotorOn(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SwitchMotorOff(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetEmergencyStop(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse PressEmergencyStop(
    ControllerMachine& machine,
    const EmergencyStopCommand& command);
[[nodiscard]] OpenStream::ApiResponse GetCurrentTool(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetTools(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetTool(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SelectTool(ControllerMachine& machine, const ToolCommand& command);
[[nodiscard]] OpenStream::ApiResponse SelectCoordinates(ControllerMachine& machine, const CoordinatesCommand& command);

} // namespace ACS::OpenStreamSim::RobotAPI
