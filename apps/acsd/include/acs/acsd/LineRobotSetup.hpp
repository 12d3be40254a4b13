#pragma once

#include <acs/acsd/ILineAdapter.hpp>
#include <acs/acsd/IRobotSetup.hpp>
#include <acs/acsd/LineClientOptions.hpp>
#include <acs/acsd/OptionTable.hpp>
#include <acs/core/Api.hpp>

#include <functional>
#include <memory>

namespace ACS::Acsd
{

/// The setup of a robot that speaks lines over TCP: makes a LineRobot.
class ACS_API LineRobotSetup final : public IRobotSetup
{
public:
    /// Makes the adapter of a robot; never null. Called by MakeRobot.
    using AdapterMaker = std::function<std::unique_ptr<ILineAdapter>()>;

private:
    RobotCapabilities _capabilities;
    LineClientOptions _options;
    AdapterMaker _makeAdapter;

public:
    /// Without a connection hint the capabilities get one with host and port.
    LineRobotSetup(RobotCapabilities capabilities, LineClientOptions options, AdapterMaker makeAdapter);

    [[nodiscard]] RobotCapabilities GetCapabilities() const override;
    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices services) const override;
};

/// Reads the keys that every such robot has: `url` (tcp://HOST:PORT, required) and `receive_timeout` (from "100ms" to "1h", default
/// "5s"; "0s" disables), the maximum time between two lines of the robot.
[[nodiscard]] ACS_API LineClientOptions ReadLineOptions(const OptionTable& options);

} // namespace ACS::Acsd
