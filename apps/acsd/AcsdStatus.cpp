#include "AcsdStatus.hpp"

#include <acs/json/JsonWriter.hpp>

#include <optional>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned HTTP_UNAVAILABLE = 503;

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

void WriteRobot(Json::JsonWriter& writer, const Planning::RobotStatus& robot)
{
    writer.BeginObject();
    WriteMember(writer, "robotId", std::string_view(robot.robotID));
    WriteMember(writer, "type", GetText(robot.type));
    WriteMember(writer, "status", GetText(robot.status));
    WriteMember(writer, "position", std::string_view(robot.position));
    WriteMember(writer, "planId", robot.planID);
    WriteMember(writer, "jobId", robot.jobID);
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
    writer.EndObject();
}

void WritePlan(Json::JsonWriter& writer, const Planning::PlanSummary& plan)
{
    writer.BeginObject();
    WriteMember(writer, "planId", std::string_view(plan.planID));
    WriteMember(writer, "status", GetText(plan.state));
    WriteMember(writer, "robotId", plan.robotID);
    writer.Key("stepNo");
    writer.WriteInteger(plan.stepNo);
    WriteMember(writer, "jobId", plan.jobID);
    WriteMember(writer, "currentAction", plan.currentAction);
    writer.EndObject();
}

void WriteAlarm(Json::JsonWriter& writer, const Planning::Alarm& alarm)
{
    writer.BeginObject();
    WriteMember(writer, "robotId", std::string_view(alarm.robotID));
    WriteMember(writer, "errorCode", std::string_view(alarm.errorCode));
    WriteMember(writer, "level", GetText(alarm.level));
    WriteMember(writer, "message", std::string_view(alarm.message));
    WriteMember(writer, "planId", alarm.planID);
    writer.EndObject();
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
        missing += link.bUp ? "" : "no connection: " + link.name + "\n";
    }
    for (const std::string& obstacle : obstacles)
    {
        missing += obstacle + "\n";
    }
    const bool bReady = missing.empty();
    return {bReady ? 200U : HTTP_UNAVAILABLE, "text/plain; charset=utf-8", bReady ? "ready\n" : missing};
}

Apps::HttpResponse MakeStatusResponse(const std::vector<LinkStatus>& links, const Planning::PlanEngine& engine)
{
    Apps::HttpResponse response{200, "application/json", {}};
    Json::JsonWriter writer(response.body);
    writer.BeginObject();
    writer.Key("links");
    writer.BeginObject();
    for (const LinkStatus& link : links)
    {
        writer.Key(link.name);
        writer.WriteBoolean(link.bUp);
    }
    writer.EndObject();
    WriteMember(writer, "tsc", GetText(engine.GetTscState()));
    WriteList(writer, "robots", engine.GetRobotStatuses(), WriteRobot);
    WriteList(writer, "plans", engine.GetActivePlans(), WritePlan);
    WriteList(writer, "alarms", engine.GetActiveAlarms(), WriteAlarm);
    writer.EndObject();
    response.body += '\n';
    return response;
}

} // namespace ACS::Acsd
