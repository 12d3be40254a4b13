#include "Catch.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/plan/UnusedLifMember.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

using EKind = UnusedLifMember::EKind;

const std::string NODE_RULE = "layouts[].nodes[].vehicleTypeNodeProperties[]";
const std::string EDGE_RULE = "layouts[].edges[].vehicleTypeEdgeProperties[]";

/// A valid map with these members in the rule of its node N1, and in the rule of its edge E1.
std::string MakeMap(const std::string& nodeRule, const std::string& edgeRule)
{
    std::string text = R"({
      "metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "2025-01-01T00:00:00Z",
        "lifVersion": "1.0.0"},
      "layouts": [{"layoutId": "one", "layoutVersion": "1",
        "nodes": [
          {"nodeId": "N1", "mapId": "floor", "nodePosition": {"x": 0, "y": 0},
           "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr", "theta": 1.5 @NODE}]},
          {"nodeId": "N2", "nodePosition": {"x": 3, "y": 4}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr"}]}],
        "edges": [
          {"edgeId": "E0", "startNodeId": "N2", "endNodeId": "N1", "vehicleTypeEdgeProperties": []},
          {"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2", "vehicleTypeEdgeProperties":
           [{"vehicleTypeId": "lr", "vehicleOrientation": 270.0, "orientationType": "TANGENTIAL",
             "rotationAllowed": true, "maxSpeed": 1.2, "maxRotationSpeed": 0.5 @EDGE}]}],
        "stations": [{"stationId": "A01.CP01", "interactionNodeIds": ["N2"], "stationHeight": 0.85}]}]})";
    for (const auto& [mark, members] : {std::pair("@NODE", nodeRule), std::pair("@EDGE", edgeRule)})
    {
        text.replace(text.find(mark), 5, members.empty() ? "" : ", " + members);
    }
    return text;
}

std::vector<UnusedLifMember> FindOf(EKind kind, const std::string& text)
{
    REQUIRE(DecodeLIF(text).has_value());
    std::vector<UnusedLifMember> found = FindUnusedMembers(text);
    std::erase_if(found, [kind](const UnusedLifMember& member) { return member.kind != kind; });
    return found;
}

} // namespace

TEST_CASE("LIF: the members that the map needs are used, except those that only identify the file and its layouts")
{
    const std::string text = MakeMap("", "");
    CHECK(FindOf(EKind::Unsupported, text).empty());
    CHECK(FindOf(EKind::Unknown, text).empty());
    std::vector<std::string> paths;
    for (const UnusedLifMember& member : FindOf(EKind::Informative, text))
    {
        paths.push_back(member.path);
        CHECK(member.count == 1);
        CHECK(member.effect.empty());
    }
    CHECK(
        paths
        == std::vector<std::string>{
            "layouts[].layoutId",
            "layouts[].layoutVersion",
            "metaInformation.creator",
            "metaInformation.exportTimestamp",
            "metaInformation.projectIdentification"});
}

TEST_CASE("LIF: a member that demands something without effect is reported with its place")
{
    struct Row
    {
        std::string nodeRule;
        std::string edgeRule;
        std::string path;
        std::string first;
    };

    const std::string node = "layouts[0].nodes[0].vehicleTypeNodeProperties[0]";
    const std::string edge = "layouts[0].edges[1].vehicleTypeEdgeProperties[0]";
    const std::string actions = R"("actions": [{"actionType": "a", "blockingType": "NONE"},
        {"actionType": "b", "requirementType": "CONDITIONAL", "blockingType": "NONE"}])";
    const std::vector<Row> rows{
        {actions, "", NODE_RULE + ".actions[]", node + ".actions[1]"},
        {"", actions, EDGE_RULE + ".actions[]", edge + ".actions[1]"},
        {"", R"("corridor": {"leftWidth": 1, "rightWidth": 1})", EDGE_RULE + ".corridor", edge + ".corridor"},
        {"", R"("reentryAllowed": false)", EDGE_RULE + ".reentryAllowed", edge + ".reentryAllowed"},
        {"",
         R"("rotationAtStartNodeAllowed": "CW")",
         EDGE_RULE + ".rotationAtStartNodeAllowed",
         edge + ".rotationAtStartNodeAllowed"},
        {"",
         R"("rotationAtEndNodeAllowed": "NONE")",
         EDGE_RULE + ".rotationAtEndNodeAllowed",
         edge + ".rotationAtEndNodeAllowed"},
        {"",
         R"("loadRestriction": {"unloaded": true, "loaded": true, "loadSetNames": ["a"]})",
         EDGE_RULE + ".loadRestriction.loadSetNames",
         edge + ".loadRestriction.loadSetNames"},
    };
    for (const Row& row : rows)
    {
        INFO(row.nodeRule << row.edgeRule);
        const std::vector<UnusedLifMember> found = FindOf(EKind::Unsupported, MakeMap(row.nodeRule, row.edgeRule));
        REQUIRE(found.size() == 1);
        CHECK(found[0].path == row.path);
        CHECK(found[0].first == row.first);
        CHECK(found[0].count == 1);
        CHECK_FALSE(found[0].effect.empty());
    }
}

TEST_CASE("LIF: a member whose value demands nothing is informative, and null counts as absent")
{
    const std::string harmless = R"("reentryAllowed": true, "rotationAtStartNodeAllowed": "BOTH",
        "loadRestriction": {"unloaded": true, "loaded": false, "loadSetNames": []}, "actions": [{"actionType": "a", "requirementType": "OPTIONAL", "blockingType": "NONE"}])";
    CHECK(FindOf(EKind::Unsupported, MakeMap("", harmless)).empty());
    const std::vector<UnusedLifMember> found = FindOf(EKind::Informative, MakeMap("", harmless));
    for (const std::string name :
         {".reentryAllowed", ".rotationAtStartNodeAllowed", ".loadRestriction.loadSetNames", ".actions[]"})
    {
        INFO(name);
        CHECK(std::ranges::count(found, EDGE_RULE + name, &UnusedLifMember::path) == 1);
    }
    const std::vector<UnusedLifMember> absent =
        FindUnusedMembers(MakeMap(R"("actions": null)", R"("trajectory": null, "x": null)"));
    CHECK(std::ranges::count_if(absent, [](const UnusedLifMember& member) { return member.path.size() > 40; }) == 0);
}

TEST_CASE("LIF: REQUIRED actions, trajectories and heights are used")
{
    const std::string actions =
        R"("actions": [{"actionType": "a", "requirementType": "REQUIRED", "blockingType": "NONE"}])";
    const std::string text = MakeMap(actions, actions + R"(, "minHeight": 1, "maxHeight": 2, "trajectory": {"degree": 1,
        "knotVector": [0, 0, 1, 1], "controlPoints": [{"x": 0, "y": 0}, {"x": 3, "y": 4}]})");
    for (const EKind kind : {EKind::Unsupported, EKind::Informative, EKind::Unknown})
    {
        for (const UnusedLifMember& member : FindOf(kind, text))
        {
            INFO(member.path);
            CHECK(member.path.find("Properties[]") == std::string::npos);
        }
    }
}

TEST_CASE("LIF: members of one kind are counted, over all layouts, and the first one is named")
{
    const std::string action = R"({"actionType": "a", "requirementType": "CONDITIONAL", "blockingType": "NONE"})";
    std::string text = MakeMap(R"("actions": [)" + action + ", " + action + "]", "");
    text.resize(text.size() - 2);
    text += R"(, {"layoutId": "two", "layoutVersion": "1", "nodes": [{"nodeId": "N3", "nodePosition": {"x": 9, "y": 0},
        "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr", "actions": [)"
        + action + R"(]}]}],
        "edges": [], "stations": []}]})";
    const std::vector<UnusedLifMember> found = FindOf(EKind::Unsupported, text);
    REQUIRE(found.size() == 1);
    CHECK(found[0].count == 3);
    CHECK(found[0].first == "layouts[0].nodes[0].vehicleTypeNodeProperties[0].actions[0]");
    CHECK(FindOf(EKind::Informative, text).front().count == 2); // layoutId
}

TEST_CASE("LIF: a member of another name is unknown, even where its name is the path of a known one")
{
    const std::string text = MakeMap(R"("maxSpeed": 1)", R"("maxspeed": 1, "note\u001b": {"maxSpeed": 1})");
    const std::vector<UnusedLifMember> found = FindOf(EKind::Unknown, text);
    REQUIRE(found.size() == 3);
    CHECK(found[0].path == EDGE_RULE + ".\"note?\"");
    CHECK(found[1].path == EDGE_RULE + ".maxspeed");
    CHECK(found[1].first == "layouts[0].edges[1].vehicleTypeEdgeProperties[0].maxspeed");
    CHECK(found[2].path == NODE_RULE + ".maxSpeed");

    const std::vector<UnusedLifMember> root = FindUnusedMembers(R"({"metaInformation.lifVersion": "1.0.0"})");
    REQUIRE(root.size() == 1);
    CHECK(root[0].kind == EKind::Unknown);
}

TEST_CASE("LIF: unused members of any text can be searched")
{
    CHECK(FindUnusedMembers("").empty());
    CHECK(FindUnusedMembers("[]").empty());
    CHECK(FindUnusedMembers(R"({"layouts": [1, [[{"nodes": 7}]], null]})").empty());
}
