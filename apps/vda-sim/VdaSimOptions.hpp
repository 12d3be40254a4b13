#pragma once

#include "common/config/CommandLine.hpp"
#include "common/trace/TraceOptions.hpp"
#include "vda-sim/BrokerOptions.hpp"
#include "vda-sim/FaultCommand.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/EVda5050Version.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VdaSim
{

/// The command line of vda-sim.
struct VdaSimOptions
{
    Apps::CommonOptions common;
    std::vector<Apps::Url> brokers; ///< Of one broker, or the nodes of a cluster in the order of their use.
    BrokerOptions link;
    std::string sitePath;
    std::string worldPath; ///< Empty: none.
    std::vector<VehicleSpec> vehicles;
    std::string manufacturer = "ACS";
    std::string interfaceName = "uagv";
    VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version200;
    EVehicleProfile profile = EVehicleProfile::Standard; ///< Of vehicles without one of their own.
    double timeScale = 1.0;
    std::optional<std::uint64_t> seed; ///< Absent: random and logged.
    std::map<std::string, double, std::less<>> actionSeconds;
    std::vector<FaultCommand> faults; ///< Of --fault and --fault-file; all of them begin one.
    bool bLenientParameters = false;
    Apps::TraceOptions trace;
    std::string controlTopic = "vda-sim/control"; ///< Empty: none.
};

/// Fills the options; returns the exit code if the program is to end. Reads the fault files; LoadSite reads the site.
[[nodiscard]] std::optional<int> ReadCommandLineOrNull(int argc, const char* const* argv, VdaSimOptions& options);

/// Reads the LIF file; the error is one sentence that names it. Appends the warnings of the reader.
[[nodiscard]] tl::expected<Planning::SiteMap, std::string> LoadSite(
    const std::string& path,
    std::vector<std::string>& warnings);

/// Start node of the vehicle (the first one has index 0): its own node, else the dock of the charger CHG01 for the first
/// vehicle, CHG02 for the second and so on. If there is no such charger: the node of the site at that index, modulo the
/// number of nodes. The error is one sentence.
[[nodiscard]] tl::expected<std::string, std::string> GetStartNode(
    const VehicleSpec& vehicle,
    std::size_t index,
    const Planning::SiteMap& site);

} // namespace ACS::VdaSim
