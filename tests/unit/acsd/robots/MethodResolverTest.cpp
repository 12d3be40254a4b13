#include "robots/MethodResolver.hpp"

#include "Catch.hpp"
#include "config/ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// The example site with the numbers of its relays as bytes: ml420 for ml105.
void WriteWithByteNumbers(const std::string& file)
{
    std::ifstream from(std::string(ACS_SITE) + "/acsd.toml");
    std::ofstream to(file);
    for (std::string text; std::getline(from, text);)
    {
        const bool bInputs = text.starts_with("arm_inputs");
        for (std::size_t at = text.find("ml1"); bInputs && at != std::string::npos; at = text.find("ml1", at + 1))
        {
            text.replace(at + 2, 3, std::to_string(std::stoi(text.substr(at + 2, 3)) * 4));
        }
        to << text << '\n';
    }
}

} // namespace

TEST_CASE("An override that takes an action from its robot is an error, also where another robot can do it")
{
    const std::string load = "actions.CassetteLoad";
    CheckErrors({
        {{SECOND_VEHICLE + load + ".arm_program=5}"},
         "robots.LR02.actions.CassetteLoad.arm_program: LR02 cannot do CassetteLoad with it: the vehicle has no action for "
         "CassetteLoad; give vehicle_action, because LR02 has no arm"},
        {{SECOND_VEHICLE + load + ".arm_inputs={ml120=1}}"},
         "robots.LR02.actions.CassetteLoad.arm_inputs: LR02 cannot do CassetteLoad with it"},
        {{"robots.LR01.actions.CassetteLoad={arm_program=5, arm_inputs={ml120=1}}"},
         "robots.LR01.actions.CassetteLoad.arm_program: LR01 cannot do CassetteLoad with it"},
        {{SECOND_ARM + "actions.TrayLoad.vehicle_action='pick'}"},
         "robots.CR02.actions.TrayLoad.vehicle_action: CR02 cannot do TrayLoad with it: the arm has no program for TrayLoad; "
         "give arm_program, because CR02 has an arm"},
        {{SECOND_ARM + "actions.TrayLoad.parameters={a=1}}"},
         "robots.CR02.actions.TrayLoad.parameters: CR02 cannot do TrayLoad with it"},
        {{"robots.CR01.actions.TrayLoad.parameters={}"},
         "robots.CR01.actions.TrayLoad.parameters: CR01 cannot do TrayLoad with it"},
        // One error for each cause.
        {{"robots.CR01.actions.TrayLoad={vehicle_action='pick', arm_program=5}"},
         "robots.CR01.actions.TrayLoad: has keys of a vehicle"},
        {{"robots.LR01.actions.CassetteLoad.vehicle_action="},
         "robots.LR01.actions.CassetteLoad.vehicle_action: is empty"},
    });
}

TEST_CASE("An override's error has the file and the line of its key")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ifstream from(std::string(ACS_SITE) + "/acsd.toml");
    std::ofstream to(file);
    std::size_t lines = 0;
    for (std::string text; std::getline(from, text); ++lines)
    {
        to << text << '\n';
    }
    to << "[robots.CR01.actions.TrayLoad]\nvehicle_action = 'pick'\n";
    to.close();
    const auto errors = ReadAcsdConfig(file, {"site.map=" + std::string(ACS_SITE) + "/site.lif.json"}).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].starts_with(
        file + ":" + std::to_string(lines + 2)
        + ": robots.CR01.actions.TrayLoad.vehicle_action: CR01 cannot do TrayLoad with it"));
}

TEST_CASE("An action of the site that no robot can do is reported at the key of its method")
{
    CheckErrors({
        {{"actions.X={robot='LR', arm_program=5}"},
         "actions.X.arm_program: no robot can do it, LR01: the vehicle has no action for X; give vehicle_action, because LR01 "
         "has no arm"},
        {{"actions.X={robot='CR', vehicle_action='x'}"}, "actions.X.vehicle_action: no robot can do it, CR01: the arm"},
        {{"actions.X={robot='CR'}"}, "actions.X: needs exactly one of vehicle_action and arm_program"},
        {{"actions.X={robot='CR', parameters={}}"}, "actions.X: needs exactly one of"},
    });
    CHECK(ReadSite({"actions.X={robot='LR', arm_program=5}", "robots.LR01.actions.X.vehicle_action=x"}).errors.empty());
}

TEST_CASE("A table of overrides without a key has no effect")
{
    CheckErrors({
        {{"robots.LR01.actions.CassetteLoad={}"},
         "robots.LR01.actions.CassetteLoad: is empty; give vehicle_action, parameters, arm_program or arm_inputs"},
        {{"robots.LR01.actions={}"}, "robots.LR01.actions: is empty; give a table per action"},
        {{R"(stations."A01.CP01".actions.CassetteLoad={})"}, R"(stations."A01.CP01".actions.CassetteLoad: is empty)"},
    });
    CHECK(ReadSite({"robots.LR01.actions.CassetteLoad.parameters={}"}).errors.empty());
}

TEST_CASE("A station's table for an action that has no job there, or that no robot does so, has no effect")
{
    CheckErrors({
        {{R"(stations."A01.SET01".actions.CassetteLoad.vehicle_action="x")"},
         R"(stations."A01.SET01".actions.CassetteLoad: has no effect: CassetteLoad has no job at this station)"},
        {{R"(stations."ST01.CP01".actions.TrayLoad.arm_program=5)"},
         R"(stations."ST01.CP01".actions.TrayLoad: has no effect: TrayLoad has no job)"},
        {{"stations.CHG01.actions.OpenSetCover.arm_program=5"},
         "stations.CHG01.actions.OpenSetCover: has no effect: OpenSetCover has no job"},
        {{"actions.X={robot='LR', arm_program=5}",
          "robots.LR01.actions.X.vehicle_action=x",
          R"(stations."A01.CP01".actions.X.arm_program=6)"},
         R"(stations."A01.CP01".actions.X: has no effect: no robot does X with an arm)"},
    });
    CHECK(
        ReadSite({R"(stations."A01.CP01".actions.TrayLoad.arm_program=5)",
                  R"(stations."ST01.CP01".actions.CassetteLoad.vehicle_action="x")",
                  R"(stations."A01.SET01".actions.MemoryPickAndPlace.arm_program=5)",
                  R"(stations."A01.CP01".actions.MemoryPickAndPlace.arm_program=5)", // from tray to tray of the robot
                  R"(stations."A01.CP01".actions.OpenSetCover.arm_program=5)"})
            .errors
        == std::vector<std::string>{});
    // The robot does it in another way than configured in the table of the action.
    CHECK(
        ReadSite({"actions.X={robot='LR', arm_program=5}",
                  "robots.LR01.actions.X.vehicle_action=x",
                  R"(stations."A01.CP01".actions.X.vehicle_action="y")"})
            .errors
        == std::vector<std::string>{});
}

TEST_CASE("An input that shares a byte with a counter is an error, whatever its width and what its number counts")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    WriteWithByteNumbers(file);
    // Three counters at bytes 402 to 413, the echo at 482 to 485.
    const auto read = [&file](const std::string& relay) {
        return ReadAcsdConfig(
                   file,
                   {"site.map=" + std::string(ACS_SITE) + "/site.lif.json",
                    "arm.relay_index=byte",
                    "arm.monitor_start=402",
                    "arm.counter_echo=20",
                    "robots.CR01.actions.TrayLoad.arm_inputs={" + relay + "=1}"})
            .errors;
    };
    for (const char* const relay :
         {"mb401", "mw400", "ml398", "m3215", "mb414", "ml414", "m3312", "ml478", "mb486", "sl402"})
    {
        INFO(relay);
        CHECK(read(relay) == std::vector<std::string>{});
    }
    for (const char* const relay :
         {"mb402", "mw401", "ml399", "ml401", "m3216", "mb413", "m3311", "mw413", "mw481", "ml485"})
    {
        INFO(relay);
        const std::vector<std::string> errors = read(relay);
        REQUIRE(errors.size() == 1);
        CHECK(
            errors.front().find(
                std::string("arm_inputs.") + relay + ": this relay holds a job counter of the arm of CR01 (bytes 4")
            != std::string::npos);
    }
}

TEST_CASE("The counters are those of each robot's own arm, and the inputs those that it has in the end")
{
    const std::string tray = "actions.TrayLoad.arm_inputs";
    CheckErrors({
        {{SECOND_ARM + "protocol='2.0.0'}", tray + "={ml121=1}"},
         tray + ".ml121: this relay holds a job counter of the arm of CR02 (bytes 484 to 487)"},
        {{SECOND_ARM + "actions.TrayLoad.arm_inputs={ml122=1}}"},
         "robots.CR02.actions.TrayLoad.arm_inputs.ml122: this relay holds a job counter of the arm of CR02"},
        {{"robots.CR01.arm.monitor_url=/project/plc/s/val_s32", "robots.CR01.actions.TrayLoad.arm_inputs={sl100=1}"},
         "robots.CR01.actions.TrayLoad.arm_inputs.sl100: this relay holds a job counter of the arm of CR01"},
        {{"arm.monitor_url=/project/plc/m/val_s32/", tray + "={ml100=1}"},
         tray + ".ml100: this relay holds a job counter of the arm"},
        {{R"(stations."A01.CP01".actions.TrayLoad.arm_inputs={mb419=1})"},
         R"(stations."A01.CP01".actions.TrayLoad.arm_inputs.mb419: this relay holds a job counter of the arm of CR01 (bytes 416 to 419))"},
    });
    CHECK(ReadSite({"robots.CR01.arm.monitor_url=/project/plc/s/val_s32", tray + "={ml100=1}"}).errors.empty());
    CHECK(
        ReadSite({SECOND_ARM + "actions.TrayLoad.arm_inputs={ml100=1}}", tray + "={ml121=1}"}).errors
        == std::vector<std::string>{});
}

} // namespace ACS::Acsd::Test
