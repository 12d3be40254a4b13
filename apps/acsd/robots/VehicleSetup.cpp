#include "robots/VehicleSetup.hpp"

#include "robots/RobotAdapterFactory.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/VehicleRobot.hpp"
#include <acs/vda5050/Topic.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace ACS::Acsd
{

VehicleSetup::VehicleSetup(std::shared_ptr<const VehicleConfig> config, std::vector<std::string> actions)
    : _config(std::move(config)),
      _actions(std::move(actions))
{
}

RobotCapabilities VehicleSetup::GetCapabilities() const
{
    RobotCapabilities capabilities;
    // A CR without an arm is refused by its key `arm`.
    capabilities.types = {Planning::ERobotType::LR, Planning::ERobotType::CR};
    if (!VDA5050::IsValidAddress(_config->address)) // which is reported
    {
        capabilities.topicPrefix = _config->robotID; // it needs the broker
        return capabilities;
    }
    capabilities.topicPrefix = VDA5050::BuildTopicPrefix(_config->address);
    capabilities.connectionHint = fmt::format(
        "The connection message of its vehicle is expected on {}.",
        VDA5050::BuildTopic(_config->address, VDA5050::ETopic::Connection));
    RobotOutputs outputs; // stays empty
    const RobotAdapter made = MakeRobotAdapter(*_config, outputs);
    for (const std::string& action : _actions)
    {
        if (std::optional<std::string> reason = made.adapter->GetRejectionReasonOrNull(action))
        {
            capabilities.rejectedActions.emplace(action, std::move(*reason));
        }
    }
    return capabilities;
}

std::unique_ptr<IRobot> VehicleSetup::MakeRobot(RobotServices services) const
{
    return std::make_unique<VehicleRobot>(std::move(services), _config);
}

} // namespace ACS::Acsd
