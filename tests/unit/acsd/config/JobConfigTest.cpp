#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "config/ExampleSite.hpp"
#include "robots/ArmInputs.hpp"
#include "robots/VehicleParameters.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

using Planning::EActionEffect;
using Planning::EPlaceRule;

/// The example site with these keys on top.
Acsd::AcsdConfig ReadJobs(const std::vector<std::string>& overrides)
{
    return Acsd::ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

Planning::StartJob MakeJob(
    const std::string& action,
    const std::string& position,
    const std::string& from = {},
    const std::string& to = {})
{
    Planning::StartJob job;
    job.jobID = "J";
    job.action = action;
    job.position = position;
    job.from = from.empty() ? std::nullopt : std::optional(from);
    job.to = to.empty() ? std::nullopt : std::optional(to);
    job.carrierID = "C1";
    job.jobNumber = 77;
    return job;
}

/// "ml105=77 ml106=1"
std::string MakeInputs(const Acsd::AcsdConfig& config, const Planning::StartJob& job)
{
    const auto inputs = Acsd::MakeArmInputs(Acsd::Test::FindVehicle(config, "CR01").methods, job);
    if (!inputs.has_value())
    {
        return inputs.error();
    }
    std::string text;
    for (const Acsd::ArmInput& input : *inputs)
    {
        text += (text.empty() ? "" : " ") + input.relay.name + "=" + std::to_string(input.value);
    }
    return text;
}

/// "pick lhd="CP01"", without a factsheet.
std::string MakeAction(
    const Acsd::AcsdConfig& config,
    const Planning::StartJob& job,
    const std::string& robotID = "LR01")
{
    const Acsd::JobMethods& methods = Acsd::Test::FindVehicle(config, robotID).methods;
    const Acsd::JobData data = methods.MakeData(job);
    const Acsd::JobMethod& method = *methods.FindMethodOrNull(job.action, data);
    std::string text = method.vehicleAction;
    const auto parameters = Acsd::MakeActionParameters(method, data, nullptr);
    REQUIRE(parameters.has_value());
    for (const VDA5050::ActionParameter& parameter : *parameters)
    {
        text += " " + parameter.key + "=" + parameter.value.GetText();
    }
    return text;
}

const std::string SECOND_ROBOT = "robots.LR02={type='LR', manufacturer='B', serial='LR02', vehicle_type='lr-base', "
                                 "start_node='N001', ports=['CP01-02'], ";

/// The one error, without the place that it comes from.
std::string FindError(const std::vector<std::string>& overrides)
{
    const std::vector<std::string> errors = ReadJobs(overrides).errors;
    if (errors.size() != 1)
    {
        return std::to_string(errors.size()) + " errors";
    }
    return errors[0].substr(errors[0].find(": ") + 2);
}

} // namespace

TEST_CASE("The example site sends each arm's program the places from which and to which it moves the carrier")
{
    const Acsd::AcsdConfig config = ReadJobs({});
    REQUIRE(config.errors == std::vector<std::string>{});
    CHECK(
        MakeInputs(config, MakeJob("TrayLoad", "A01.CP02", "A01.CP02.TP03", "CR01.TP02"))
        == "ml105=77 ml106=1 ml107=2 ml108=3 ml109=2");
    CHECK(
        MakeInputs(config, MakeJob("TrayUnload", "A02.CP06", "CR01.TP01", "A02.CP06.TP04"))
        == "ml105=77 ml106=2 ml107=6 ml108=4 ml109=1");
    CHECK(
        MakeInputs(config, MakeJob("MemoryPickAndPlace", "A01.SET02", "CR01.TP01.MP03", "A01.SET02.MP15"))
        == "ml105=77 ml106=0 ml107=0 ml108=1 ml109=3 ml112=1 ml113=2 ml114=0 ml115=15");
    CHECK(
        MakeInputs(config, MakeJob("MemoryPickAndPlace", "A01.SET02", "A01.SET02.MP15", "CR01.TP01.MP03"))
        == "ml105=77 ml106=1 ml107=2 ml108=0 ml109=15 ml112=0 ml113=0 ml114=1 ml115=3");
    for (const std::string action : {"OpenSetCover", "CloseSetCover", "Start"})
    {
        CHECK(MakeInputs(config, MakeJob(action, "A02.SET12")) == "ml105=77 ml106=2 ml107=12");
    }
}

TEST_CASE("The example site's pick and drop have the job's own place and the robot's port, as they have by default")
{
    const std::string load =
        R"(pick height=0.8 lhd="CP01" loadId="C1" loadType="cassette" stationName="A01.CP01" stationType="rack")";
    CHECK(MakeAction(ReadJobs({}), MakeJob("CassetteLoad", "A01.CP01", "A01.CP01", "LR01.CP01")) == load);
    CHECK(
        MakeAction(ReadJobs({}), MakeJob("CassetteUnload", "A01.CP02", "LR01.CP01", "A01.CP02"))
        == R"(drop lhd="CP01" loadId="C1" loadType="cassette" stationName="A01.CP02" stationType="rack")");
}

TEST_CASE("Two makes of robot do one action in two ways, and a station has a third way")
{
    const Acsd::AcsdConfig config = ReadJobs(
        {SECOND_ROBOT
             + "load_positions={CP01='front', CP02='rear'}, actions.CassetteLoad={vehicle_action='liftCassette', "
               "parameters={rack='{place}', level=2, fork='{robot_port}'}}, "
               "actions.CassetteUnload.vehicle_action='lowerCassette'}",
         R"(stations."A01.CP02".actions.CassetteLoad.parameters={belt="{station.lane}"})",
         R"(stations."A01.CP02".lane=4)"});
    REQUIRE(config.errors == std::vector<std::string>{});
    const auto load = [](const std::string& place, const std::string& port) {
        return MakeJob("CassetteLoad", place, place, port);
    };
    CHECK(
        MakeAction(config, load("A01.CP03", "LR02.CP02"), "LR02")
        == R"(liftCassette fork="rear" level=2 rack="A01.CP03")");
    CHECK(MakeAction(config, load("A01.CP03", "LR01.CP01")).starts_with("pick lhd="));
    CHECK(
        MakeAction(config, load("A01.CP02", "LR02.CP02"), "LR02")
        == "liftCassette belt=4"); // tables are replaced whole
    CHECK(MakeAction(config, load("A01.CP02", "LR01.CP01")) == "pick belt=4");
    // The parameters of the table before it stay, as only the named key is replaced.
    CHECK(MakeAction(config, MakeJob("CassetteUnload", "A01.CP03", "LR02.CP01", "A01.CP03"), "LR02")
              .starts_with(R"(lowerCassette lhd="front")"));
}

TEST_CASE("A robot's own arm_program keeps the inputs, and the other way round")
{
    const Acsd::AcsdConfig config = ReadJobs(
        {"robots.CR01.actions.TrayLoad.arm_program=21", "robots.CR01.actions.TrayUnload.arm_inputs={ml120=5}"});
    REQUIRE(config.errors == std::vector<std::string>{});
    const Acsd::JobMethods& methods = Acsd::Test::FindVehicle(config, "CR01").methods;
    CHECK(methods.FindMethodOrNull("TrayLoad")->armProgram == 21);
    CHECK(methods.FindMethodOrNull("TrayLoad")->armInputs.size() == 5);
    CHECK(methods.FindMethodOrNull("TrayUnload")->armProgram == 13);
    CHECK(MakeInputs(config, MakeJob("TrayUnload", "A01.CP01", "CR01.TP01", "A01.CP01.TP01")) == "ml120=5");
}

TEST_CASE("A robot's arm has keys of its own, and those of the table arm for the rest")
{
    const Acsd::AcsdConfig config = ReadJobs(
        {"arm.counter_echo=-1",
         "arm.input_timeout=3s",
         "arm.input_retries=4",
         "robots.CR01.arm.counter_echo=6",
         "robots.CR01.arm.monitor_start=800"});
    REQUIRE(config.errors == std::vector<std::string>{});
    CHECK_FALSE(config.arm.echoIndex.has_value());
    CHECK(config.arm.firstByte == 400);
    const Acsd::ArmOptions& arm = Acsd::Test::FindVehicle(config, "CR01").armOptions;
    CHECK(arm.echoIndex == 6U);
    CHECK(arm.firstByte == 800);
    CHECK(arm.inputTimeout == std::chrono::seconds(3));
    CHECK(arm.inputRetries == 4);
    CHECK(ReadJobs({}).arm.echoIndex == 4U);
}

TEST_CASE("The numbers of relays count values, or bytes as in the vendor's manual; relays must not share bytes")
{
    const std::string tray = "actions.TrayLoad.arm_inputs";
    const Acsd::AcsdConfig overlapping = ReadJobs({"arm.relay_index=byte"});
    REQUIRE_FALSE(overlapping.errors.empty());
    CHECK(overlapping.errors.front().find("ml106: shares bytes with ml105") != std::string::npos);
    const Acsd::AcsdConfig counter = ReadJobs({"arm.relay_index=byte", tray + "={ml400=1}"});
    CHECK(std::ranges::any_of(counter.errors, [](const std::string& error) {
        return error.find("ml400: this relay holds a job counter of the arm of CR01") != std::string::npos;
    }));
    CHECK(ReadJobs({tray + "={ml105='{job_number}', m3360=1}"}).errors.size() == 1);
    for (const char* const other : {"ml120", "ml2000", "sl105"})
    {
        CHECK(ReadJobs({tray + "={ml105='{job_number}', " + other + "=1}"}).errors.empty());
    }
    CHECK(ReadJobs({"arm.relay_index=word"}).errors.size() == 1);
    CHECK(ReadJobs({"robots.CR01.arm.relay_index=byte"}).errors.size() == 1);
}

TEST_CASE("Inputs without the job's number cause a warning if the arm's programs echo it")
{
    const std::string tray = "actions.TrayLoad.arm_inputs";
    const std::string own = "robots.CR01." + tray;
    const auto read = [](const std::vector<std::string>& overrides) {
        const Acsd::AcsdConfig config = ReadJobs(overrides);
        CHECK(config.errors == std::vector<std::string>{});
        return config.warnings;
    };
    CHECK(read({}).empty());
    const std::vector<std::string> warnings = read({tray + ".ml105=5"});
    REQUIRE(warnings.size() == 1);
    CHECK(warnings.front().starts_with(tray + ": has no {job_number}"));
    CHECK(read({own + "={ml120=5}"}).size() == 1);
    CHECK(read({R"(stations."A01.CP01".)" + tray + "={ml120=5}"}).size() == 1);
    CHECK(read({tray + ".ml105=5", own + "={ml120=5, ml105='{job_number}'}"}).empty());
    CHECK(read({tray + ".ml105=5", "arm.counter_echo=-1"}).empty());
    CHECK(read({tray + ".ml105=5", "robots.CR01.arm.counter_echo=-1"}).empty());
    CHECK(read({"actions.Wave={robot='CR', arm_program=30}"}).empty());
}

TEST_CASE("Stations have a type, a height, a reach and keys of their own")
{
    const Acsd::AcsdConfig config = ReadJobs(
        {R"(stations."A01.CP01".reach=["A01.CP02", "A01.CP03"])",
         R"(stations."A01.CP01".side="left")",
         R"(stations."A01.CP01".lit=true)",
         "robot.load_timeout=4s"});
    REQUIRE(config.errors == std::vector<std::string>{});
    CHECK(config.engine.reach.at("A01.CP01") == std::vector<std::string>{"A01.CP02", "A01.CP03"});
    CHECK(config.engine.reach.size() == 1);
    CHECK(config.stations->at("A01.CP01").at("side") == Acsd::JobValue(std::string("left")));
    CHECK(config.stations->at("A01.CP01").at("lit") == Acsd::JobValue(true));
    CHECK(config.stations->at("A01.CP02").at("type") == Acsd::JobValue(std::string("rack")));
    CHECK_FALSE(config.stations->at("A01.CP02").contains("height"));
    CHECK(config.operations.loadTimeout == std::chrono::seconds(4));
    CHECK(ReadJobs({}).operations.loadTimeout == std::chrono::seconds(10));
}

TEST_CASE("4.1 An action that MCS-ACS does not define has keys for its places and its effect on the ports")
{
    const auto read = [](const std::string& keys) {
        return ReadJobs({"actions.Shift={robot='CR', arm_program=30, " + keys + "}"});
    };
    const Acsd::AcsdConfig config = read("from='robot_tp', to='fixed_tp', effect='unload'");
    REQUIRE(config.errors == std::vector<std::string>{});
    const Planning::ActionRule& rule = config.engine.actions.at("Shift");
    CHECK(rule.from == EPlaceRule::RobotTray);
    CHECK(rule.to == EPlaceRule::FixedTray);
    CHECK(rule.effect == EActionEffect::Unload);
    CHECK(rule.bJobsRequired);
    CHECK(Acsd::Test::FindVehicle(config, "CR01").methods.FindMethodOrNull("Shift")->effect == EActionEffect::Unload);
    const Acsd::AcsdConfig plain = read("timeout='1m'");
    CHECK(plain.engine.actions.at("Shift").from == EPlaceRule::None);
    CHECK_FALSE(plain.engine.actions.at("Shift").bJobsRequired);
    CHECK(read("from='mp', to='mp', effect='none'").errors.empty());
    CHECK(read("from='robot_cp', to='fixed_cp', effect='move'").errors.empty());
    CHECK(
        read("from='fixed_tp', to='robot_tp', effect='load'").engine.actions.at("Shift").effect == EActionEffect::Load);
}

TEST_CASE("An invalid configuration of jobs is reported under its key")
{
    struct Row
    {
        std::vector<std::string> overrides;
        std::string error; ///< How it begins.
    };
    const std::string load = "actions.CassetteLoad.parameters";
    const std::string tray = "actions.TrayLoad.arm_inputs";
    const std::vector<Row> rows{
        {{load + ".a='{form}'"}, load + ".a: unknown name \"form\""},
        {{load + ".a='{from'"}, load + ".a: unmatched brace at character 1"},
        {{load + ".a='{from.tp}'"}, load + ".a: no job of this action has {from.tp}: its from is a cassette port"},
        {{load + ".a='{station.lane}'"}, load + ".a: {station.lane}: no station has a key \"lane\""},
        {{load + ".a={b=['{station.lane}']}"}, load + ".a: {station.lane}: no station"},
        {{load + ".a=2026-01-01"}, load + ".a: expected a string, number, boolean, table or list"},
        {{load + "=7"}, load + ": expected a table"},
        {{tray + ".ml99999=1"}, tray + ".ml99999: ml99999 is not a relay that can be read back"},
        {{tray + ".q1=1"}, tray + ".q1: q1 is not a relay"},
        {{tray + ".mb500=256"}, tray + ".mb500: mb500 cannot hold 256; it holds -128 to 255"},
        {{tray + ".m100=2"}, tray + ".m100: m100 cannot hold 2; it holds 0 to 1"},
        {{tray + ".mw300='{job_number}'"},
         tray + ".mw300: mw300 cannot hold 2147483647, the highest {job_number}; it holds -32768 to 65535"},
        {{tray + ".m4000='{from.area}'"}, tray + ".m4000: m4000 cannot hold 2, the highest {from.area}"},
        {{tray + ".ml120='{from.set}'"},
         tray + ".ml120: no job of this action has {from.set}: its from is a tray port"},
        {{tray + ".ml120='{to.area}'"},
         tray + ".ml120: no job of this action has {to.area}: its to is a tray port of the"},
        {{tray + ".ml120='{position.tp}'"}, tray + ".ml120: no station has {position.tp}"},
        {{tray + ".ml120='{carrier}'"}, tray + ".ml120: {carrier} is not a number"},
        {{tray + ".ml120='{station.height}'"},
         tray + ".ml120: {station.height} is not a whole number at station A01.CP01"},
        {{tray + ".ml120=1.5"}, tray + ".ml120: expected a whole number"},
        {{tray + ".ml101=1"}, tray + ".ml101: this relay holds a job counter of the arm of CR01 (bytes 404 to 407)"},
        {{tray + ".mb419=1"}, tray + ".mb419: this relay holds a job counter of the arm of CR01"},
        {{"actions.OpenSetCover.arm_inputs.ml120='{robot_port}'"},
         "actions.OpenSetCover.arm_inputs.ml120: no job of this action has {robot_port}"},
        {{"actions.OpenSetCover.arm_inputs.ml120='{from.set}'"},
         "actions.OpenSetCover.arm_inputs.ml120: no job of this action has {from.set}: its from is none"},
        {{"actions.TrayLoad.parameters={}"}, "actions.TrayLoad: has keys of a vehicle"},
        {{"actions.CassetteLoad.vehicle_action="}, "actions.CassetteLoad.vehicle_action: is empty"},
        {{"actions.CassetteLoad.from=fixed_cp"}, "actions.CassetteLoad.from: MCS-ACS fixes it"},
        {{"actions.X={robot='CR', arm_program=1, effect='load'}"}, "actions.X.effect: load needs to"},
        {{"actions.X={robot='CR', arm_program=1, effect='unload', from='mp'}"}, "actions.X.effect: unload needs from"},
        {{"actions.X={robot='CR', arm_program=1, effect='move'}"}, "actions.X.effect: move needs from or to"},
        {{"actions.X={robot='CR', arm_program=1, from='here'}"}, "actions.X.from: expected 'none' or 'fixed_cp'"},
        {{"robots.LR01.actions.Jump.vehicle_action=x"},
         "robots.LR01.actions.Jump: expected an action of the table actions"},
        {{"robots.LR01.actions.Start.arm_program=2"},
         "robots.LR01.actions.Start: actions.Start.robot gives the action to"},
        {{"robots.LR01.actions.CassetteLoad.speed=2"}, "robots.LR01.actions.CassetteLoad.speed: unknown key"},
        {{"robots.LR01.load_positions.CP02=x"}, "robots.LR01.load_positions.CP02: expected a port of this robot"},
        {{"robots.LR01.load_positions.CP01="}, "robots.LR01.load_positions.CP01: expected a port of this robot"},
        {{R"(robots.LR01.ports=["CP01-02"])", "robots.LR01.load_positions.CP01=CP02"},
         "robots.LR01.load_positions.CP01: is CP02, which another port uses already"},
        {{"robots.CR01.arm.counter_echo=256"}, "robots.CR01.arm.counter_echo: expected an integer from -1 to 255"},
        {{R"(stations."A01.CP01".reach=["A09.CP01"])"},
         R"(stations."A01.CP01".reach: expected other stations of the site map, found "A09.CP01")"},
        {{R"(stations."A01.CP01".reach=["A01.CP01"])"}, R"(stations."A01.CP01".reach: expected other stations)"},
        {{R"(stations."A01.CP01".reach=["A01.CP02", "A01.CP03", "A01.CP02"])"},
         R"(stations."A01.CP01".reach: A01.CP02 is listed twice)"},
        {{R"(stations."A09.CP01".type="rack")"}, R"(stations."A09.CP01": expected a station of the site map)"},
        {{R"(stations."A01.CP01".height="high")"}, R"(stations."A01.CP01".height: expected a number)"},
        {{R"(stations."A01.CP01".lane=[1])"}, R"(stations."A01.CP01".lane: expected a string, a number or a boolean)"},
        {{R"(stations."A01.CP01".actions.TrayLoad.vehicle_action="x")"},
         R"(stations."A01.CP01".actions.TrayLoad: expected keys of the same kind as in actions.TrayLoad)"},
        {{R"(stations."A01.CP01".actions.TrayLoad.arm_inputs.ml100=1)"},
         R"(stations."A01.CP01".actions.TrayLoad.arm_inputs.ml100: this relay holds a job counter)"},
        {{"robot.load_timeout=2h"}, "robot.load_timeout: expected a duration"}};
    for (const Row& row : rows)
    {
        INFO(row.overrides.front());
        INFO(row.error);
        const std::string error = FindError(row.overrides);
        INFO(error);
        CHECK(error.starts_with(row.error));
    }
}

TEST_CASE("An error in a template has file and line")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ifstream from(std::string(ACS_SITE) + "/acsd.toml");
    std::ofstream to(file);
    std::size_t line = 0;
    for (std::string text; std::getline(from, text) && !text.starts_with("arm_inputs"); ++line)
    {
        to << text << '\n';
    }
    to << "arm_inputs = { ml105 = \"{x}\" }\n";
    to.close();
    const auto errors = Acsd::ReadAcsdConfig(file, {"site.map=" + std::string(ACS_SITE) + "/site.lif.json"}).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].starts_with(
        file + ":" + std::to_string(line + 1) + R"(: actions.TrayLoad.arm_inputs.ml105: unknown name "x"; known are)"));
}

TEST_CASE("A parameter that no station has a value for is left to the vehicle's factsheet and to each plan")
{
    CHECK(ReadJobs({"actions.CassetteLoad.parameters.stationType='{station.side}'"}).errors.empty());
}
