#pragma once

#include <acs/acsd/IRobot.hpp>
#include <acs/acsd/RobotServices.hpp>
#include <acs/core/Api.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/ERobotType.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What a robot can do, known from the configuration alone.
struct RobotCapabilities
{
    std::vector<Planning::ERobotType> types; ///< Types that the robot may be configured as.
    /// The configured actions of its type that it cannot execute, each with the reason in a sentence for the MCS. An action that no
    /// robot can execute is an error of the configuration.
    Planning::RejectedActions rejectedActions;
    /// A sentence about where acsd expects the robot, for the alarm of a robot that has not connected; may be empty.
    std::string connectionHint;
    /// The topic prefix of a robot that is connected to the broker, without the last '/': "carts/7". No other robot may have
    /// the same one, and the configuration needs the table `mqtt`. Empty: the robot does not use the broker.
    std::string topicPrefix{};
};

/// The valid settings of one robot.
class ACS_API IRobotSetup
{
public:
    IRobotSetup() = default;
    IRobotSetup(const IRobotSetup&) = delete;
    IRobotSetup& operator=(const IRobotSetup&) = delete;
    virtual ~IRobotSetup() = default;

    /// The same in each call: depends on the configuration only.
    [[nodiscard]] virtual RobotCapabilities GetCapabilities() const = 0;

    /// Called once at a start of acsd. Never null. The services outlive the robot, the setup may not.
    [[nodiscard]] virtual std::unique_ptr<IRobot> MakeRobot(RobotServices services) const = 0;
};

} // namespace ACS::Acsd
