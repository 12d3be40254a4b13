#include "drivers/BuiltInDrivers.hpp"

#include "config/AcsdConfig.hpp"
#include "config/VehicleReader.hpp"

namespace ACS::Acsd
{

namespace
{

/// A VDA5050 vehicle; with the name OPEN_STREAM_DRIVER it has an arm whose controller has Open Stream.
class Vda5050Driver final : public IRobotDriver
{
    std::string_view _name;

public:
    explicit Vda5050Driver(std::string_view name) noexcept
        : _name(name)
    {
    }

    [[nodiscard]] std::string_view GetName() const noexcept override
    {
        return _name;
    }

    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override
    {
        return MakeVehicleSetup(config, _name);
    }
};

} // namespace

RobotDrivers MakeBuiltInDrivers()
{
    RobotDrivers drivers;
    drivers.push_back(std::make_unique<const Vda5050Driver>(VDA5050_DRIVER));
    drivers.push_back(std::make_unique<const Vda5050Driver>(OPEN_STREAM_DRIVER));
    return drivers;
}

} // namespace ACS::Acsd
