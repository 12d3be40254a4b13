#pragma once

#include "Catch.hpp"
#include "config/AcsdConfig.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

/// The example site with these keys on top.
inline AcsdConfig ReadSite(const std::vector<std::string>& overrides)
{
    return ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

/// A robot of the configuration whose driver is built in.
inline const VehicleConfig& FindVehicle(const AcsdConfig& config, const std::string& robotID)
{
    return **std::ranges::find_if(config.vehicles, [&robotID](const auto& vehicle) {
        return vehicle->robotID == robotID;
    });
}

/// Keys that override the example site, and the begin of the only resulting error after "--set: ".
struct ConfigErrorRow
{
    std::vector<std::string> overrides;
    std::string error;
};

/// Checks that each row has its error and no other.
inline void CheckErrors(const std::vector<ConfigErrorRow>& rows)
{
    for (const ConfigErrorRow& row : rows)
    {
        INFO(row.overrides.front());
        INFO(row.error);
        const std::vector<std::string> errors = ReadSite(row.overrides).errors;
        CHECK(errors.size() == 1);
        if (!errors.empty())
        {
            INFO(errors.front());
            const std::size_t at = errors.front().find(": ") + 2; // after "--set" or file and line
            CHECK(errors.front().substr(at).starts_with(row.error));
        }
    }
}

/// A second vehicle, without its closing brace: keys can follow.
inline const std::string SECOND_VEHICLE =
    "robots.LR02={type='LR', manufacturer='B', serial='LR02', vehicle_type='lr-base', start_node='N001', "
    "ports=['CP01-02'], ";

/// A second robot with an arm, likewise.
inline const std::string SECOND_ARM =
    "robots.CR02={type='CR', manufacturer='B', serial='CR02', vehicle_type='cr-base', start_node='N001', "
    "ports=['TP01-03'], child_ports=['TP01.MP01-25'], arm={url='tcp://127.0.0.1:49001', monitor_start=480}, ";

} // namespace ACS::Acsd::Test
