#include "drivers/Vda5050Driver.hpp"

#include "config/AcsdConfig.hpp"
#include "config/VehicleReader.hpp"

namespace ACS::Acsd
{

std::string_view Vda5050Driver::GetName() const noexcept
{
    return VDA5050_DRIVER;
}

std::unique_ptr<IRobotSetup> Vda5050Driver::MakeSetupOrNull(const DrivenRobotConfig& config) const
{
    return MakeVehicleSetup(config, VDA5050_DRIVER);
}

} // namespace ACS::Acsd
