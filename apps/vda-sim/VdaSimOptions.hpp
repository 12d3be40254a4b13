#pragma once

#include "common/CommandLine.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/EVda5050Version.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::VdaSim
{

/// The command line of vda-sim.
struct VdaSimOptions
{
    Apps::CommonOptions common;
    Apps::Url broker{Apps::EUrlScheme::Mqtt, {}, {}};
    std::string sitePath;
    std::vector<VehicleSpec> vehicles;
    std::string manufacturer = "ACS";
    std::string interfaceName = "uagv";
    VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version200;
    double timeScale = 1.0;
};

/// Fills the options; the exit code where the program shall not go on. Checks what needs no file.
[[nodiscard]] std::optional<int> ReadCommandLineOrNull(int argc, const char* const* argv, VdaSimOptions& options);

/// Reads the LIF file; the error is one sentence that names it.
[[nodiscard]] tl::expected<Planning::SiteMap, std::string> LoadSite(const std::string& path);

/// Where the vehicle (the first one has index 0) stands at first: its own node, else the dock of the charger CHG01 for
/// the first vehicle, CHG02 for the second and so on, else the first node of the site. The error is one sentence.
[[nodiscard]] tl::expected<std::string, std::string> GetStartNode(
    const VehicleSpec& vehicle,
    std::size_t index,
    const Planning::SiteMap& site);

} // namespace ACS::VdaSim
