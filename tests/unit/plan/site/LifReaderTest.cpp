#include "Catch.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/LifReader.hpp>

#include <numbers>
#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)

namespace
{

const std::string& GetLIF()
{
    static const std::string TEXT = R"({
      "metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "2025-01-01T00:00:00Z",
        "lifVersion": "1.0.0"},
      "layouts": [{"layoutId": "one", "layoutVersion": "1",
        "nodes": [
          {"nodeId": "N1", "mapId": "floor", "nodePosition": {"x": 0, "y": 0},
           "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr", "theta": 1.5}]},
          {"nodeId": "N2", "mapId": "floor", "nodePosition": {"x": 3, "y": 4}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr"}]}],
        "edges": [
          {"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2", "vehicleTypeEdgeProperties":
           [{"vehicleTypeId": "lr", "vehicleOrientation": 270.0, "orientationType": "TANGENTIAL",
             "rotationAllowed": true, "maxSpeed": 1.2}]}],
        "stations": [{"stationId": "A01.CP01", "interactionNodeIds": ["N2"]},
                     {"stationId": "A01.CP02", "interactionNodeIds": ["N1"], "stationHeight": 0.85}]}]})";
    return TEXT;
}

const std::string RULE_OF_NODE = "layouts[0].nodes[0].vehicleTypeNodeProperties[0]";
const std::string RULE_OF_EDGE = "layouts[0].edges[0].vehicleTypeEdgeProperties[0]";
const std::string NODE_ACTION = R"("actions": [{"requirementType": "REQUIRED", )";

/// A trajectory from N1 to x and 4.
std::string MakeCurve(const std::string& degree, const std::string& knots, const std::string& x)
{
    return R"("trajectory": {"degree": )" + degree + R"(, "knotVector": [)" + knots
        + R"(], "controlPoints": [{"x": 0, "y": 0}, {"x": )" + x + R"(, "y": 4}]})";
}

std::string Replace(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t place = text.find(from);
    REQUIRE(place != std::string::npos);
    return text.replace(place, from.size(), to);
}

} // namespace

TEST_CASE("LIF: nodes, edges and stations become a map, degrees become radians")
{
    const Core::Result<SiteMap> site = DecodeLIF(GetLIF());
    REQUIRE(site.has_value());
    REQUIRE(site->GetNodes().size() == 2);
    CHECK(site->FindNodeOrNull("N1")->mapID == "floor");
    CHECK(site->FindNodeOrNull("N1")->FindRuleOrNull("lr")->theta == 1.5);
    CHECK(site->FindNodeOrNull("N2")->FindRuleOrNull("lr")->theta == std::nullopt);
    CHECK(site->FindNodeOrNull("N2")->FindRuleOrNull("cr") == nullptr);
    const SiteEdgeRule& rule = *site->GetEdges().front().FindRuleOrNull("lr");
    CHECK(*rule.orientation == Approx(-std::numbers::pi / 2));
    CHECK(rule.orientationType == "TANGENTIAL");
    CHECK(rule.bRotationAllowed == true);
    CHECK(rule.maxSpeed == 1.2);
    CHECK(site->FindStationOrNull("A01.CP01")->nodeIDs == std::vector<std::string>{"N2"});
    CHECK(site->FindStationAtOrNull("N2")->stationID == "A01.CP01");
    CHECK(site->FindStationOrNull("A01.CP01")->height == std::nullopt);
    CHECK(site->FindStationOrNull("A01.CP02")->height == 0.85);
    CHECK(site->HasVehicleType("lr"));
    CHECK_FALSE(site->HasVehicleType("cr"));
}

TEST_CASE("LIF: nodes without a mapId are one warning, with their number and the first of them")
{
    const auto read = [](const std::string& text) {
        std::vector<std::string> warnings;
        REQUIRE(DecodeLIF(text, warnings).has_value());
        return warnings;
    };
    const std::string reason = ": a vehicle rejects an order whose nodes do not name its map";
    const std::string without = Replace(GetLIF(), R"("nodeId": "N2", "mapId": "floor")", R"("nodeId": "N2")");
    CHECK(read(GetLIF()).empty());
    CHECK(read(without) == std::vector<std::string>{"1 node has no mapId, layouts[0].nodes[1]" + reason});
    CHECK(
        read(Replace(without, R"("mapId": "floor")", R"("mapId": "")"))
        == std::vector<std::string>{"2 nodes have no mapId, the first is layouts[0].nodes[0]" + reason});
}

TEST_CASE("LIF: an edge is for vehicles with and without a load, unless it has a restriction")
{
    const auto permits = [](const std::string& restriction, ELoad load) {
        const Core::Result<SiteMap> site =
            DecodeLIF(Replace(GetLIF(), R"("maxSpeed": 1.2)", R"("maxSpeed": 1.2)" + restriction));
        REQUIRE(site.has_value());
        return site->GetEdges().front().FindRuleOrNull("lr")->IsPermitted(load);
    };
    const std::string empty = R"(, "loadRestriction": {"unloaded": true, "loaded": false, "loadSetNames": ["a"]})";
    const std::string loaded = R"(, "loadRestriction": {"unloaded": false, "loaded": true})";
    const std::string none = R"(, "loadRestriction": {"unloaded": false, "loaded": false})";
    for (const ELoad load : {ELoad::Unknown, ELoad::Empty, ELoad::Loaded})
    {
        CHECK(permits("", load));
        CHECK(permits(R"(, "loadRestriction": null)", load));
        CHECK(permits(empty, load) == (load == ELoad::Empty));
        CHECK(permits(loaded, load) == (load == ELoad::Loaded));
        CHECK_FALSE(permits(none, load));
    }
}

TEST_CASE("LIF: an edge with a trajectory has the length of the curve, whose degree is 3 unless it is given")
{
    const auto measure = [](const std::string& members) {
        const Core::Result<SiteMap> site = DecodeLIF(Replace(GetLIF(), R"("maxSpeed": 1.2)", members));
        REQUIRE(site.has_value());
        const SiteEdge& edge = site->GetEdges().front();
        return site->GetLength(edge, edge.rules.front());
    };
    CHECK(measure(R"("maxSpeed": 1.2)") == 5.0);
    const std::string corner = R"("controlPoints": [{"x": 0, "y": 0}, {"x": 3, "y": 0}, {"x": 3, "y": 4}]})";
    CHECK(measure(R"("trajectory": {"degree": 1, "knotVector": [0, 0, 0.5, 1, 1], )" + corner) == Approx(7.0));
    const std::string line =
        R"("trajectory": {"knotVector": [0, 0, 0, 0, 1, 1, 1, 1], "controlPoints": [{"x": 0, "y": 0},
        {"x": 1, "y": 1}, {"x": 2, "y": 2}, {"x": 3, "y": 4}]})";
    CHECK(measure(line) > 5.0);
    CHECK(measure(line) < 5.1);
}

TEST_CASE("LIF: the knots of a trajectory are scaled to 0 to 1, which VDA5050 requires of orders")
{
    struct Case
    {
        std::string knots;
        std::vector<double> scaled;
    };
    const std::vector<Case> cases{
        {"0, 0, 1, 1", {0, 0, 1, 1}},
        {"0, 0, 7, 7", {0, 0, 1, 1}},
        {"-2, -2, 2, 2", {0, 0, 1, 1}},
        {"0.25, 0.25, 0.75, 0.75", {0, 0, 1, 1}},
        {"0, 1, 3, 4", {0, 0.25, 0.75, 1}}, // not clamped; of degree 1 it ends at the control points nevertheless
    };
    for (const Case& valid : cases)
    {
        CAPTURE(valid.knots);
        std::vector<std::string> warnings;
        const Core::Result<SiteMap> site =
            DecodeLIF(Replace(GetLIF(), R"("maxSpeed": 1.2)", MakeCurve("1", valid.knots, "3")), warnings);
        REQUIRE(site.has_value());
        CHECK(warnings.empty());
        const SiteEdge& edge = site->GetEdges().front();
        REQUIRE(edge.rules.size() == 1);
        CHECK(edge.rules.front().trajectory->knots == valid.scaled);
        CHECK(site->GetLength(edge, edge.rules.front()) == Approx(5.0));
    }
}

TEST_CASE("LIF: an invalid trajectory closes the edge for its vehicle type only, with a warning")
{
    struct Case
    {
        std::string curve;
        std::string reason;
    };
    const std::string counts = "2 control points and degree ";
    const std::string order = "the knots must not decrease, and the last must be greater than the first";
    const std::vector<Case> cases{
        {MakeCurve("3", "0, 1, 2", "3"), "degree 3 requires at least 4 control points, found 2"}, // the example of LIF
        {MakeCurve("1", "0, 0, 1", "3"), counts + "1 require 4 knots, found 3"},
        {MakeCurve("2", "0, 0, 0, 1, 1", "3"), "degree 2 requires at least 3 control points, found 2"},
        {MakeCurve("4", "0, 0, 1, 1", "3"), "the degree must be from 1 to 3, found 4"},
        {MakeCurve("0", "0, 0, 1", "3"), "the degree must be from 1 to 3, found 0"},
        {MakeCurve("1", "0, 1, 0, 1", "3"), order},
        {MakeCurve("1", "2, 2, 2, 2", "3"), order},
        {MakeCurve("1", "0, 1, 1, 2", "3"), "the curve is empty, because the knots 2 and 3 are equal"},
        {MakeCurve("1", "0, 0, 1, 1", "9"), "it ends 6.000 m from the node N2, allowed are 0.500 m"},
        {Replace(MakeCurve("1", "0, 0, 1, 1", "3"), R"("y": 0)", R"("y": 0, "weight": -1)"),
         "a trajectory needs finite control points, and weights that are not negative and not 0 throughout"},
        // Not clamped: its control points begin and end at the nodes, the curve itself does not.
        {R"("trajectory": {"degree": 2, "knotVector": [0, 1, 2, 3, 4, 5], "controlPoints":
            [{"x": 0, "y": 0}, {"x": 1.5, "y": 2}, {"x": 3, "y": 4}]})",
         "it begins 1.250 m from the node N1, allowed are 0.500 m"},
    };
    for (const Case& wrong : cases)
    {
        CAPTURE(wrong.curve);
        const std::string rules = wrong.curve + R"(}, {"vehicleTypeId": "cr", "maxSpeed": 0.7)";
        std::vector<std::string> warnings;
        const Core::Result<SiteMap> site = DecodeLIF(Replace(GetLIF(), R"("maxSpeed": 1.2)", rules), warnings);
        REQUIRE(site.has_value());
        const SiteEdge& edge = site->GetEdges().front();
        CHECK(edge.FindRuleOrNull("lr") == nullptr);
        REQUIRE(edge.FindRuleOrNull("cr") != nullptr);
        CHECK(edge.FindRuleOrNull("cr")->maxSpeed == 0.7);
        CHECK(
            warnings
            == std::vector<std::string>{
                "lr does not use the edge E1, because its trajectory is invalid: " + wrong.reason});
    }
}

TEST_CASE("LIF: a trajectory that is not clamped is accepted if the curve itself leads from node to node")
{
    // A straight line with evenly spaced control points, which begins and ends half way between the outer two.
    const std::string line = R"("trajectory": {"degree": 2, "knotVector": [0, 1, 2, 3, 4, 5], "controlPoints":
        [{"x": -1.5, "y": -2}, {"x": 1.5, "y": 2}, {"x": 4.5, "y": 6}]})";
    std::vector<std::string> warnings;
    const Core::Result<SiteMap> site = DecodeLIF(Replace(GetLIF(), R"("maxSpeed": 1.2)", line), warnings);
    REQUIRE(site.has_value());
    CHECK(warnings.empty());
    const SiteEdge& edge = site->GetEdges().front();
    REQUIRE(edge.rules.size() == 1);
    CHECK(site->GetLength(edge, edge.rules.front()) == Approx(5.0));
}

TEST_CASE("LIF: actions keep their requirement, blocking type and parameters")
{
    const Core::Result<SiteMap> site = DecodeLIF(Replace(
        GetLIF(),
        R"("theta": 1.5)",
        R"("actions": [{"actionType": "a", "blockingType": "SOFT", "requirementType": "REQUIRED",
            "actionParameters": [{"key": "k", "value": 1.5}]}, {"actionType": "b", "blockingType": "NONE"}])"));
    REQUIRE(site.has_value());
    const std::vector<SiteAction>& actions = site->GetNodes().front().rules.front().actions;
    REQUIRE(actions.size() == 2);
    CHECK(
        actions[0]
        == SiteAction{
            "a",
            "",
            EActionRequirement::Required,
            EActionBlocking::Soft,
            {{"k", Core::JsonText::FromNumber(1.5)}}});
    CHECK(actions[1] == SiteAction{"b", "", EActionRequirement::Optional, EActionBlocking::None, {}});
}

TEST_CASE("LIF: an invalid file is refused with the place of the error")
{
    struct Case
    {
        std::string from;
        std::string to;
        std::string path;
    };

    const std::vector<Case> cases{
        {R"("lifVersion": "1.0.0")", R"("lifVersion": "2.0.0")", "metaInformation.lifVersion"},
        {R"("nodeId": "N2")", R"("nodeId": "N1")", "layouts[0].nodes[1].nodeId"},
        {R"("edgeId": "E1", )", "", "layouts[0].edges[0].edgeId"},
        {R"("endNodeId": "N2")", R"("endNodeId": "N9")", "layouts[0].edges[0].endNodeId"},
        {"270.0", "361.0", "layouts[0].edges[0].vehicleTypeEdgeProperties[0].vehicleOrientation"},
        {R"("theta": 1.5)", R"("theta": 90)", "layouts[0].nodes[0].vehicleTypeNodeProperties[0].theta"},
        {R"("maxSpeed": 1.2)", R"("maxSpeed": 0)", "layouts[0].edges[0].vehicleTypeEdgeProperties[0].maxSpeed"},
        {R"("maxSpeed": 1.2)",
         R"("loadRestriction": {"unloaded": true})",
         "layouts[0].edges[0].vehicleTypeEdgeProperties[0].loadRestriction.loaded"},
        {R"("theta": 1.5)", NODE_ACTION + R"("blockingType": "HARD"}])", RULE_OF_NODE + ".actions[0].actionType"},
        {R"("theta": 1.5)",
         NODE_ACTION + R"("actionType": "a", "blockingType": "FIRM"}])",
         RULE_OF_NODE + ".actions[0].blockingType"},
        {R"("theta": 1.5)",
         NODE_ACTION
             + R"("actionType": "a", "blockingType": "NONE", "actionParameters": [{"key": "k", "value": null}]}])",
         RULE_OF_NODE + ".actions[0].actionParameters[0].value"},
        {R"("theta": 1.5)",
         R"("actions": [{"actionType": "a", "blockingType": "NONE", "requirementType": "MUST"}])",
         RULE_OF_NODE + ".actions[0].requirementType"},
        {R"("maxSpeed": 1.2)", R"("actions": [7])", RULE_OF_EDGE + ".actions[0]"},
        {R"("maxSpeed": 1.2)", R"("maxHeight": "2")", RULE_OF_EDGE + ".maxHeight"},
        {R"("maxSpeed": 1.2)", R"("trajectory": {"controlPoints": []})", RULE_OF_EDGE + ".trajectory.knotVector"},
        {R"("maxSpeed": 1.2)", MakeCurve("-1", "0, 0, 1, 1", "3"), RULE_OF_EDGE + ".trajectory.degree"},
        {R"("maxSpeed": 1.2)", R"("maxSpeed": 0, )" + MakeCurve("1", "0, 0, 1", "3"), RULE_OF_EDGE + ".maxSpeed"},
        {R"(["N2"])", R"(["N3"])", "layouts[0].stations[0].interactionNodeIds[0]"},
        {R"(["N2"])", "[]", "layouts[0].stations[0].interactionNodeIds"},
        {R"("x": 3)", R"("x": "3")", "layouts[0].nodes[1].nodePosition.x"},
    };
    for (const Case& wrong : cases)
    {
        INFO(wrong.from << " -> " << wrong.to);
        const Core::Result<SiteMap> site = DecodeLIF(Replace(GetLIF(), wrong.from, wrong.to));
        REQUIRE_FALSE(site.has_value());
        CHECK(site.error().path == wrong.path);
    }
    CHECK_FALSE(DecodeLIF("").has_value());
    CHECK_FALSE(DecodeLIF("[]").has_value());
}

TEST_CASE("LIF: rules of a node or edge that contradict themselves or each other are errors with their place")
{
    struct Case
    {
        std::string from;
        std::string to;
        std::string path;
        std::string expected;
    };

    const auto makeActions = [](std::size_t count) {
        std::string list;
        for (std::size_t i = 0; i < count; ++i)
        {
            list += (i == 0 ? "" : ", ");
            list += R"({"actionType": "a", "blockingType": "NONE", "requirementType": "REQUIRED"})";
        }
        return R"("actions": [)" + list + "]";
    };
    const std::string speed = R"("maxSpeed": 1.2)";
    const std::string theta = R"("theta": 1.5)";
    const std::string twice = R"(}, {"vehicleTypeId": "cr"}, {"vehicleTypeId": "lr")";
    const std::string nodeRules = "layouts[0].nodes[0].vehicleTypeNodeProperties";
    const std::string edgeRules = "layouts[0].edges[0].vehicleTypeEdgeProperties";
    const std::vector<Case> cases{
        {theta, makeActions(101), RULE_OF_NODE + ".actions", "at most 100 actions"},
        {speed, makeActions(101), RULE_OF_EDGE + ".actions", "at most 100 actions"},
        {theta, theta + twice, nodeRules + "[2].vehicleTypeId", "a vehicle type that no other entry of this list has"},
        {speed, speed + twice, edgeRules + "[2].vehicleTypeId", "a vehicle type that no other entry of this list has"},
        {speed, R"("minHeight": 2.5, "maxHeight": 2)", RULE_OF_EDGE + ".minHeight", "at most maxHeight, 2"},
        {R"("TANGENTIAL")", R"("tangential")", RULE_OF_EDGE + ".orientationType", "GLOBAL or TANGENTIAL"},
    };
    for (const Case& wrong : cases)
    {
        INFO(wrong.path);
        const Core::Result<SiteMap> site = DecodeLIF(Replace(GetLIF(), wrong.from, wrong.to));
        REQUIRE_FALSE(site.has_value());
        CHECK(site.error().code == EPlanningError::InvalidSite);
        CHECK(site.error().path == wrong.path);
        CHECK(site.error().expected == wrong.expected);
    }
    CHECK(DecodeLIF(Replace(GetLIF(), theta, makeActions(100))).has_value());
    CHECK(DecodeLIF(Replace(GetLIF(), speed, R"("minHeight": 2, "maxHeight": 2)")).has_value());
    CHECK(DecodeLIF(Replace(GetLIF(), R"("TANGENTIAL")", R"("GLOBAL")")).has_value());
    CHECK(DecodeLIF(Replace(GetLIF(), R"("orientationType": "TANGENTIAL",)", "")).has_value());
}

TEST_CASE("LIF: an error in the second layout names that layout, and a map without nodes is refused")
{
    const std::string second =
        R"(, {"layoutId": "two", "layoutVersion": "1", "nodes": [{"nodeId": "N1", "nodePosition": {"x": 0, "y": 0},
           "vehicleTypeNodeProperties": []}], "edges": [], "stations": []}]})";
    const std::string& text = GetLIF();
    const Core::Result<SiteMap> twice = DecodeLIF(text.substr(0, text.size() - 2) + second);
    REQUIRE_FALSE(twice.has_value());
    CHECK(twice.error().path == "layouts[1].nodes[0].nodeId");
    CHECK(twice.error().code == EPlanningError::InvalidSite);

    const std::string empty = text.substr(0, text.find("\"layouts\"")) + "\"layouts\": []}";
    const Core::Result<SiteMap> none = DecodeLIF(empty);
    REQUIRE_FALSE(none.has_value());
    CHECK(none.error().path == "layouts");
}
