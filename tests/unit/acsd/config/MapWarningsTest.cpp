#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <algorithm>
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
    const Acsd::AcsdConfig config =
        ReadWith({R"("reentryAllowed": false)", R"("reentryAllowed": false, "maxspeed": 1)"});
    REQUIRE(config.warnings.size() == 2);
    const std::string rule = "layouts[].edges[].vehicleTypeEdgeProperties[].";
    CHECK(
        config.warnings[0]
        == "site.map: " + rule
            + "reentryAllowed is not supported: a vehicle that becomes automatic on the edge is used at once (2 times, "
            + "first layouts[0].edges[0].vehicleTypeEdgeProperties[0].reentryAllowed)");
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

TEST_CASE("An invalid trajectory of the map closes its edge with a warning")
{
    const Acsd::AcsdConfig config =
        ReadWith({R"("trajectory": {"degree": 3, "knotVector": [0, 1, 2], "controlPoints": [{"x": 0, "y": 0}]})"});
    const Planning::SiteEdge& edge = config.site->GetEdges().front();
    REQUIRE(config.warnings.size() == 1);
    const std::string begin = "site.map: ";
    const std::string end = " does not use the edge " + edge.edgeID
        + ", because its trajectory is invalid: degree 3 requires at least 4 control points, found 1";
    CHECK(config.warnings[0].starts_with(begin));
    CHECK(config.warnings[0].ends_with(end));
    const std::string type =
        config.warnings[0].substr(begin.size(), config.warnings[0].size() - begin.size() - end.size());
    CHECK(edge.FindRuleOrNull(type) == nullptr);
}

TEST_CASE("Corridors are put on the edges of the map, with a warning for vehicles of 2.0")
{
    const Acsd::AcsdConfig config = Acsd::Test::ReadSite(
        {"site.corridors=[{edge='N001-N002', left=0.5, right=1}, {edge='N002-N003', left=0, right=2, ref='CONTOUR'}]",
         "site.zone_set=hall-2",
         "robots.LR01.protocol=2.0.0"});
    CHECK(config.errors.empty());
    CHECK(config.zoneSetID == "hall-2");
    const auto findCorridor = [&config](const std::string& edgeID) {
        return std::ranges::find(config.site->GetEdges(), edgeID, &Planning::SiteEdge::edgeID)->corridor;
    };
    CHECK(findCorridor("N001-N002") == Planning::SiteCorridor{0.5, 1, false});
    CHECK(findCorridor("N002-N003") == Planning::SiteCorridor{0, 2, true});
    CHECK(findCorridor("N003-N004") == std::nullopt);
    const std::string warning = "site.corridors: robots.LR01 gets none, because VDA5050 has corridors since 2.1";
    CHECK(std::ranges::count(config.warnings, warning) == 1);
    CHECK(Acsd::Test::ReadSite({"site.zone_set=hall-2"}).warnings.empty());
}

TEST_CASE("A zone set has at most 128 bytes")
{
    CHECK(Acsd::Test::ReadSite({"site.zone_set=" + std::string(128, 'z')}).errors.empty());
    Acsd::Test::CheckErrors(
        {{{"site.zone_set=" + std::string(129, 'z')}, "site.zone_set: expected at most 128 bytes, found 129"}});
}

TEST_CASE("A corridor of an unknown edge, or a second one of an edge, is an error")
{
    Acsd::Test::CheckErrors({
        {{"site.corridors=[{edge='E99', left=1, right=1}]"}, "site.corridors[0].edge: the map has no edge \"E99\""},
        {{"site.corridors=[{edge='N001-N002', left=-1, right=1}]"}, "site.corridors[0].left: "},
        {{"site.corridors=[{edge='N001-N002', left=1, right=1}, {edge='N001-N002', left=1, right=1}]"},
         "site.corridors[1].edge: N001-N002 has a corridor already"},
    });
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
