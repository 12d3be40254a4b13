#include "drivers/BuiltInDrivers.hpp"

#include "drivers/Vda5050Driver.hpp"
#include "drivers/Vda5050OpenStreamDriver.hpp"

namespace ACS::Acsd
{

RobotDrivers MakeBuiltInDrivers()
{
    return MakeDrivers<Vda5050Driver, Vda5050OpenStreamDriver>();
}

} // namespace ACS::Acsd
