#include "AcsdConfig.hpp"

#include "common/TextFile.hpp"
#include "RobotHost.hpp"
#include <acs/core/Location.hpp>
#include <acs/plan/LifReader.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>
#include <acs/vda5050/Topic.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;
using Apps::EUrlScheme;

constexpr std::int64_t HIGHEST_PROGRAM = 9999;
constexpr std::int64_t HIGHEST_RELAY_BYTE = 65'535;
constexpr std::int64_t HIGHEST_WORD_INDEX = 255;
constexpr std::int64_t MOST_BASE_NODES = 1'000;
constexpr double MOST_CLEARANCE = 100;
constexpr std::int64_t FULL_BATTERY = 100;
constexpr std::int64_t MOST_PLANS = 100'000;
constexpr std::int64_t FEWEST_REPORTS = 100;
constexpr std::int64_t MOST_REPORTS = 10'000'000;

/// Ranges such as "A01.CP01.TP01-04"; in front of each the prefix ("LR01." for ports of a robot).
std::vector<Core::Location> ReadPlaces(const ConfigSection& section, const std::string& key, const std::string& prefix)
{
    std::vector<Core::Location> places;
    std::string mistakes;
    for (const std::string& text : section.GetStringList(key))
    {
        Core::Result<std::vector<Core::Location>> range = Core::ParseLocationRange(prefix + text);
        if (!range)
        {
            const std::string_view joint = mistakes.empty() ? "" : "; ";
            mistakes += fmt::format("{}\"{}\": {}", joint, text, Core::Describe(range.error()));
            continue;
        }
        std::ranges::move(*range, std::back_inserter(places));
    }
    if (!mistakes.empty())
    {
        section.AddMistake(key, mistakes);
    }
    return places;
}

/// Ports that stand twice, and places inside carriers on ports that the robot does not have.
void CheckPorts(const ConfigSection& section, const Planning::RobotOptions& robot)
{
    std::set<std::string_view> seen;
    for (const auto& [key, places] : {std::pair("ports", &robot.ports), std::pair("child_ports", &robot.childPorts)})
    {
        for (const Core::Location& place : *places)
        {
            if (!seen.insert(place.GetText()).second)
            {
                section.AddMistake(key, fmt::format("{} stands there twice", place.GetText()));
            }
        }
    }
    for (const Core::Location& child : robot.childPorts)
    {
        const std::string_view text = child.GetText();
        const std::string_view carrier = text.substr(0, text.rfind('.'));
        if (std::ranges::find(robot.ports, carrier, &Core::Location::GetText) == robot.ports.end())
        {
            section.AddMistake("child_ports", fmt::format("{} is in {}, which is none of its ports", text, carrier));
        }
    }
}

Planning::ERobotType ReadRobotType(const ConfigSection& section, const std::string& key)
{
    return section.GetWord(key, {"LR", "CR"}) == "CR" ? Planning::ERobotType::CR : Planning::ERobotType::LR;
}

using CounterWord = std::pair<std::string, std::size_t>;

/// A job would be told done when it begins.
void RefuseSharedWord(const ConfigSection& arm, const CounterWord& first, const CounterWord& second)
{
    if (first.second == second.second)
    {
        // Of the two the one that is given: the other may be the default.
        const bool bSecond = arm.HasKey(second.first);
        arm.AddMistake(
            bSecond ? second.first : first.first,
            fmt::format(
                "is {}, as arm.{} is: each counter needs a word of its own",
                first.second,
                bSecond ? first.first : second.first));
    }
}

void ReadArm(const ConfigSection& root, AcsdConfig& config)
{
    const ConfigSection arm = root.GetSection("arm");
    ArmOptions& counters = config.arm;
    const auto readIndex = [&arm](const std::string& key, std::size_t fallback) {
        return static_cast<std::size_t>(
            arm.GetInteger(key, 0, HIGHEST_WORD_INDEX, static_cast<std::int64_t>(fallback)));
    };
    counters.monitorUrl = arm.GetString("monitor_url", counters.monitorUrl);
    counters.firstByte =
        static_cast<std::uint32_t>(arm.GetInteger("monitor_start", 0, HIGHEST_RELAY_BYTE, counters.firstByte));
    counters.period = arm.GetDuration("monitor_period", 2ms, 30s, counters.period);
    counters.startedIndex = readIndex("counter_started", counters.startedIndex);
    counters.finishedIndex = readIndex("counter_finished", counters.finishedIndex);
    counters.failedIndex = readIndex("counter_failed", counters.failedIndex);
    RefuseSharedWord(arm, {"counter_started", counters.startedIndex}, {"counter_finished", counters.finishedIndex});
    RefuseSharedWord(arm, {"counter_started", counters.startedIndex}, {"counter_failed", counters.failedIndex});
    RefuseSharedWord(arm, {"counter_finished", counters.finishedIndex}, {"counter_failed", counters.failedIndex});
}

void ReadSite(const ConfigSection& root, const std::string& fileName, AcsdConfig& config)
{
    const ConfigSection section = root.GetSection("site");
    const std::string map = section.GetString("map");
    config.siteFile = ResolvePath(fileName, map);
    config.engine.places = ReadPlaces(section, "ports", "");
    const std::string zone = section.GetString("timezone", "system");
    const Core::Result<Apps::LocalOffset> offset = Apps::LocalOffset::Parse(zone);
    if (offset)
    {
        config.localOffset = *offset;
    }
    else
    {
        section.AddMistake("timezone", Core::Describe(offset.error()));
    }
    if (map.empty())
    {
        section.AddMistake("map", "is empty; give the path of a LIF file");
        return;
    }
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(config.siteFile);
    if (!text.has_value())
    {
        section.AddMistake(
            "map",
            fmt::format("{} cannot be read ({}); give the path of a LIF file", config.siteFile, text.error()));
        return;
    }
    Core::Result<Planning::SiteMap> site = Planning::DecodeLif(*text);
    if (site)
    {
        config.site = std::move(*site);
    }
    else
    {
        section.AddMistake(
            "map",
            fmt::format("{} is no LIF layout: {}", config.siteFile, Core::Describe(site.error())));
    }
}

void ReadStore(const ConfigSection& root, const std::string& fileName, bool bStoreInspected, AcsdConfig& config)
{
    const ConfigSection section = root.GetSection("store");
    const std::string path = section.GetString("path");
    config.storeFile = ResolvePath(fileName, path);
    if (path.empty())
    {
        section.AddMistake("path", "is empty; give the path of a file, such as \"acsd.db\"");
    }
    else if (bStoreInspected)
    {
        const Core::Result<Planning::StoreOrigin> origin = Planning::SqlitePlanStore::Inspect(config.storeFile);
        if (!origin.has_value())
        {
            section.AddMistake("path", Core::Describe(origin.error()));
        }
    }
}

std::optional<Apps::Url> ReadArmOrNull(
    const ConfigSection& robot,
    bool bNeeded,
    const std::vector<RobotLinkConfig>& others)
{
    if (!robot.HasKey("arm"))
    {
        if (bNeeded)
        {
            robot.AddMistake("arm", "a CR needs arm.url (tcp://) of its arm's controller");
        }
        return std::nullopt;
    }
    const ConfigSection section = robot.GetSection("arm");
    Apps::Url url = section.GetUrl("url", {EUrlScheme::Tcp});
    const auto twin = std::ranges::find_if(others, [&url](const RobotLinkConfig& other) {
        return other.armOrNone.has_value() && *other.armOrNone == url && !url.peer.host.empty();
    });
    if (twin != others.end())
    {
        section.AddMistake("url", fmt::format("{} has the same: one arm cannot be of two robots", twin->robotID));
    }
    return url;
}

void ReadRobot(const ConfigSection& section, const std::string& name, AcsdConfig& config)
{
    const Core::Result<Core::RobotID> robotID = Core::RobotID::Parse(name);
    if (!robotID)
    {
        section.Refuse(Core::Describe(robotID.error()));
        return;
    }
    Planning::RobotOptions options{*robotID, {}, {}, {}, {}, {}, {}, {}};
    options.type = ReadRobotType(section, "type");
    options.vehicleTypeID = section.GetString("vehicle_type");
    options.startNodeID = section.GetString("start_node");
    options.homeStationID = section.GetStringOrNull("home");
    options.chargingStationID = section.GetStringOrNull("charge");
    options.ports = ReadPlaces(section, "ports", name + ".");
    options.childPorts = ReadPlaces(section, "child_ports", name + ".");
    CheckPorts(section, options);

    RobotLinkConfig link;
    link.robotID = name;
    link.manufacturer = section.GetString("manufacturer");
    link.serialNumber = section.GetString("serial");
    link.protocolVersion = section.GetWord("protocol", {"2.0.0", "2.1.0"}, "2.0.0");
    link.armOrNone = ReadArmOrNull(section, options.type == Planning::ERobotType::CR, config.robots);
    for (const auto& [key, level] :
         {std::pair("manufacturer", link.manufacturer), std::pair("serial", link.serialNumber)})
    {
        if (!VDA5050::IsValidAddress({"uagv", level, level}))
        {
            section.AddMistake(key, "is a level of a topic: not empty, without / + #");
        }
    }
    const auto twin = std::ranges::find_if(config.robots, [&link](const RobotLinkConfig& other) {
        return other.manufacturer == link.manufacturer && other.serialNumber == link.serialNumber;
    });
    if (twin != config.robots.end() && !link.serialNumber.empty())
    {
        section.AddMistake(
            "serial",
            fmt::format("{} has the same manufacturer and serial: one vehicle cannot be two robots", twin->robotID));
    }
    config.engine.robots.push_back(std::move(options));
    config.robots.push_back(std::move(link));
}

/// An action of the document keeps its rules; another one is done at its place without from and to.
void ReadAction(const ConfigSection& section, const std::string& name, AcsdConfig& config)
{
    const Planning::ActionTable standard = Planning::MakeStandardActions();
    const auto known = standard.find(name);
    Planning::ActionRule rule = known == standard.end() ? Planning::ActionRule{} : known->second;
    rule.robotType = ReadRobotType(section, "robot");
    rule.timeout = section.GetDuration("timeout", 0ms, 24h, rule.timeout);

    JobMethod method;
    const bool bVehicle = section.HasKey("vehicle_action");
    const bool bArm = section.HasKey("arm_program");
    if (bVehicle == bArm)
    {
        section.AddMistake("", "needs exactly one of vehicle_action and arm_program");
    }
    if (bVehicle)
    {
        method.vehicleAction = section.GetString("vehicle_action");
    }
    if (bArm)
    {
        method.armProgram = static_cast<std::uint32_t>(section.GetInteger("arm_program", 1, HIGHEST_PROGRAM));
    }
    config.engine.actions.insert_or_assign(name, rule);
    config.methods.insert_or_assign(name, method);
}

void ReadHttp(const ConfigSection& root, AcsdConfig& config)
{
    const ConfigSection http = root.GetSection("http");
    config.httpListen = http.GetEndpoint("listen", config.httpListen);
    config.httpHosts = http.GetStringList("hosts");
    const auto wrong = std::ranges::find_if(config.httpHosts, [](const std::string& name) {
        return !Apps::ParseEndpoint(name + ":0").has_value();
    });
    if (wrong != config.httpHosts.end())
    {
        http.AddMistake(
            "hosts",
            fmt::format(
                R"(expected names without port, such as "acs.example", found {})",
                Core::QuoteForError(*wrong)));
    }
}

void ReadQueue(const ConfigSection& root, Planning::EngineOptions& engine)
{
    const ConfigSection queue = root.GetSection("queue");
    engine.maximumPlans = static_cast<std::size_t>(
        queue.GetInteger("max_plans", 1, MOST_PLANS, static_cast<std::int64_t>(engine.maximumPlans)));
    engine.bLowerPriorityFirst =
        queue.GetWord("priority_order", {"higher_first", "lower_first"}, "higher_first") == "lower_first";
    engine.defaultPriority = static_cast<std::int32_t>(queue.GetInteger(
        "default_priority",
        std::numeric_limits<std::int32_t>::min(),
        std::numeric_limits<std::int32_t>::max(),
        engine.defaultPriority));
    engine.queueAgeing = queue.GetDuration("ageing", 0ms, 24h, engine.queueAgeing);

    const ConfigSection traffic = root.GetSection("traffic");
    engine.clearance = traffic.GetNumber("clearance", 0, MOST_CLEARANCE, engine.clearance);
    engine.baseLength = static_cast<std::size_t>(
        traffic.GetInteger("base_length", 1, MOST_BASE_NODES, static_cast<std::int64_t>(engine.baseLength)));

    const ConfigSection plan = root.GetSection("plan");
    engine.bFinishedIDsReused = plan.IsEnabled("reuse_finished_id", engine.bFinishedIDsReused);
    // The register has these keys; only what stands here is built, and whoever wants the other is told.
    static_cast<void>(plan.GetWord("duplicate", {"fail"}, "fail"));
    if (plan.IsEnabled("allow_mixed_robot_types", false))
    {
        plan.AddMistake("allow_mixed_robot_types", "must be false: one robot does the whole of a plan");
    }

    const ConfigSection locations = root.GetSection("locations");
    static_cast<void>(locations.GetWord("unknown", {"reject"}, "reject"));
    if (locations.HasKey("robot_aliases")
        && locations.GetStringList("robot_aliases") != std::vector<std::string>{"AMR"})
    {
        locations.AddMistake(
            "robot_aliases",
            R"(must be ["AMR"]: the document's own word is the only one that is read)");
    }

    const ConfigSection reports = root.GetSection("reports");
    engine.bInitialPendingReported = reports.IsEnabled("initial_pending", engine.bInitialPendingReported);

    const ConfigSection history = root.GetSection("history");
    engine.finishedPlansKept = static_cast<std::size_t>(
        history.GetInteger("keep", 0, MOST_PLANS, static_cast<std::int64_t>(engine.finishedPlansKept)));

    engine.restartWait = root.GetSection("restart").GetDuration("wait", 0ms, 1h, engine.restartWait);

    const ConfigSection tsc = root.GetSection("tsc");
    engine.bTscStartsPaused = tsc.GetWord("initial", {"auto", "paused"}, "auto") == "paused";
    engine.bTscPausedAcceptsPlans = tsc.IsEnabled("paused_accepts_plans", engine.bTscPausedAcceptsPlans);
}

void ReadDispatch(const ConfigSection& root, Planning::EngineOptions& engine)
{
    const ConfigSection robot = root.GetSection("robot");
    Planning::DispatchOptions& dispatch = engine.dispatch;
    const auto readPercent = [&robot](const std::string& key, double fallback) {
        return static_cast<double>(robot.GetInteger(key, 0, FULL_BATTERY, static_cast<std::int64_t>(fallback)));
    };
    dispatch.batteryFloor = readPercent("battery_floor", dispatch.batteryFloor);
    dispatch.batteryResume = readPercent("battery_resume", dispatch.batteryResume);
    dispatch.bLoadsIntoTakenPorts = robot.GetWord("taken_port", {"wait", "load"}, "wait") == "load";

    engine.stallTimeout = root.GetSection("drive").GetDuration("stall_timeout", 0ms, 24h, engine.stallTimeout);

    const std::string moving =
        root.GetSection("mcs").GetWord("position_while_moving", {"last", "target", "null"}, "last");
    engine.movingPosition = moving == "target"
        ? Planning::EMovingPosition::Target
        : (moving == "null" ? Planning::EMovingPosition::None : Planning::EMovingPosition::Last);
}

/// Register D-14 to D-22.
void ReadControls(const ConfigSection& root, Planning::ControlOptions& controls)
{
    const ConfigSection cancel = root.GetSection("cancel");
    const std::string until = cancel.GetWord("until", {"first_arrival", "dispatch", "first_job"}, "first_arrival");
    controls.cancelUntil = until == "dispatch"
        ? Planning::ECancelWindow::Dispatch
        : (until == "first_job" ? Planning::ECancelWindow::FirstJob : Planning::ECancelWindow::FirstArrival);
    controls.cancelTimeout = cancel.GetDuration("confirm_timeout", 1ms, 1h, controls.cancelTimeout);

    const ConfigSection pause = root.GetSection("pause");
    controls.bPausesAfterJob = pause.GetWord("mode", {"immediate", "after_job"}, "immediate") == "after_job";
    controls.pauseTimeout = pause.GetDuration("confirm_timeout", 1ms, 1h, controls.pauseTimeout);

    const ConfigSection abort = root.GetSection("abort");
    controls.bAbortStopsJob = abort.GetWord("running_job", {"finish", "stop"}, "finish") == "stop";
    controls.bAbortFinishesPausedJob = abort.GetWord("paused_job", {"discard", "finish"}, "discard") == "finish";
    controls.bJobFailureFailsAbort = abort.GetWord("job_failure_final", {"Failed", "Aborted"}, "Failed") == "Failed";
    controls.bAbortReportsStep = abort.IsEnabled("report_step", controls.bAbortReportsStep);
    controls.jobEndTimeout = abort.GetDuration("end_timeout", 1ms, 24h, controls.jobEndTimeout);

    controls.bResultAfterRefusal =
        root.GetSection("mcs").IsEnabled("result_after_fail_ack", controls.bResultAfterRefusal);
}

void ReadTables(const ConfigSection& root, AcsdConfig& config)
{
    const ConfigSection robots = root.GetSection("robots");
    for (const std::string& name : robots.GetNames())
    {
        ReadRobot(robots.GetSection(name), name, config);
    }
    if (config.robots.empty())
    {
        root.AddMistake("robots", "needs at least one table, such as [robots.LR01]");
    }
    const ConfigSection actions = root.GetSection("actions");
    config.engine.actions.clear();
    for (const std::string& name : actions.GetNames())
    {
        ReadAction(actions.GetSection(name), name, config);
    }
    if (config.engine.actions.empty())
    {
        root.AddMistake("actions", "needs at least one table, such as [actions.CassetteLoad]: no plan could be done");
    }
}

/// What a robot cannot do is not given to it. An action that nobody can do would only be noticed by the first plan.
void RejectActions(const ConfigSection& root, AcsdConfig& config)
{
    std::map<std::string, std::string> objections; ///< Of the first robot.
    std::set<std::string> possible;
    for (std::size_t i = 0; i < config.robots.size(); ++i)
    {
        Planning::RobotOptions& robot = config.engine.robots[i];
        robot.rejectedActions = RobotHost::FindRejectedActions(config, config.robots[i], robot.type);
        for (const auto& [name, rule] : config.engine.actions)
        {
            const auto rejected = robot.rejectedActions.find(name);
            if (rejected != robot.rejectedActions.end())
            {
                objections.try_emplace(name, fmt::format("{}: {}", robot.robotID.GetText(), rejected->second));
            }
            else if (rule.robotType == robot.type)
            {
                possible.insert(name);
            }
        }
    }
    for (const auto& [name, objection] : objections)
    {
        if (!possible.contains(name))
        {
            root.GetSection("actions").GetSection(name).AddMistake(
                "",
                fmt::format(
                    "no robot can do it, {}; give arm_program for robots with an arm, vehicle_action for those without",
                    objection));
        }
    }
}

} // namespace

namespace
{

AcsdConfig Read(const std::string& fileName, const std::vector<std::string>& overrides, bool bStoreInspected)
{
    AcsdConfig config;
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadFile(fileName, overrides);
    const ConfigSection root = reader.GetRoot();
    std::vector<std::string> otherMistakes;
    ReadMcsConfig(root, fileName, config.mcs, otherMistakes);
    ReadOperationsConfig(root, config.operations);
    ReadMqttConfig(root, fileName, config.mqtt, config.warnings);
    ReadArm(root, config);
    ReadSite(root, fileName, config);
    ReadStore(root, fileName, bStoreInspected, config);
    ReadHttp(root, config);
    ReadQueue(root, config.engine);
    ReadControls(root, config.engine.controls);
    ReadDispatch(root, config.engine);
    config.engine.maximumReports = static_cast<std::size_t>(
        root.GetSection("outbox")
            .GetInteger("max", FEWEST_REPORTS, MOST_REPORTS, static_cast<std::int64_t>(config.engine.maximumReports)));
    ReadTables(root, config);
    if (reader.GetMistakes().empty())
    {
        RejectActions(root, config);
    }
    if (reader.GetMistakes().empty() && config.site.has_value())
    {
        for (Core::Error& error : Planning::FindMistakes(config.engine, *config.site))
        {
            const std::string path = std::exchange(error.path, {});
            reader.AddMistake(path, Core::Describe(error));
        }
    }
    config.mistakes = reader.GetMistakes();
    std::ranges::move(otherMistakes, std::back_inserter(config.mistakes));
    config.values = reader.GetValues();
    return config;
}

} // namespace

AcsdConfig ReadAcsdConfig(const std::string& fileName, const std::vector<std::string>& overrides)
{
    return Read(fileName, overrides, false);
}

AcsdConfig CheckAcsdConfig(const std::string& fileName, const std::vector<std::string>& overrides)
{
    return Read(fileName, overrides, true);
}

} // namespace ACS::Acsd
