#include "operator/AcsdStatus.hpp"

#include "operator/AlarmText.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonWriter.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned HTTP_NOT_READY = 503;
constexpr double FULL_PERCENT = 100;

void WriteMember(Json::JsonWriter& writer, std::string_view key, std::string_view value)
{
    writer.Key(key);
    writer.WriteString(value);
}

void WriteMember(Json::JsonWriter& writer, std::string_view key, const std::optional<std::string>& valueOrNull)
{
    writer.Key(key);
    if (valueOrNull.has_value())
    {
        writer.WriteString(*valueOrNull);
    }
    else
    {
        writer.WriteNull();
    }
}

/// Null for a robot that has not reported it.
void WriteBattery(Json::JsonWriter& writer, const std::vector<Planning::RobotPose>& poses, const std::string& robotID)
{
    const auto pose = std::ranges::find(poses, robotID, &Planning::RobotPose::robotID);
    writer.Key("battery");
    if (pose == poses.end())
    {
        writer.WriteNull();
    }
    else
    {
        writer.WriteInteger(std::lround(std::clamp(pose->batteryPercent, 0.0, FULL_PERCENT)));
    }
}

/// Null for a robot without an arm.
void WriteArm(Json::JsonWriter& writer, const ProgramStatus& program, const std::string& robotID)
{
    writer.Key("armUp");
    if (const auto arm = program.arms.find(robotID); arm != program.arms.end())
    {
        writer.WriteBoolean(arm->second);
    }
    else
    {
        writer.WriteNull();
    }
}

/// Times are in UTC.
void WriteOutbox(Json::JsonWriter& writer, const Planning::OutboxSummary& outbox)
{
    writer.Key("outbox");
    writer.BeginObject();
    writer.Key("reports");
    writer.WriteInteger(static_cast<std::int64_t>(outbox.count));
    writer.Key("oldest");
    if (outbox.oldest.has_value())
    {
        writer.WriteString(Core::FormatUTC(*outbox.oldest));
    }
    else
    {
        writer.WriteNull();
    }
    writer.EndObject();
}

/// "last" is null while there is none.
void WriteRefusedReports(Json::JsonWriter& writer, const RefusedReports& refused)
{
    writer.Key("refusedReports");
    writer.BeginObject();
    writer.Key("count");
    writer.WriteInteger(static_cast<std::int64_t>(refused.count));
    writer.Key("last");
    if (refused.count == 0)
    {
        writer.WriteNull();
    }
    else
    {
        writer.BeginObject();
        WriteMember(writer, "command", std::string_view(refused.command));
        WriteMember(writer, "planId", refused.planID.empty() ? std::nullopt : std::optional(refused.planID));
        WriteMember(writer, "message", std::string_view(refused.message));
        writer.EndObject();
    }
    writer.EndObject();
}

/// Both are null while the place of the robot is unknown, "nextNode" also while it is on "node".
void WriteNode(Json::JsonWriter& writer, const std::vector<Planning::RobotDetail>& details, const std::string& robotID)
{
    const auto found = std::ranges::find(details, robotID, &Planning::RobotDetail::robotID);
    const bool bKnown = found != details.end() && !found->nodeID.empty();
    WriteMember(writer, "node", bKnown ? std::optional(found->nodeID) : std::nullopt);
    WriteMember(writer, "nextNode", bKnown ? found->nextNodeID : std::nullopt);
}

/// "reason" is null for a robot that has a plan, which has a wait reason of its own, and for one that is available.
void WriteVehicle(Json::JsonWriter& writer, const Planning::RobotStatus& robot, const ProgramStatus& program)
{
    const bool bReason = !robot.planID.has_value() && !robot.message.empty();
    WriteMember(writer, "reason", bReason ? std::optional(robot.message) : std::nullopt);
    const auto found = program.vehicles.find(robot.robotID);
    const VehicleStatus vehicle = found == program.vehicles.end() ? VehicleStatus() : found->second;
    WriteMember(writer, "topic", vehicle.topic.empty() ? std::nullopt : std::optional(vehicle.topic));
    writer.Key("warnings");
    writer.BeginArray();
    for (const std::string& warning : vehicle.warnings)
    {
        writer.WriteString(warning);
    }
    writer.EndArray();
}

/// Of all robots, besides their status.
struct FleetView
{
    std::vector<Planning::RobotPose> poses;
    std::vector<Planning::RobotDetail> details;
};

void WriteRobot(
    Json::JsonWriter& writer,
    const Planning::RobotStatus& robot,
    const FleetView& fleet,
    const ProgramStatus& program)
{
    writer.BeginObject();
    WriteMember(writer, "robotId", std::string_view(robot.robotID));
    WriteMember(writer, "type", GetText(robot.type));
    WriteMember(writer, "status", GetText(robot.status));
    WriteMember(writer, "position", std::string_view(robot.position));
    WriteNode(writer, fleet.details, robot.robotID);
    WriteMember(writer, "planId", robot.planID);
    WriteMember(writer, "jobId", robot.jobID);
    WriteBattery(writer, fleet.poses, robot.robotID);
    WriteArm(writer, program, robot.robotID);
    writer.Key("maintenance");
    writer.WriteBoolean(robot.bInMaintenance);
    writer.Key("carrierIds");
    writer.BeginArray();
    for (const std::optional<std::string>& carrierOrNull : robot.carrierIDs)
    {
        if (carrierOrNull.has_value())
        {
            writer.WriteString(*carrierOrNull);
        }
        else
        {
            writer.WriteNull();
        }
    }
    writer.EndArray();
    WriteVehicle(writer, robot, program);
    writer.EndObject();
}

void WriteWait(Json::JsonWriter& writer, const Planning::WaitReason& wait)
{
    writer.BeginObject();
    WriteMember(writer, "message", std::string_view(wait.message));
    writer.Key("queuePosition");
    if (wait.queuePosition.has_value())
    {
        writer.WriteInteger(static_cast<std::int64_t>(*wait.queuePosition));
    }
    else
    {
        writer.WriteNull();
    }
    writer.Key("robots");
    writer.BeginArray();
    for (const Planning::RobotUnavailability& robot : wait.robots)
    {
        writer.BeginObject();
        WriteMember(writer, "robotId", std::string_view(robot.robotID));
        WriteMember(writer, "reason", std::string_view(robot.reason));
        writer.EndObject();
    }
    writer.EndArray();
    writer.EndObject();
}

using WaitReasons = std::map<std::string, Planning::WaitReason, std::less<>>;

/// "waits" is null for a plan that makes progress.
void WritePlan(Json::JsonWriter& writer, const Planning::PlanSummary& plan, const WaitReasons& waits)
{
    writer.BeginObject();
    WriteMember(writer, "planId", std::string_view(plan.planID));
    WriteMember(writer, "status", GetText(plan.state));
    WriteMember(writer, "robotId", plan.robotID);
    writer.Key("stepNo");
    writer.WriteInteger(plan.stepNo);
    WriteMember(writer, "jobId", plan.jobID);
    WriteMember(writer, "currentAction", plan.currentAction);
    writer.Key("waits");
    if (const auto wait = waits.find(plan.planID); wait != waits.end())
    {
        WriteWait(writer, wait->second);
    }
    else
    {
        writer.WriteNull();
    }
    writer.EndObject();
}

void WriteAlarm(Json::JsonWriter& writer, const Planning::Alarm& alarm)
{
    writer.BeginObject();
    WriteMember(writer, "robotId", std::string_view(alarm.robotID));
    WriteMember(writer, "errorCode", std::string_view(alarm.errorCode));
    WriteMember(writer, "level", GetText(alarm.level));
    WriteMember(writer, "message", std::string_view(MakeAlarmText(alarm)));
    WriteMember(writer, "planId", alarm.planID);
    writer.Key("stepNo");
    if (alarm.stepNo.has_value())
    {
        writer.WriteInteger(*alarm.stepNo);
    }
    else
    {
        writer.WriteNull();
    }
    WriteMember(writer, "jobId", alarm.jobID);
    writer.EndObject();
}

std::string DescribeObstacle(const LinkStatus& link)
{
    return link.obstacle.empty() ? "no connection: " + link.name : link.obstacle;
}

template <typename TItems, typename TWrite>
void WriteList(Json::JsonWriter& writer, std::string_view key, const TItems& items, TWrite write)
{
    writer.Key(key);
    writer.BeginArray();
    for (const auto& item : items)
    {
        write(writer, item);
    }
    writer.EndArray();
}

} // namespace

Apps::HttpResponse MakeLiveResponse()
{
    return {200, "text/plain; charset=utf-8", "alive\n"};
}

Apps::HttpResponse MakeReadyResponse(const std::vector<LinkStatus>& links, const std::vector<std::string>& obstacles)
{
    std::string missing;
    for (const LinkStatus& link : links)
    {
        missing += link.bUp ? "" : DescribeObstacle(link) + "\n";
    }
    for (const std::string& obstacle : obstacles)
    {
        missing += obstacle + "\n";
    }
    const bool bReady = missing.empty();
    return {bReady ? 200U : HTTP_NOT_READY, "text/plain; charset=utf-8", bReady ? "ready\n" : missing};
}

Apps::HttpResponse MakeStatusResponse(const ProgramStatus& program, const Planning::PlanEngine& engine)
{
    Apps::HttpResponse response{200, "application/json", {}};
    Json::JsonWriter writer(response.body);
    writer.BeginObject();
    writer.Key("links");
    writer.BeginObject();
    for (const LinkStatus& link : program.links)
    {
        writer.Key(link.name);
        writer.WriteBoolean(link.bUp);
    }
    writer.EndObject();
    std::vector<std::string> obstacles;
    for (const LinkStatus& link : program.links)
    {
        if (!link.bUp && !link.obstacle.empty())
        {
            obstacles.push_back(link.obstacle);
        }
    }
    obstacles.insert(obstacles.end(), program.obstacles.begin(), program.obstacles.end());
    WriteList(writer, "obstacles", obstacles, [](Json::JsonWriter& list, const std::string& obstacle) {
        list.WriteString(obstacle);
    });
    WriteMember(writer, "tsc", GetText(engine.GetTscState()));
    const std::string& hold = engine.GetHoldReason();
    WriteMember(writer, "tscReason", hold.empty() ? std::nullopt : std::optional(hold));
    WriteOutbox(writer, engine.GetOutboxSummary());
    WriteRefusedReports(writer, program.refusedReports);
    const FleetView fleet{engine.GetRobotPoses(), engine.GetRobotDetails()};
    WriteList(writer, "robots", engine.GetRobotStatuses(), [&](Json::JsonWriter& list, const auto& robot) {
        WriteRobot(list, robot, fleet, program);
    });
    WaitReasons waits;
    for (Planning::WaitReason& wait : engine.GetWaitReasons())
    {
        waits.emplace(wait.planID, std::move(wait));
    }
    WriteList(writer, "plans", engine.GetActivePlans(), [&waits](Json::JsonWriter& list, const auto& plan) {
        WritePlan(list, plan, waits);
    });
    WriteList(writer, "alarms", engine.GetActiveAlarms(), WriteAlarm);
    writer.EndObject();
    response.body += '\n';
    return response;
}

void AddHealthRoutes(Apps::HttpRoutes& routes, const std::function<ProgramStatus()>& getStatus)
{
    routes.Add("GET", "/livez", [](const auto&, const auto&) { return MakeLiveResponse(); });
    routes.Add("GET", "/readyz", [getStatus](const auto&, const auto&) {
        const ProgramStatus program = getStatus();
        return MakeReadyResponse(program.links, program.obstacles);
    });
}

void AddStatusRoute(
    Apps::HttpRoutes& routes,
    const Planning::PlanEngine& engine,
    const std::function<ProgramStatus()>& getStatus)
{
    routes.Add("GET", "/status", [&engine, getStatus](const auto&, const auto&) {
        return MakeStatusResponse(getStatus(), engine);
    });
}

Apps::HttpGuard MakeHttpGuard(const HttpListenConfig& config)
{
    std::vector<std::string> names = config.hosts;
    names.push_back(config.listen.host);
    return Apps::HttpGuard({std::move(names), false});
}

} // namespace ACS::Acsd
