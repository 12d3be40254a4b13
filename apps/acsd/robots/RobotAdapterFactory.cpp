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

VDA5050::MasterOptions MakeMasterOptions(const AcsdConfig& config, const RobotLinkConfig& robot)
{
    VDA5050::MasterOptions options;
    options.address = {GetInterfaceName(config), robot.manufacturer, robot.serialNumber};
    // Longer where the factsheet announces a longer interval between states.
    options.stateMargin = std::min(options.stateMargin, config.operations.offlineAfter / 3);
    options.stateInterval = config.operations.offlineAfter - options.stateMargin;
    options.factsheet = robot.factsheet;
    options.version = VDA5050::ReadVersionOrNull(robot.protocolVersion).value_or(VDA5050::EVda5050Version::Version200);
    options.zoneSetID = config.zoneSetID;
    return options;
}

} // namespace

RobotAdapter MakeRobotAdapter(const AcsdConfig& config, const RobotLinkConfig& robot, RobotOutputs& outputs)
{
    VDA5050::MasterOptions options = MakeMasterOptions(config, robot);
    if (!robot.armOrNull.has_value())
    {
        auto vehicle = std::make_unique<Vda5050RobotAdapter>(
            std::move(options),
            robot.methods,
            outputs,
            config.operations.loadTimeout,
            robot.drives,
            robot.maps);
        return {std::move(vehicle), nullptr};
    }
    auto adapter = std::make_unique<OpenStreamRobotAdapter>(
        std::move(options),
        robot.armOptions,
        robot.methods,
        [methods = robot.methods](const Planning::StartJob& job) { return MakeArmInputs(methods, job); },
        outputs,
        robot.drives,
        robot.maps);
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
