#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/ActionConfig.hpp"
#include "config/SitePlaces.hpp"
#include "config/VehicleConfig.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// One table of an action and its keys.
struct MethodTable
{
    Apps::ConfigSection section;
    MethodKeys keys;
};

/// By action; those of stations by station, then by action.
using MethodTables = std::map<std::string, MethodTable, std::less<>>;
using StationTables = std::map<std::string, MethodTables, std::less<>>;

/// Why a robot cannot do an action, and which key of a table is the cause.
struct MethodFault
{
    std::string robotID;
    std::string key;
    std::string reason; ///< Worded as by the robot's adapter.
    std::string remedy;
};

/// Resolves how each robot does one action. Reports tables that make a robot unable to do it or that have no effect.
class MethodResolver final
{
    const std::string& _action;
    const Planning::ActionRule& _rule;
    const MethodTable& _base;
    const StationTables& _stations;
    std::vector<std::string>& _warnings;
    std::vector<MethodKeys> _used;               ///< The keys of the robots that can do it.
    std::optional<MethodFault> _baseFaultOrNull; ///< Of the first robot without an override that cannot do it.
    bool _bOverrideFault = false;

public:
    /// All of them must outlive it.
    MethodResolver(
        const std::string& action,
        const Planning::ActionRule& rule,
        const MethodTable& base,
        const StationTables& stations,
        std::vector<std::string>& warnings);

    /// The override is null if the robot has none.
    void SetMethods(const MethodTable* overrideOrNull, VehicleConfig& vehicle);

    /// Reports the errors that concern all robots. Call after the last robot.
    void Check(const SitePlaces& places) const;

private:
    void SetStationMethods(const MethodKeys& keys, VehicleConfig& vehicle) const;
    void CheckStation(const std::string& stationID, const MethodTable& table, const SitePlaces& places) const;
};

} // namespace ACS::Acsd
