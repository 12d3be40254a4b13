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

/// The carrier ports of one robot and the vehicle's names for them (loadPosition, lhd).
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

    /// Names by port without the robot ("CP01"). The default name of a port is the port itself.
    LoadPositions(
        const std::vector<Core::Location>& ports,
        const std::map<std::string, std::string, std::less<>>& names);

    /// "LR01.CP01" without the robot: "CP01".
    [[nodiscard]] static std::string GetPortName(const Core::Location& port);

    /// The vehicle's name of the port "LR01.CP01"; null if the robot has no such port.
    [[nodiscard]] const std::string* FindPositionOrNull(std::string_view location) const;

    /// The port of a load; null if its position is unknown. A load without a position is on the only port.
    [[nodiscard]] const std::string* FindPortOrNull(std::string_view position) const;

    /// The robot has no ports.
    [[nodiscard]] bool IsEmpty() const noexcept;

    /// The reported loads, one entry per port; nullopt if the robot has no ports, if the vehicle reports no loads, and if a
    /// load is at an unknown position, because it may be on any port.
    [[nodiscard]] std::optional<std::vector<Planning::PortLoad>> MakePortLoadsOrNull(
        const VDA5050::StateMessage& state) const;
};

} // namespace ACS::Acsd
