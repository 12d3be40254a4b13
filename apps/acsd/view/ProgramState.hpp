#pragma once

#include "mcs/RefusedReports.hpp"
#include <acs/acsd/IRobot.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// One link of acsd.
struct LinkStatus
{
    std::string name; ///< "mcs", "mqtt"
    bool bUp = false;
    std::string notReadyReason{}; ///< Why it is not up, as a line of /readyz; empty: there is no connection.
    std::string broker{};         ///< URL of the connected broker, without credentials; empty: none.

    bool operator==(const LinkStatus&) const = default;
};

/// What a robot has from its configuration and its driver.
struct RobotLinkState
{
    std::string driver;
    std::vector<std::string> ports;
    std::string topicPrefix; ///< "uagv/v2/ACME/0001"; empty: it has none.
    DriverDetails details;
};

/// What operators see besides the engine's own state.
struct ProgramState
{
    std::vector<LinkStatus> links;
    std::vector<std::string> notReadyReasons; ///< Besides the links.
    std::optional<bool> bConnected;           ///< isConnected, as it was last published to the MCS.
    RefusedReports refusedReports{};
    std::map<std::string, RobotLinkState, std::less<>> robots{}; ///< By robotID.
};

/// Why a link that is not up is not, as a line of /readyz.
[[nodiscard]] std::string DescribeDown(const LinkStatus& link);

/// All not-ready reasons, those of the links first.
[[nodiscard]] std::vector<std::string> ListNotReadyReasons(const ProgramState& program);

} // namespace ACS::Acsd
