#include "vda-sim/VdaSimOptions.hpp"

#include "common/config/DurationText.hpp"
#include "common/config/TextFile.hpp"
#include "common/faults/FaultOptions.hpp"
#include <acs/core/RobotID.hpp>
#include <acs/plan/LifReader.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

// The readers return what is wrong with a value, or nothing.

constexpr const char* PROGRAM = "vda-sim";
constexpr std::size_t MAX_VEHICLES = 10'000;

std::string AddVehicle(VehicleSpec spec, std::vector<VehicleSpec>& vehicles)
{
    if (std::ranges::find(vehicles, spec.name, &VehicleSpec::name) != vehicles.end())
    {
        return fmt::format("the vehicle {} is there twice", spec.name);
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

/// What a --count, its --prefix and its --type make.
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
        std::string mistake = AddVehicle(std::move(spec), vehicles);
        if (!mistake.empty())
        {
            return mistake + "; give --count another --prefix";
        }
    }
    return vehicles.empty() ? "there are no vehicles: give --vehicle NAME or --count N" : "";
}

/// Whether vehicles perform it, and not at once, as the session does with the others.
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
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
    {
        return fmt::format("expected a number from 0 to {}, found {}", UINT64_MAX, Core::QuoteForError(text));
    }
    seed = number;
    return {};
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
            "no action {} of a vehicle takes time; pick, drop or startCharging do",
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

/// A fault for a vehicle that is not there would be waited for in vain.
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
                "the fault '{} {}' is for no vehicle that there is; {} is one",
                command.targets,
                command.fault.text,
                vehicles.front().name);
        }
    }
    return {};
}

std::string MakeFooter()
{
    return fmt::format(
        "Faults, on the command line, in a file (a line each, # for remarks) and on the control topic:\n"
        "  VEHICLE FAULT [KEY=VALUE]...  begins one; VEHICLE is a name, or its beginning and *\n"
        "      at=DURATION later, node=NODEID once this node is reached, for=DURATION so long\n"
        "  VEHICLE end [FAULT]           ends it, or all (control topic)\n"
        "  VEHICLE trigger               ends a waitForTrigger (control topic)\n"
        "{}"
        "Example: vda-sim ... --fault 'LR01 blocked node=N045 for=10s' --fault 'LR* loss percent=5'\n"
        "         mosquitto_pub -t vda-sim/control -m 'LR01 estop for=5s'\n"
        "docs/reference/vda-sim.md explains each.",
        Apps::MakeFaultHelp(GetFaultGrammar()));
}

/// In a world ports are named by their robot.
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
        "--world: expected vehicles with names of robots (LR01), found {}",
        Core::QuoteForError(misnamed->name));
}

/// A word that is to stand as one level of a topic.
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
        "Virtual VDA5050 vehicles: drive orders on a site, perform their actions, report over MQTT.\n"
        "Example: vda-sim --broker mqtt://127.0.0.1:1883 --site site.lif.json --vehicle LR01 --vehicle CR01,type=CR",
        PROGRAM};
    app.footer(MakeFooter());
    VehicleRow row;
    Apps::AddUrlOption(
        app,
        "--broker",
        options.broker,
        {Apps::EUrlScheme::Mqtt, Apps::EUrlScheme::Mqtts},
        "MQTT broker, mqtt://HOST:PORT or mqtts://HOST:PORT; tried again until it answers")
        .required();
    AddBrokerOptions(app, options.link);
    app.add_option("--site", options.sitePath, "layout of the site, a VDMA LIF 1.0 file")
        ->required()
        ->type_name("FILE.lif.json");
    Apps::AddFileOption(
        app,
        "--world",
        options.worldPath,
        "world file that the simulators share (docs/reference/world.md): loads are picked and dropped only where they are; "
        "without it every load is where an action asks for it");
    Apps::AddRepeatedOption(
        app,
        "--vehicle",
        [&options](const std::string& text) {
            return Read(ParseVehicleSpec(text), [&options](VehicleSpec spec) {
                return AddVehicle(std::move(spec), options.vehicles);
            });
        },
        "a vehicle: its serialNumber; type LR (default) carries cassettes, CR is the base of an arm; node is where it "
        "stands at first, by default the dock of the charger CHG01 for the first vehicle, CHG02 for the second and so "
        "on, else a node of the site; protocol, where it differs from --protocol; battery is its charge at first. "
        "How it handles loads: ports=N places CP01, CP02 ... (default 4 of an LR, 0 of a CR), load=PORT:NAME the "
        "vehicle's name of one, pick=ACTIONTYPE and drop=ACTIONTYPE, and PARAMETER=NAME[:TYPE] for parameters of pick "
        "and drop that this make names otherwise (nothing: it has none). May be repeated")
        .type_name("NAME[,KEY=VALUE]...");
    app.add_option("--count", row.count, "so many vehicles more, named by --prefix and a number: LR01, LR02, ...")
        ->check(CLI::Range(std::size_t{1}, MAX_VEHICLES))
        ->type_name("N");
    Apps::AddTextOption(
        app,
        "--prefix",
        [&row](const std::string& text) { return ReadLevel(text, row.prefix); },
        "how the names of --count begin")
        .default_str(row.prefix);
    Apps::AddTextOption(
        app,
        "--type",
        [&row](const std::string& text) {
            return Read(ParseVehicleType(text), [&row](EVehicleType type) {
                row.type = type;
                return std::string();
            });
        },
        "the type of the vehicles of --count: LR or CR")
        .default_str("LR");
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
        [&options](const std::string& text) {
            return Read(ParseProtocol(text), [&options](VDA5050::EVda5050Version version) {
                options.version = version;
                return std::string();
            });
        },
        "VDA5050 version: 2.0.0 or 2.1.0")
        .default_str("2.0.0");
    Apps::AddTimeScaleOption(app, options.timeScale);
    Apps::AddRepeatedOption(
        app,
        "--action-time",
        [&options](const std::string& text) { return ReadActionTime(text, options.actionSeconds); },
        "how long the actions of a type take, in simulated time; else pick and drop 3 s, waitForTrigger until it is "
        "triggered, others 1 s. May be repeated")
        .type_name("ACTIONTYPE=DURATION");
    app.add_flag(
        "--lenient-parameters",
        options.bLenientParameters,
        "accept parameters of actions that the factsheet does not list, and report them (WARNING unlistedParameter in "
        "the state, log); also numbers and booleans as text. By default orders with either are refused");
    Apps::AddFaultOptions(
        app,
        GetFaultGrammar(),
        options.faults,
        "what goes wrong, see below; its time counts from when the vehicle is online. May be repeated");
    CLI::Option& controlTopic = Apps::AddTextOption(
        app,
        "--control-topic",
        [&options](const std::string& text) { return ReadControlTopic(text, options.controlTopic); },
        "where faults are taken from while the vehicles run; answers come on TOPIC/result");
    controlTopic.default_str(options.controlTopic);
    bool bNoControl = false;
    app.add_flag("--no-control", bNoControl, "takes no faults from the broker")->excludes(&controlTopic);
    Apps::AddTextOption(
        app,
        "--seed",
        [&options](const std::string& text) { return ReadSeed(text, options.seed); },
        "the same losses and delays each time; by default other ones, see the log")
        .type_name("N");
    Apps::AddCommonOptions(app, options.common);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCode.has_value())
    {
        return exitCode;
    }
    options.controlTopic = bNoControl ? std::string() : options.controlTopic;
    std::string mistake = CheckBrokerOptions(options.link, options.broker.scheme);
    mistake = mistake.empty() ? AddVehicles(row, options.vehicles) : mistake;
    mistake = mistake.empty() ? CheckWorld(options) : mistake;
    mistake = mistake.empty() ? CheckFaults(options.faults, options.vehicles) : mistake;
    if (!mistake.empty())
    {
        Apps::PrintError(PROGRAM, mistake);
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    return std::nullopt;
}

tl::expected<Planning::SiteMap, std::string> LoadSite(const std::string& path)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return tl::make_unexpected(
            fmt::format("the site {} cannot be read ({}); give the path of a LIF file", path, text.error()));
    }
    Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(*text);
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
    const auto& nodes = site.GetNodes();
    return charger != nullptr ? charger->nodeIDs.front() : nodes[index % nodes.size()].nodeID;
}

} // namespace ACS::VdaSim
