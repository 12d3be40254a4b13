#include "Catch.hpp"
#include "common/config/TextFile.hpp"
#include "config/AcsdConfig.hpp"
#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using Lines = std::vector<std::string>;

/// The errors of the example site without the first line that begins with the text. Each is shown from its key on.
Lines FindErrorsWithout(const std::string& line)
{
    const Testing::TemporaryFolder folder;
    const std::filesystem::path site(ACS_SITE);
    std::filesystem::copy_file(site / "site.lif.json", folder.GetPath() / "site.lif.json");
    std::string text = Apps::ReadTextFile((site / "acsd.toml").string()).value();
    const std::size_t at = text.find("\n" + line);
    REQUIRE(at != std::string::npos);
    text.erase(at, text.find('\n', at + 1) - at);
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ofstream(file) << text;
    Lines errors = ReadAcsdConfig(file, {}).errors;
    for (std::string& error : errors)
    {
        error = error.substr(error.find(": ") + 2);
    }
    return errors;
}

} // namespace

TEST_CASE("A store that is not given is one error")
{
    CHECK(
        FindErrorsWithout("directory = \"store\"")
        == Lines{"store.directory: missing; give the path of a directory, or store.url for a store in PostgreSQL"});
}

TEST_CASE("A missing map or start node is an error that states what is missing")
{
    CHECK(FindErrorsWithout("map = ") == Lines{"site.map: missing; give the path of a LIF file"});
    CHECK(
        FindErrorsWithout("start_node = \"D-CHG01\"")
        == Lines{"robots.LR01.start_node: missing; give the nodeId of the site map where the robot is at the start"});
}

TEST_CASE("A CR without an arm is one error: whether it can do the actions is not known")
{
    CHECK(
        FindErrorsWithout("arm.url = ")
        == Lines{"robots.CR01.arm: a CR needs arm.url (tcp://) of its arm's controller"});
}

TEST_CASE("Tables that have removed keys only are not listed as allowed")
{
    const Lines errors = ReadSite({"table.key=1"}).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].starts_with("--set: table: unknown key; allowed here: abort, actions, arm, "));
    CHECK(errors[0].find(" errors, history, ") != std::string::npos);
    CHECK(errors[0].find(" http, log, ") != std::string::npos);
}

TEST_CASE("A station without quotes is an error that shows the quotes")
{
    const std::string end = "expected a station of the site map";
    CHECK(
        ReadSite({"stations.A01.CP01.type=rack"}).errors
        == Lines{"--set: stations.A01: " + end + "; a name with dots needs quotes: [stations.\"A01.CP01\"]"});
    CHECK(ReadSite({"stations.A0.type=rack"}).errors == Lines{"--set: stations.A0: " + end});
    CHECK(ReadSite({"stations.Z9.type=rack"}).errors == Lines{"--set: stations.Z9: " + end});
}

TEST_CASE("A robot with the alias as its name is an error that states what the alias is")
{
    CHECK(
        ReadSite({"robots.AMR={type='LR'}"}).errors
        == Lines{
            "--set: robots.AMR: AMR stands for the robot that executes a plan (MCS-ACS section 3.1); give another name"});
}

TEST_CASE("The words of an arm have a path, and all of them are relays")
{
    const std::string path = R"(monitor_url: expected a path that begins with "/", such as "/project/plc/m/val_s32")";
    CheckErrors(
        {{{"arm.monitor_url=val_s32"}, "arm." + path},
         {{"robots.CR01.arm.monitor_url="}, "robots.CR01.arm." + path},
         {{"arm.monitor_start=65517"},
          "arm.monitor_start: the word of counter_echo, index 4, ends at byte 65536; the last byte of the relays is 65535"},
         {{"robots.CR01.arm.monitor_start=65400", "robots.CR01.arm.counter_failed=40"},
          "robots.CR01.arm.monitor_start: the word of counter_failed, index 40, ends at byte 65563; "}});
    CHECK(ReadSite({"arm.monitor_start=65516"}).errors.empty());
    CHECK(ReadSite({"arm.monitor_start=65520", "arm.counter_echo=-1", "arm.counter_finished=3"}).errors.empty());
}

TEST_CASE("A theta that is too large is an error that names the unit")
{
    const Testing::TemporaryFolder folder;
    std::string text = Apps::ReadTextFile(std::string(ACS_SITE) + "/site.lif.json").value();
    const std::size_t at = text.find("\"theta\": ");
    REQUIRE(at != std::string::npos);
    text.insert(at + 9, "90, \"was\": ");
    const std::string file = (folder.GetPath() / "site.lif.json").string();
    std::ofstream(file) << text;
    const Lines errors = ReadSite({"site.map=" + file}).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].ends_with("expected a number from -3.1416 to 3.1416, found 90; theta is in radians"));
}

} // namespace ACS::Acsd::Test
