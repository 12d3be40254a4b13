#pragma once

#include "config/VehicleConfig.hpp"
#include "robots/IMqttRobotAdapter.hpp"
#include "robots/OpenStreamRobotAdapter.hpp"
#include "robots/RobotOutputs.hpp"
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/vda5050/MasterOptions.hpp>

#include <memory>

namespace ACS::Acsd
{

/// The adapter of one robot.
struct RobotAdapter
{
    std::unique_ptr<IMqttRobotAdapter> adapter;  ///< Never null.
    OpenStreamRobotAdapter* armOrNull = nullptr; ///< The same adapter if the robot has an arm.
};

/// Makes the adapter of a vehicle, or of a vehicle with an arm. The outputs must outlive it.
[[nodiscard]] RobotAdapter MakeRobotAdapter(const VehicleConfig& vehicle, RobotOutputs& outputs);

/// Options of acsd's session with the vehicle.
[[nodiscard]] VDA5050::MasterOptions MakeMasterOptions(const VehicleConfig& vehicle);

/// Options of acsd's session with the controller of an arm.
[[nodiscard]] OpenStream::ClientSessionOptions MakeArmSessionOptions();

} // namespace ACS::Acsd
