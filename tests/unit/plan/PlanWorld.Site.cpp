#include "PlanWorld.hpp"

#include <fmt/format.h>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

SiteNode MakeNode(std::string nodeID, double x, double y)
{
    return {std::move(nodeID), x, y, "floor", {{"lr-base", std::nullopt}, {"cr-base", 1.5}}};
}

SiteEdge MakeEdge(const std::string& from, const std::string& to)
{
    const auto makeRule = [](std::string type) {
        SiteEdgeRule rule;
        rule.vehicleTypeID = std::move(type);
        rule.maxSpeed = 1.2;
        return rule;
    };
    return {from + ">" + to, from, to, {makeRule("lr-base"), makeRule("cr-base")}};
}

RobotOptions MakeRobot(const std::string& robotID, ERobotType type, const std::string& home)
{
    const bool bLogistics = type == ERobotType::LR;
    RobotOptions robot{
        *Core::RobotID::Parse(robotID),
        type,
        bLogistics ? "lr-base" : "cr-base",
        "D-" + home,
        home,
        *Core::ParseLocationRange(robotID + (bLogistics ? ".CP01" : ".TP01-03")),
        {},
        {}};
    for (int tray = 1; !bLogistics && tray <= 3; ++tray)
    {
        std::ranges::move(
            *Core::ParseLocationRange(fmt::format("{}.TP{:02}.MP01-25", robotID, tray)),
            std::back_inserter(robot.childPorts));
    }
    return robot;
}

} // namespace

SiteMap MakeTestSite()
{
    const std::vector<std::string> stations{
        "CHG01",
        "CHG02",
        "A01.CP01",
        "A01.CP02",
        "A01.CP03",
        "A01.CP04",
        "A01.CP05",
        "A01.CP06",
        "A02.CP03",
        "A02.CP04",
        "A01.SET01",
        "A01.SET02",
        "A01.SET03",
        "A01.SET04",
        "CHG03",
        "CHG04"};
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> sites;
    for (std::size_t i = 0; i < stations.size(); ++i)
    {
        const auto lane = [&stations](std::size_t index) {
            return fmt::format("L{:02}", index % stations.size() + 1);
        };
        const auto x = static_cast<double>(i);
        const std::string dock = "D-" + stations[i];
        nodes.push_back(MakeNode(lane(i), x, 0));
        nodes.push_back(MakeNode(dock, x, 1));
        edges.push_back(MakeEdge(lane(i), lane(i + 1)));
        edges.push_back(MakeEdge(lane(i), dock));
        edges.push_back(MakeEdge(dock, lane(i)));
        sites.push_back({stations[i], {dock}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), std::move(sites));
}

EngineOptions MakeTestOptions(bool bFourRobots)
{
    EngineOptions options;
    options.robots.push_back(MakeRobot("LR01", ERobotType::LR, "CHG01"));
    options.robots.push_back(MakeRobot("CR01", ERobotType::CR, "CHG02"));
    if (bFourRobots)
    {
        options.robots.push_back(MakeRobot("LR02", ERobotType::LR, "CHG03"));
        options.robots.push_back(MakeRobot("CR02", ERobotType::CR, "CHG04"));
    }
    for (const std::string range :
         {"A01.CP01.TP01-04",
          "A01.CP02.TP01-04",
          "A01.CP03.TP01-04",
          "A01.SET01.MP01-32",
          "A01.SET02.MP01-32",
          "A01.SET03.MP01-32",
          "A01.SET04.MP01-32"})
    {
        std::ranges::move(*Core::ParseLocationRange(range), std::back_inserter(options.places));
    }
    return options;
}

Plan MakeLogisticsPlan(const std::string& planID)
{
    return {
        planID,
        "LOTSAMPLE_0001",
        10,
        {{1, "CassetteLoad", "A01.CP01", {"CASSETTE_01"}, {{planID + "-a4", "A01.CP01", "AMR.CP01"}}},
         {2, "CassetteUnload", "A02.CP03", {"CASSETTE_01"}, {{planID + "-b2", "AMR.CP01", "A02.CP03"}}}}};
}

Plan MakeControlPlan(const std::string& planID)
{
    return {
        planID,
        "LOTSAMPLE_0001",
        10,
        {{1,
          "TrayLoad",
          "A01.CP01",
          {"TRAY_01", "TRAY_02"},
          {{planID + "-cd", "A01.CP01.TP01", "AMR.TP01"}, {planID + "-b3", "A01.CP01.TP02", "AMR.TP02"}}},
         {2,
          "MemoryPickAndPlace",
          "A01.SET01",
          {},
          {{planID + "-f3", "AMR.TP01.MP01", "A01.SET01.MP01"}, {planID + "-e0", "AMR.TP02.MP01", "A01.SET01.MP02"}}},
         {3,
          "TrayUnload",
          "A01.CP01",
          {"TRAY_01", "TRAY_02"},
          {{planID + "-d1", "AMR.TP01", "A01.CP01.TP01"}, {planID + "-d2", "AMR.TP02", "A01.CP01.TP02"}}}}};
}

} // namespace ACS::Testing
