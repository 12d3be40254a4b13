#include "robots/RobotAdapterFactory.hpp"

#include "robots/ArmInputs.hpp"
#include "robots/Vda5050RobotAdapter.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;

/// The controller refuses within a few milliseconds. A longer window only delays each job.
constexpr std::chrono::milliseconds CONTROL_WINDOW = 100ms;

} // namespace

VDA5050::MasterOptions MakeMasterOptions(const VehicleConfig& vehicle)
{
    VDA5050::MasterOptions options;
    options.address = vehicle.address;
    // Longer where the factsheet announces a longer interval between states.
    options.stateMargin = std::min(options.stateMargin, vehicle.offlineAfter / 3);
    options.stateInterval = vehicle.offlineAfter - options.stateMargin;
    options.factsheet = vehicle.factsheet;
    options.version =
        VDA5050::ReadVersionOrNull(vehicle.protocolVersion).value_or(VDA5050::EVda5050Version::Version200);
    options.zoneSetID = vehicle.zoneSetID;
    return options;
}

RobotAdapter MakeRobotAdapter(const VehicleConfig& vehicle, RobotOutputs& outputs)
{
    VDA5050::MasterOptions options = MakeMasterOptions(vehicle);
    if (!vehicle.armOrNull.has_value())
    {
        auto adapter = std::make_unique<Vda5050RobotAdapter>(
            std::move(options),
            vehicle.methods,
            outputs,
            vehicle.loadTimeout,
            vehicle.drives,
            vehicle.maps);
        return {std::move(adapter), nullptr};
    }
    auto adapter = std::make_unique<OpenStreamRobotAdapter>(
        std::move(options),
        vehicle.armOptions,
        vehicle.methods,
        [methods = vehicle.methods](const Planning::StartJob& job) { return MakeArmInputs(methods, job); },
        outputs,
        vehicle.drives,
        vehicle.maps);
    OpenStreamRobotAdapter* const arm = adapter.get();
    return {std::move(adapter), arm};
}

OpenStream::ClientSessionOptions MakeArmSessionOptions()
{
    OpenStream::ClientSessionOptions options;
    options.controlWindow = CONTROL_WINDOW;
    return options;
}

} // namespace ACS::Acsd
