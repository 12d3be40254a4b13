#pragma once

#include <acs/acsd/IRobotSetup.hpp>
#include <acs/acsd/OptionTable.hpp>
#include <acs/core/Api.hpp>
#include <acs/core/Location.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/ERobotType.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

struct DriverContext; // internal

/// What the configuration has for one robot of a driver.
struct DrivenRobotConfig
{
    std::string robotID;
    Planning::ERobotType type =
        Planning::ERobotType::LR;      ///< One of RobotCapabilities::types, or the configuration is invalid.
    std::vector<Core::Location> ports; ///< Its carrier ports ("LR01.CP01"), in the order of carrierIds.
    OptionTable options;               ///< `robots.NAME.options`
    /// `actions.ACTION.options` by action, for every action of the robot's type.
    std::map<std::string, OptionTable, std::less<>> actions;
    const DriverContext* contextOrNull = nullptr; ///< Read by acsd's own drivers only; null in tests of a driver.
};

/// A kind of robot that acsd can command: the integrator's entry point. Has no state that changes; used by one thread.
class ACS_API IRobotDriver
{
public:
    IRobotDriver() = default;
    IRobotDriver(const IRobotDriver&) = delete;
    IRobotDriver& operator=(const IRobotDriver&) = delete;
    virtual ~IRobotDriver() = default;

    /// The value of `robots.NAME.driver`: 1 to 32 of a-z, 0-9 and _, the first one a letter.
    [[nodiscard]] virtual std::string_view GetName() const noexcept = 0;

    /// Reads and validates the options of a robot; opens no connection, because `acsd --check-config` calls it too. Keys that are not
    /// read are errors. Adds each error and each warning to its OptionTable; nullptr, and any error, make the configuration invalid.
    [[nodiscard]] virtual std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const = 0;
};

/// The drivers of a program, for RunAcsd. Two of one name are an error.
using RobotDrivers = std::vector<std::unique_ptr<const IRobotDriver>>;

/// One driver of each type, for RunAcsd.
template <typename... TDrivers>
[[nodiscard]] RobotDrivers MakeDrivers()
{
    RobotDrivers drivers;
    (drivers.push_back(std::make_unique<const TDrivers>()), ...);
    return drivers;
}

} // namespace ACS::Acsd
