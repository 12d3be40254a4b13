#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

/// The example site with a map in which each member is added to the rule of an edge: the first one after the text.
Acsd::AcsdConfig ReadWith(const std::vector<std::string>& members, const std::string& after = "\"edges\"")
{
    const Testing::TemporaryFolder folder;
    std::ifstream from(std::string(ACS_SITE) + "/site.lif.json");
    std::stringstream read;
    read << from.rdbuf();
    std::string text = read.str();
    std::size_t at = text.find(after);
    for (const std::string& member : members)
    {
        at = text.find("\"maxSpeed\"", at);
        REQUIRE(at != std::string::npos);
        text.insert(at, member + ", ");
        at += member.size() + 3;
    }
    const std::string file = folder.GetPath() / "site.lif.json";
    std::ofstream(file) << text;
    Acsd::AcsdConfig config = Acsd::Test::ReadSite({"site.map=" + file});
    CHECK(config.errors.empty());
    return config;
}

} // namespace

TEST_CASE("What the map demands without effect is one warning for each kind of member")
{
    const Acsd::AcsdConfig config = ReadWith({R"("maxHeight": 2.5)", R"("maxHeight": 2.0, "maxspeed": 1)"});
    REQUIRE(config.warnings.size() == 2);
    const std::string rule = "layouts[].edges[].vehicleTypeEdgeProperties[].";
    CHECK(
        config.warnings[0]
        == "site.map: " + rule + "maxHeight is not supported: orders have no height limit (2 times, first "
            + "layouts[0].edges[0].vehicleTypeEdgeProperties[0].maxHeight)");
    CHECK(config.warnings[1].starts_with(
        "site.map: " + rule + "maxspeed is not a member of LIF 1.0 and has no effect (1 time, first layouts[0]."));
}

TEST_CASE("Members of the map that demand nothing are one note, and no warning")
{
    const Acsd::AcsdConfig config = ReadWith({R"("reentryAllowed": true)"});
    CHECK(config.warnings.empty());
    REQUIRE(config.notes.size() == 1);
    CHECK(config.notes[0].starts_with("site.map: members without effect on driving: "));
    CHECK(
        config.notes[0].find("layouts[].edges[].vehicleTypeEdgeProperties[].reentryAllowed (1 time)")
        != std::string::npos);
    CHECK(config.notes[0].find("layouts[].layoutName (1 time)") != std::string::npos);
}

TEST_CASE("A parking position that a robot cannot reach with a load is a warning")
{
    const std::string edge = R"("endNodeId": "D-CHG01")";
    const auto read = [&edge](const std::string& unloaded, const std::string& loaded) {
        return ReadWith({R"("loadRestriction": {"unloaded": )" + unloaded + R"(, "loaded": )" + loaded + "}"}, edge)
            .warnings;
    };
    const std::string begin = "robots.LR01: its parking position CHG01 cannot be reached ";
    CHECK(read("true", "true").empty());
    CHECK(read("true", "false") == std::vector{begin + "with a load; it may block other robots"});
    CHECK(read("false", "true") == std::vector{begin + "without a load; it may block other robots"});
}
