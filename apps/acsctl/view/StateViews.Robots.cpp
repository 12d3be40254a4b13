#include "view/StateViews.hpp"

#include "view/AgeText.hpp"
#include "view/DetailList.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

constexpr int CUT_SELDOM = 1;
constexpr int CUT_OFTEN = 2;
constexpr int CUT_MOST = 3;

std::string MakeBattery(const RobotInfo& robot)
{
    return robot.battery.has_value() ? fmt::format("{:.0f} %", *robot.battery) : "-";
}

/// The node, and where the robot is on the way to the next one.
std::string MakePlace(const RobotInfo& robot)
{
    std::string place = robot.node.value_or(robot.position.empty() ? "-" : robot.position);
    if (robot.nextNode.has_value())
    {
        place.append(" -> ").append(*robot.nextNode);
    }
    return place;
}

/// "C_01 -", or "LR01.CP01: C_01, LR01.CP02: -" with the names of the ports.
std::string MakePorts(const RobotInfo& robot, bool bNames)
{
    std::string text;
    for (std::size_t i = 0; i < robot.carrierIDs.size(); ++i)
    {
        const std::string carrier = robot.carrierIDs[i].value_or("-");
        const bool bNamed = bNames && i < robot.ports.size();
        text.append(text.empty() ? "" : bNames ? ", " : " ");
        text += bNamed ? fmt::format("{}: {}", robot.ports[i], carrier) : carrier;
    }
    return text;
}

std::string MakeRobotReason(const RobotInfo& robot)
{
    if (robot.reason.has_value())
    {
        return *robot.reason;
    }
    return robot.bMaintenance ? "in maintenance" : std::string();
}

/// Reserved nodes are in brackets: [N1] [N2] N3
std::string MakeRoute(const RobotInfo& robot)
{
    std::string text;
    for (const RouteNode& node : robot.route)
    {
        text.append(text.empty() ? "" : " ");
        text += node.bReserved ? fmt::format("[{}]", node.nodeID) : node.nodeID;
    }
    return text;
}

std::string MakePose(const RobotInfo& robot)
{
    if (!robot.pose.has_value())
    {
        return {};
    }
    std::string text = fmt::format("x {:.3f} m, y {:.3f} m", robot.pose->x, robot.pose->y);
    if (robot.pose->theta.has_value())
    {
        text += fmt::format(", theta {:.3f} rad", *robot.pose->theta);
    }
    return text;
}

void AddVehicle(DetailList& details, const RobotInfo& robot, Core::WallTime now)
{
    details.AddIfAny("Driver", robot.driver);
    details.AddIfAny("Mode", robot.mode.value_or(""));
    details.AddIfAny("Topic", robot.topic.value_or(""));
    details.AddIfAny("Protocol", robot.protocolVersion.value_or(""));
    if (robot.lastMessageAt.has_value())
    {
        details.Add(
            "Last message",
            fmt::format("{} ({} ago)", *robot.lastMessageAt, MakeAge(robot.lastMessageAt, now)));
    }
    for (const RobotError& error : robot.errors)
    {
        details.Add("Error", fmt::format("{} {}: {}", error.level, error.type, error.description), EStyle::Bad);
    }
    for (const std::string& warning : robot.warnings)
    {
        details.Add("Warning", warning, EStyle::Warning);
    }
}

} // namespace

std::string PrintRobots(const std::vector<RobotInfo>& robots, const ViewContext& context)
{
    if (robots.empty())
    {
        return "No robot is configured.\n";
    }
    TextTable table(
        {{"ROBOT", CUT_SELDOM},
         {"TYPE", 0},
         {"STATUS", 0},
         {"NODE", CUT_SELDOM, 8},
         {"BATTERY", 0, 5, true},
         {"PLAN", CUT_SELDOM, 8},
         {"CARRIERS", CUT_OFTEN, 8},
         {"REASON", CUT_MOST}});
    for (const RobotInfo& robot : robots)
    {
        table.AddRow(
            {{robot.robotID},
             {robot.type},
             {robot.status, GetStyle(robot.status)},
             {MakePlace(robot)},
             {MakeBattery(robot)},
             {robot.planID.value_or("-")},
             {MakePorts(robot, false)},
             {MakeRobotReason(robot), EStyle::Warning}});
    }
    return table.Print(context.screen);
}

std::string PrintRobot(const RobotInfo& robot, const ViewContext& context)
{
    DetailList details;
    details.Add("Robot", robot.robotID);
    details.AddIfAny("Type", robot.type);
    details.Add("Status", robot.status, GetStyle(robot.status));
    details.AddIfAny("Reason", robot.reason.value_or(""), EStyle::Warning);
    details.Add("Maintenance", robot.bMaintenance ? "on" : "off", robot.bMaintenance ? EStyle::Warning : EStyle::Plain);
    details.AddIfAny("Position", robot.position);
    details.Add("Node", MakePlace(robot));
    details.AddIfAny("Pose", MakePose(robot));
    details.Add("Battery", MakeBattery(robot));
    details.Add("Plan", robot.planID.value_or("-"));
    if (robot.planID.has_value() && robot.stepNo.has_value())
    {
        details.Add("Step", std::to_string(*robot.stepNo));
    }
    details.AddIfAny("Job", robot.jobID.value_or(""));
    details.AddIfAny("Ports", MakePorts(robot, true));
    details.AddIfAny("Route", MakeRoute(robot));
    details.AddIfAny("Reserved", fmt::format("{}", fmt::join(robot.reservedNodes, " ")));
    if (robot.bArmUp.has_value())
    {
        details.Add("Arm", *robot.bArmUp ? "connected" : "not connected", *robot.bArmUp ? EStyle::Plain : EStyle::Bad);
    }
    AddVehicle(details, robot, context.now);
    return details.Print(context.screen);
}

} // namespace ACS::Acsctl
