#pragma once

#include "robots/VehicleMap.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Whether the session's factsheet allows a drive along the route. Error: the member or limit that does not.
[[nodiscard]] Core::Result<void> CheckDrive(
    const VDA5050::MasterSession& session,
    const Planning::Route& route,
    Core::Now now);

/// Compares the drives on the map of a vehicle type with factsheets. Each edge is an order to be made, so on a large map this takes
/// long; vehicles with equal factsheets share one result. Used by the vehicles of one type on one thread.
class DriveCheck final
{
public:
    static constexpr std::size_t MOST_FACTSHEETS = 16; ///< Of which the results are kept.

private:
    /// All that a result depends on besides the map.
    struct Subject
    {
        VDA5050::FactsheetMessage factsheet; ///< Without what differs between equal vehicles.
        std::string zoneSetID;               ///< Of the orders.
        std::size_t addressLength;           ///< A part of the size of orders.
        VDA5050::EVda5050Version version;    ///< Of the orders.

        bool operator==(const Subject&) const = default;
    };

    struct Checked
    {
        Subject subject;
        std::string fault;
    };

    VehicleMap _map;
    std::vector<Checked> _checked; ///< The oldest first.

public:
    explicit DriveCheck(VehicleMap map = {});

    [[nodiscard]] const VehicleMap& GetMap() const noexcept;

    /// Why the vehicle cannot be ordered to drive along one of the edges, and what to correct; a sentence each. Empty: it can drive along all, or has no
    /// factsheet.
    [[nodiscard]] std::string FindFault(const VDA5050::MasterSession& session, Core::Now now);

    /// Of factsheets whose results are kept.
    [[nodiscard]] std::size_t CountFactsheets() const noexcept;
};

} // namespace ACS::Acsd
