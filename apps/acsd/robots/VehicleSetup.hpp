#pragma once

#include "config/VehicleConfig.hpp"
#include <acs/acsd/IRobotSetup.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The setup of a VDA5050 vehicle, with an arm or without: makes a VehicleRobot.
class VehicleSetup final : public IRobotSetup
{
    std::shared_ptr<const VehicleConfig> _config;
    std::vector<std::string> _actions;

public:
    /// The actions of its type. The reader of the configuration completes the settings after the setup has been made.
    VehicleSetup(std::shared_ptr<const VehicleConfig> config, std::vector<std::string> actions);

    [[nodiscard]] RobotCapabilities GetCapabilities() const override;
    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices services) const override;
};

} // namespace ACS::Acsd
