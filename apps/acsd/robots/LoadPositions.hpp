#pragma once

#include <acs/core/Location.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The carrier ports of one robot and what its vehicle calls them (loadPosition, lhd).
class LoadPositions final
{
    struct Port
    {
        std::string location; ///< "LR01.CP01"
        std::string position; ///< "front"
    };

    std::vector<Port> _ports; ///< In the order of carrierIds.

public:
    LoadPositions() = default;

    /// Names by port without the robot ("CP01"); a port without a name is called as the port is.
    LoadPositions(
        const std::vector<Core::Location>& ports,
        const std::map<std::string, std::string, std::less<>>& names);

    /// "LR01.CP01" without the robot: "CP01".
    [[nodiscard]] static std::string GetPortName(const Core::Location& port);

    /// The vehicle's name of the port "LR01.CP01"; null where the robot has no such port.
    [[nodiscard]] const std::string* FindPositionOrNull(std::string_view location) const;

    /// The port of a load; null where its position is none of the robot's. A load without a position is on the only port.
    [[nodiscard]] const std::string* FindPortOrNull(std::string_view position) const;

    /// The robot has no ports.
    [[nodiscard]] bool IsEmpty() const noexcept;

    /// What the vehicle shows, one entry per port; absent where the robot has no ports, where the vehicle reports no loads, and
    /// where one of them is at an unknown position: it may be on any port.
    [[nodiscard]] std::optional<std::vector<Planning::PortLoad>> MakePortLoadsOrNull(
        const VDA5050::StateMessage& state) const;
};

} // namespace ACS::Acsd
