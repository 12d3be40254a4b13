#pragma once

#include "Catch.hpp"
#include "config/AcsdConfig.hpp"

#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

/// The example site with these keys on top.
inline AcsdConfig ReadSite(const std::vector<std::string>& overrides)
{
    return ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

/// Keys on top of the example site, and how the only mistake of that begins after "--set: ".
struct ConfigErrorRow
{
    std::vector<std::string> overrides;
    std::string mistake;
};

/// Checks that each row has its mistake and no other.
inline void CheckErrors(const std::vector<ConfigErrorRow>& rows)
{
    for (const ConfigErrorRow& row : rows)
    {
        INFO(row.overrides.front());
        INFO(row.mistake);
        const std::vector<std::string> mistakes = ReadSite(row.overrides).mistakes;
        CHECK(mistakes.size() == 1);
        if (!mistakes.empty())
        {
            INFO(mistakes.front());
            const std::size_t at = mistakes.front().find(": ") + 2; // after "--set" or file and line
            CHECK(mistakes.front().substr(at).starts_with(row.mistake));
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
