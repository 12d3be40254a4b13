#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The maps that a vehicle reports, and the actions that add, enable and delete them. At most one version of a map is enabled.
class VehicleMaps
{
    std::optional<std::vector<MapState>> _maps; ///< Absent: the vehicle does not report maps.

public:
    /// False: nothing has changed.
    [[nodiscard]] bool TryChange(std::optional<std::vector<MapState>> mapsOrNull);
    /// Why an action about a map cannot succeed; empty for others.
    [[nodiscard]] std::string FindFault(const Action& action) const;
    /// Why a started action that the owner reports as finished has failed: the map was enabled or deleted meanwhile. Empty for others.
    [[nodiscard]] std::string FindEndFault(const Action& action) const;
    /// Applies the effect of a finished action; the owner may have reported it already.
    void Apply(const Action& action);
    /// A vehicle that is localised on a map uses it, and a map in use is ENABLED. Of several versions the one is unknown.
    void EnableOnlyVersion(std::string_view mapID);

    [[nodiscard]] bool HasMap(std::string_view mapID) const;
    [[nodiscard]] const std::optional<std::vector<MapState>>& GetStates() const noexcept;
};

} // namespace ACS::VDA5050
