#include "robots/VehicleDetails.hpp"

namespace ACS::Acsd
{

std::string_view GetModeText(VDA5050::EOperatingMode mode)
{
    switch (mode)
    {
        case VDA5050::EOperatingMode::SemiAutomatic:
            return "SEMIAUTOMATIC";
        case VDA5050::EOperatingMode::Manual:
            return "MANUAL";
        case VDA5050::EOperatingMode::Service:
            return "SERVICE";
        case VDA5050::EOperatingMode::TeachIn:
            return "TEACHIN";
        case VDA5050::EOperatingMode::Automatic:
        default:
            return "AUTOMATIC";
    }
}

void AddStateDetails(const VDA5050::StateMessage& state, DriverDetails& details)
{
    details.protocolVersion = state.header.version;
    details.mode = GetModeText(state.operatingMode);
    for (const VDA5050::VehicleError& error : state.errors)
    {
        const bool bFatal = error.errorLevel == VDA5050::EErrorLevel::Fatal;
        details.errors.push_back({error.errorType, bFatal ? "FATAL" : "WARNING", error.errorDescription});
    }
}

} // namespace ACS::Acsd
