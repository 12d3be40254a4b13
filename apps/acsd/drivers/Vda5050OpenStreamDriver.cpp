#include "drivers/Vda5050OpenStreamDriver.hpp"

#include "config/AcsdConfig.hpp"
#include "config/VehicleReader.hpp"

namespace ACS::Acsd
{

std::string_view Vda5050OpenStreamDriver::GetName() const noexcept
{
    return OPEN_STREAM_DRIVER;
}

std::unique_ptr<IRobotSetup> Vda5050OpenStreamDriver::MakeSetupOrNull(const DrivenRobotConfig& config) const
{
    return MakeVehicleSetup(config, OPEN_STREAM_DRIVER);
}

} // namespace ACS::Acsd
