#include "vda-sim/VdaSimOptions.hpp"

#include "common/TextFile.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/vda5050/Topic.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace ACS::VdaSim
{
namespace
{

// The readers return what is wrong with a value, or nothing.

constexpr const char* PROGRAM = "vda-sim";

std::string AddVehicle(const std::string& text, std::vector<VehicleSpec>& vehicles)
{
    Core::Result<VehicleSpec> spec = ParseVehicleSpec(text);
    if (!spec.has_value())
    {
        return Core::Describe(spec.error());
    }
    if (std::ranges::find(vehicles, spec->name, &VehicleSpec::name) != vehicles.end())
    {
        return fmt::format("the vehicle {} is there twice", spec->name);
    }
    vehicles.push_back(std::move(*spec));
    return {};
}

std::string ReadVersion(const std::string& text, VDA5050::EVda5050Version& version)
{
    for (const auto known : {VDA5050::EVda5050Version::Version200, VDA5050::EVda5050Version::Version210})
    {
        if (text == VDA5050::GetVersionText(known))
        {
            version = known;
            return {};
        }
    }
    return fmt::format("expected 2.0.0 or 2.1.0, found {}", Core::QuoteForError(text));
}

/// A word that is to stand as one level of a topic.
std::string ReadLevel(const std::string& text, std::string& level)
{
    if (!VDA5050::IsValidAddress({.interfaceName = "x", .manufacturer = text, .serialNumber = "x"}))
    {
        return fmt::format("expected a word without /, + and #, found {}", Core::QuoteForError(text));
    }
    level = text;
    return {};
}

} // namespace

std::optional<int> ReadCommandLineOrNull(int argc, const char* const* argv, VdaSimOptions& options)
{
    CLI::App app{
        "Virtual VDA5050 vehicles: drive orders on a site, perform their actions, report over MQTT.\n"
        "Example: vda-sim --broker mqtt://127.0.0.1:1883 --site site.lif.json --vehicle LR01 --vehicle CR01,type=CR",
        PROGRAM};
    Apps::AddUrlOption(
        app,
        "--broker",
        options.broker,
        {Apps::EUrlScheme::Mqtt, Apps::EUrlScheme::Mqtts},
        "MQTT broker, mqtt://HOST:PORT or mqtts://HOST:PORT; tried again until it answers")
        .required();
    app.add_option("--site", options.sitePath, "layout of the site, a VDMA LIF 1.0 file")
        ->required()
        ->type_name("FILE.lif.json");
    Apps::AddRepeatedOption(
        app,
        "--vehicle",
        [&options](const std::string& text) { return AddVehicle(text, options.vehicles); },
        "a vehicle: its serialNumber; type LR (default) carries cassettes, CR is the base of an arm; node is where it "
        "stands at first, by default the dock of the charger CHG01 for the first vehicle, CHG02 for the second and so "
        "on, else the first node of the site. May be repeated")
        .required()
        ->type_name("NAME[,type=LR|CR][,node=NODEID]");
    Apps::AddTextOption(
        app,
        "--manufacturer",
        [&options](const std::string& text) { return ReadLevel(text, options.manufacturer); },
        "manufacturer in topics and headers")
        .default_str(options.manufacturer);
    Apps::AddTextOption(
        app,
        "--interface-name",
        [&options](const std::string& text) { return ReadLevel(text, options.interfaceName); },
        "first level of the topics")
        .default_str(options.interfaceName);
    Apps::AddTextOption(
        app,
        "--protocol",
        [&options](const std::string& text) { return ReadVersion(text, options.version); },
        "VDA5050 version: 2.0.0 or 2.1.0")
        .default_str("2.0.0");
    Apps::AddTimeScaleOption(app, options.timeScale);
    Apps::AddCommonOptions(app, options.common);
    return Apps::ParseCommandLineOrNull(app, argc, argv);
}

tl::expected<Planning::SiteMap, std::string> LoadSite(const std::string& path)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return tl::make_unexpected(
            fmt::format("the site {} cannot be read ({}); give the path of a LIF file", path, text.error()));
    }
    Core::Result<Planning::SiteMap> site = Planning::DecodeLif(*text);
    if (!site.has_value())
    {
        return tl::make_unexpected(
            fmt::format("the site {} is no valid LIF file: {}", path, Core::Describe(site.error())));
    }
    return std::move(*site);
}

tl::expected<std::string, std::string> GetStartNode(
    const VehicleSpec& vehicle,
    std::size_t index,
    const Planning::SiteMap& site)
{
    if (vehicle.startNodeID.has_value())
    {
        if (site.FindNodeOrNull(*vehicle.startNodeID) == nullptr)
        {
            return tl::make_unexpected(
                fmt::format("vehicle {}: the site has no node {}", vehicle.name, *vehicle.startNodeID));
        }
        return *vehicle.startNodeID;
    }
    const Planning::SiteStation* const charger = site.FindStationOrNull(fmt::format("CHG{:02}", index + 1));
    return charger != nullptr ? charger->nodeIDs.front() : site.GetNodes().front().nodeID;
}

} // namespace ACS::VdaSim
