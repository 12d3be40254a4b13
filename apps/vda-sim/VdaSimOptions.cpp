#include "vda-sim/VdaSimOptions.hpp"

#include "common/config/BrokerUrls.hpp"
#include "common/config/DurationText.hpp"
#include "common/config/TextFile.hpp"
#include "common/faults/FaultOptions.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/RobotID.hpp>
#include <acs/plan/LifReader.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

// The readers return an empty text, or what is wrong with the value.

constexpr const char* PROGRAM = "vda-sim";
constexpr std::size_t MAX_VEHICLES = 10'000;

std::string AddVehicle(VehicleSpec spec, std::vector<VehicleSpec>& vehicles)
{
    if (std::ranges::find(vehicles, spec.name, &VehicleSpec::name) != vehicles.end())
    {
        return fmt::format("vehicle {} is given twice", spec.name);
    }
    vehicles.push_back(std::move(spec));
    return {};
}

template <typename TValue, typename TStore>
std::string Read(Core::Result<TValue> value, TStore store)
{
    if (!value.has_value())
    {
        return Core::Describe(value.error());
    }
    return store(std::move(*value));
}

/// Vehicles of --count, --prefix and --type.
struct VehicleRow
{
    std::size_t count = 0;
    std::string prefix = "LR";
    EVehicleType type = EVehicleType::Logistics;
};

std::string AddVehicles(const VehicleRow& row, std::vector<VehicleSpec>& vehicles)
{
    for (std::size_t number = 1; number <= row.count; ++number)
    {
        VehicleSpec spec;
        spec.name = MakeVehicleName(row.prefix, number, row.count);
        spec.type = row.type;
        std::string error = AddVehicle(std::move(spec), vehicles);
        if (!error.empty())
        {
            return error + "; give --count another --prefix";
        }
    }
    return vehicles.empty() ? "no vehicles: give --vehicle NAME or --count N" : "";
}

/// Whether it is an action that a vehicle performs; the session handles the others immediately.
bool HasDuration(std::string_view actionType)
{
    constexpr std::array AT_ONCE{
        VDA5050::ActionTypes::START_PAUSE,
        VDA5050::ActionTypes::STOP_PAUSE,
        VDA5050::ActionTypes::STATE_REQUEST,
        VDA5050::ActionTypes::FACTSHEET_REQUEST,
        VDA5050::ActionTypes::CANCEL_ORDER};
    return VDA5050::FindPredefinedActionOrNull(actionType) != nullptr
        && std::ranges::find(AT_ONCE, actionType) == AT_ONCE.end();
}

std::string ReadSeed(const std::string& text, std::optional<std::uint64_t>& seed)
{
    seed = Core::ParseNumberOrNull<std::uint64_t>(text);
    return seed.has_value()
        ? ""
        : fmt::format("expected a number from 0 to {}, found {}", UINT64_MAX, Core::QuoteForError(text));
}

std::string ReadActionTime(const std::string& text, std::map<std::string, double, std::less<>>& seconds)
{
    const std::size_t equals = text.find('=');
    const Core::Result<std::chrono::milliseconds> duration = Apps::ParseDuration(
        equals == std::string::npos ? std::string_view{} : std::string_view(text).substr(equals + 1));
    if (equals == 0 || !duration.has_value())
    {
        return fmt::format("expected ACTIONTYPE=DURATION (pick=5s), found {}", Core::QuoteForError(text));
    }
    const std::string actionType = text.substr(0, equals);
    if (!HasDuration(actionType))
    {
        return fmt::format(
            "{} is not an action with a duration; pick, drop and startCharging are",
            Core::QuoteForError(actionType));
    }
    seconds[actionType] = std::chrono::duration<double>(*duration).count();
    return {};
}

std::string ReadControlTopic(const std::string& text, std::string& topic)
{
    if (text.empty() || text.find_first_of("+#") != std::string::npos || text.starts_with('$'))
    {
        return fmt::format("expected a topic without + and #, found {}", Core::QuoteForError(text));
    }
    topic = text;
    return {};
}

/// Whether the vehicle has the action; pick and drop also under names of its own.
bool HasAction(const VehicleSpec& vehicle, std::string_view actionType, const VdaSimOptions& options)
{
    LoadHandling handling;
    handling.ports = vehicle.handling.ports;
    VDA5050::FactsheetMessage factsheet =
        MakeFactsheet(vehicle.type, MotionLimits{}, vehicle.version.value_or(options.version), handling);
    const VehicleProfile& profile = GetProfile(vehicle.profile.value_or(options.profile));
    if (profile.adaptOrNull != nullptr)
    {
        profile.adaptOrNull(factsheet);
    }
    return std::ranges::count(factsheet.protocolFeatures.agvActions, actionType, &VDA5050::AgvAction::actionType) > 0;
}

/// A duration of an action that no vehicle has would have no effect.
std::string CheckActionTimes(const VdaSimOptions& options)
{
    for (const auto& [actionType, seconds] : options.actionSeconds)
    {
        const bool bKnown =
            std::ranges::any_of(options.vehicles, [&actionType = actionType, &options](const auto& vehicle) {
                return HasAction(vehicle, actionType, options);
            });
        if (!bKnown)
        {
            return fmt::format(
                "--action-time {}: no vehicle has this action; change type, ports, protocol or profile of one, or remove the "
                "option",
                actionType);
        }
    }
    return {};
}

/// A fault for an unknown vehicle would never occur.
std::string CheckFaults(const std::vector<FaultCommand>& faults, const std::vector<VehicleSpec>& vehicles)
{
    for (const FaultCommand& command : faults)
    {
        const bool bKnown = std::ranges::any_of(vehicles, [&command](const VehicleSpec& vehicle) {
            return Apps::IsTarget(command.targets, vehicle.name);
        });
        if (!bKnown)
        {
            return fmt::format(
                "fault '{} {}': no such vehicle; one of the vehicles is {}",
                command.targets,
                command.fault.text,
                vehicles.front().name);
        }
    }
    return {};
}

std::string MakeProfileHelp()
{
    std::string help;
    for (const VehicleProfile& profile : GetProfiles())
    {
        help += fmt::format("  {:<18}{}\n", profile.name, profile.description);
    }
    return help;
}

std::string MakeFooter()
{
    return fmt::format(
        "Profiles of vehicles:\n"
        "{}"
        "Faults, on the command line, in a file (one per line, # begins a comment) and on the control topic:\n"
        "  VEHICLE FAULT [KEY=VALUE]...  begins a fault; VEHICLE is a name, or the beginning of names followed by *\n"
        "      at=DURATION: begin after this time; node=NODEID: begin on arrival at this node;\n"
        "      for=DURATION: end after this time\n"
        "  VEHICLE end [FAULT]           ends this fault, or all faults (control topic)\n"
        "  VEHICLE trigger               ends a waitForTrigger (control topic)\n"
        "{}"
        "Example: vda-sim ... --fault 'LR01 blocked node=N045 for=10s' --fault 'LR* loss percent=5'\n"
        "         mosquitto_pub -t vda-sim/control -m 'LR01 estop for=5s'\n"
        "docs/reference/vda-sim.md describes every profile and every fault.",
        MakeProfileHelp(),
        Apps::MakeFaultHelp(GetFaultGrammar()));
}

/// The world file names ports by their robot.
std::string CheckWorld(const VdaSimOptions& options)
{
    const auto misnamed = std::ranges::find_if(options.vehicles, [](const VehicleSpec& vehicle) {
        return !Core::RobotID::IsRobotID(vehicle.name) || vehicle.name == Core::RobotID::ALIAS;
    });
    if (options.worldPath.empty() || misnamed == options.vehicles.end())
    {
        return {};
    }
    return fmt::format(
        "--world: expected vehicle names that are robot ids (LR01), found {}",
        Core::QuoteForError(misnamed->name));
}

/// Reads one level of a topic.
std::string ReadLevel(const std::string& text, std::string& level)
{
    if (!IsPlainLevel(text))
    {
        return fmt::format("expected {}, found {}", PLAIN_LEVEL, Core::QuoteForError(text));
    }
    level = text;
    return {};
}

} // namespace

std::optional<int> ReadCommandLineOrNull(int argc, const char* const* argv, VdaSimOptions& options)
{
    CLI::App app{
        "Simulates VDA5050 vehicles: they drive orders on a site, perform actions and report over MQTT.\n"
        "Example: vda-sim --broker mqtt://127.0.0.1:1883 --site site.lif.json --vehicle LR01 --vehicle CR01,type=CR",
        PROGRAM};
    app.footer(MakeFooter());
    VehicleRow row;
    Apps::AddRepeatedOption(
        app,
        "--broker",
        [&options](const std::string& text) {
            return Read(Apps::ParseURL(text, Apps::GetBrokerSchemes()), [&options](Apps::Url url) {
                options.brokers.push_back(std::move(url));
                return std::string();
            });
        },
        "MQTT broker, mqtt://HOST:PORT or mqtts://HOST:PORT; retried until it is reachable. Repeated for the nodes of a cluster: a "
        "lost connection leads to the next one")
        .type_name("URL")
        ->required();
    AddBrokerOptions(app, options.link);
    app.add_option("--site", options.sitePath, "Layout of the site, a VDMA LIF 1.0 file")
        ->required()
        ->type_name("FILE.lif.json");
    Apps::AddFileOption(
        app,
        "--world",
        options.worldPath,
        "World file that the simulators share (docs/reference/world.md); a pick from an empty place and a drop to an occupied one "
        "fail then. Without it every pick and drop finds its load (default)");
    Apps::AddRepeatedOption(
        app,
        "--vehicle",
        [&options](const std::string& text) {
            return Read(ParseVehicleSpec(text), [&options](VehicleSpec spec) {
                return AddVehicle(std::move(spec), options.vehicles);
            });
        },
        "Vehicle with this serialNumber. Keys: type=LR|CR, carries cassettes or is the base of an arm (default LR); "
        "node=NODEID, start node (default: the dock of charger CHG01 for the first vehicle, CHG02 for the second and so "
        "on, or a node of the site if there is no such charger); position=X:Y, start position in metres (default: that of "
        "the node); protocol=VERSION (default: --protocol); battery=PERCENT, initial charge (default 100); profile=NAME (default: --profile); ports=N, number "
        "of load positions CP01, CP02 ... (default 4 for LR, 0 for CR); load=PORT:NAME, the vehicle's name of a port; pick=ACTIONTYPE and drop=ACTIONTYPE, actions that "
        "pick and drop; PARAMETER=NAME[:TYPE], the vehicle's name of a parameter of pick and drop (empty: not "
        "supported). May be repeated")
        .type_name("NAME[,KEY=VALUE]...");
    Apps::AddCountOption(
        app,
        "--count",
        row.count,
        {1, MAX_VEHICLES},
        "Number of additional vehicles, named by --prefix and a number: LR01, LR02, ... (default: none)");
    Apps::AddTextOption(
        app,
        "--prefix",
        [&row](const std::string& text) { return ReadLevel(text, row.prefix); },
        "Prefix of the names of --count")
        .default_str(row.prefix);
    Apps::AddTextOption(
        app,
        "--type",
        [&row](const std::string& text) { return Apps::AssignValue(ParseVehicleType(text), row.type); },
        "Type of the vehicles of --count: LR or CR")
        .default_str("LR");
    Apps::AddTextOption(
        app,
        "--manufacturer",
        [&options](const std::string& text) { return ReadLevel(text, options.manufacturer); },
        "Manufacturer in topics and headers")
        .default_str(options.manufacturer);
    Apps::AddTextOption(
        app,
        "--interface-name",
        [&options](const std::string& text) { return ReadLevel(text, options.interfaceName); },
        "First level of the topics")
        .default_str(options.interfaceName);
    Apps::AddTextOption(
        app,
        "--protocol",
        [&options](const std::string& text) { return Apps::AssignValue(ParseProtocol(text), options.version); },
        "VDA5050 version of vehicles without protocol=VERSION: 2.0.0 or 2.1.0")
        .default_str("2.0.0");
    Apps::AddTextOption(
        app,
        "--profile",
        [&options](const std::string& text) { return Apps::AssignValue(ParseProfile(text), options.profile); },
        "Make that vehicles without profile=NAME imitate, see below; they reject what breaks its rules")
        .default_str(std::string(GetProfile(options.profile).name));
    Apps::AddTimeScaleOption(app, options.timeScale);
    Apps::AddRepeatedOption(
        app,
        "--action-time",
        [&options](const std::string& text) { return ReadActionTime(text, options.actionSeconds); },
        "Duration of the actions of this type, in simulated time (default: pick and drop 3s, waitForTrigger until it is "
        "triggered, others 1s; 0s: no duration). May be repeated")
        .type_name("ACTIONTYPE=DURATION");
    app.add_flag(
        "--lenient-parameters",
        options.bLenientParameters,
        "Accept action parameters that the factsheet does not list, and numbers and booleans as text. Unlisted ones are "
        "reported in the state (WARNING unlistedParameter) and in the log. By default such orders are refused");
    Apps::AddFaultOptions(
        app,
        GetFaultGrammar(),
        options.faults,
        "Fault of a vehicle, see below; its times count from when the vehicle is online for the first time. May be repeated");
    CLI::Option& controlTopic = Apps::AddTextOption(
        app,
        "--control-topic",
        [&options](const std::string& text) { return ReadControlTopic(text, options.controlTopic); },
        "MQTT topic of commands that begin and end faults; results are published on TOPIC/result");
    controlTopic.default_str(options.controlTopic);
    bool bNoControl = false;
    app.add_flag("--no-control", bNoControl, "Do not subscribe to a control topic")->excludes(&controlTopic);
    Apps::AddTextOption(
        app,
        "--seed",
        [&options](const std::string& text) { return ReadSeed(text, options.seed); },
        "Seed of random losses and delays, which makes them reproducible (default: random; it is logged)")
        .type_name("N");
    Apps::AddTraceOptions(app, options.trace);
    Apps::AddCommonOptions(app, options.common);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCode.has_value())
    {
        return exitCode;
    }
    options.controlTopic = bNoControl ? std::string() : options.controlTopic;
    std::string error = CheckBrokerOptions(options.link, options.brokers);
    error = error.empty() ? AddVehicles(row, options.vehicles) : error;
    error = error.empty() ? CheckActionTimes(options) : error;
    error = error.empty() ? CheckWorld(options) : error;
    error = error.empty() ? CheckFaults(options.faults, options.vehicles) : error;
    if (!error.empty())
    {
        Apps::PrintError(PROGRAM, error);
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    return std::nullopt;
}

tl::expected<Planning::SiteMap, std::string> LoadSite(const std::string& path, std::vector<std::string>& warnings)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return tl::make_unexpected(
            fmt::format("cannot read the site {} ({}); give the path of a LIF file", path, text.error()));
    }
    Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(*text, warnings);
    if (!site.has_value())
    {
        return tl::make_unexpected(
            fmt::format("the site {} is not a valid LIF file: {}", path, Core::Describe(site.error())));
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
    const auto& nodes = site.GetNodes();
    return charger != nullptr ? charger->nodeIDs.front() : nodes[index % nodes.size()].nodeID;
}

} // namespace ACS::VdaSim
