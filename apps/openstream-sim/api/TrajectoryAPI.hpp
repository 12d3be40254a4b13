#pragma once

#include "api/ApiCall.hpp"
#include "api/ApiMessages.hpp"
#include "controller/ControllerMachine.hpp"

/// The endpoints below /project/robot/trajectory.
namespace ACS::OpenStreamSim::TrajectoryAPI
{

[[nodiscard]] OpenStream::ApiResponse Init(ControllerMachine& machine, const TrajectoryAgility& agility);
[[nodiscard]] OpenStream::ApiResponse InsertPoint(ControllerMachine& machine, const StreamedPoint& point);
[[nodiscard]] OpenStream::ApiResponse InsertPoints(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetFree(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetAgility(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetMode(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetReady(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse Finish(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse GetLog(ControllerMachine& machine, const ApiCall& call);
[[nodiscard]] OpenStream::ApiResponse SetLog(ControllerMachine& machine, const LogCommand& command);

} // namespace ACS::OpenStreamSim::TrajectoryAPI
