#pragma once

#include "view/SiteView.hpp"
#include "view/StateView.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/json/JsonFields.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <tuple>

/// The members of the views in JSON, as docs/reference/openapi.json has them.
namespace ACS::Json
{

template <>
struct ValueEncoder<Core::WallTime>
{
    static void Encode(Core::WallTime time, JsonWriter& writer)
    {
        writer.WritePlainString(Core::FormatUTC(time));
    }
};

template <>
struct ValueEncoder<std::map<std::string, std::size_t>>
{
    static void Encode(const std::map<std::string, std::size_t>& counts, JsonWriter& writer)
    {
        writer.BeginObject();
        for (const auto& [name, count] : counts)
        {
            writer.Key(name);
            writer.WriteUnsigned(count);
        }
        writer.EndObject();
    }
};

template <>
struct JsonFields<Acsd::RobotReasonView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Acsd::RobotReasonView::robotID),
        Required("reason", &Acsd::RobotReasonView::reason));
};

template <>
struct JsonFields<Acsd::WaitView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("message", &Acsd::WaitView::message),
        Required("since", &Acsd::WaitView::since),
        Nullable("queuePosition", &Acsd::WaitView::queuePosition),
        Required("robots", &Acsd::WaitView::robots));
};

template <>
struct JsonFields<Acsd::JobView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Acsd::JobView::jobID),
        Nullable("from", &Acsd::JobView::from),
        Nullable("to", &Acsd::JobView::to),
        Required("status", &Acsd::JobView::status));
};

template <>
struct JsonFields<Acsd::StepView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("stepNo", &Acsd::StepView::stepNo),
        Required("action", &Acsd::StepView::action),
        Required("position", &Acsd::StepView::position),
        Required("status", &Acsd::StepView::status),
        Optional("carrierIds", &Acsd::StepView::carrierIDs),
        Optional("jobs", &Acsd::StepView::jobs));
};

template <>
struct JsonFields<Acsd::PlanView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Acsd::PlanView::planID),
        Required("lotId", &Acsd::PlanView::lotID),
        Nullable("priority", &Acsd::PlanView::priority),
        Required("status", &Acsd::PlanView::status),
        Nullable("robotId", &Acsd::PlanView::robotID),
        Required("stepNo", &Acsd::PlanView::stepNo),
        Nullable("jobId", &Acsd::PlanView::jobID),
        Nullable("currentAction", &Acsd::PlanView::currentAction),
        Required("acceptedAt", &Acsd::PlanView::acceptedAt),
        Nullable("startedAt", &Acsd::PlanView::startedAt),
        Nullable("endedAt", &Acsd::PlanView::endedAt),
        Required("message", &Acsd::PlanView::message),
        Nullable("waits", &Acsd::PlanView::waits),
        Required("steps", &Acsd::PlanView::steps));
};

template <>
struct JsonFields<Acsd::PoseView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Acsd::PoseView::x),
        Required("y", &Acsd::PoseView::y),
        Required("theta", &Acsd::PoseView::theta));
};

template <>
struct JsonFields<Acsd::RouteNodeView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodeId", &Acsd::RouteNodeView::nodeID),
        Required("reserved", &Acsd::RouteNodeView::bReserved));
};

template <>
struct JsonFields<Acsd::RobotErrorView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("type", &Acsd::RobotErrorView::type),
        Required("level", &Acsd::RobotErrorView::level),
        Required("description", &Acsd::RobotErrorView::description));
};

template <>
struct JsonFields<Acsd::RobotView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Acsd::RobotView::robotID),
        Required("type", &Acsd::RobotView::type),
        Required("driver", &Acsd::RobotView::driver),
        Required("status", &Acsd::RobotView::status),
        Required("position", &Acsd::RobotView::position),
        Nullable("node", &Acsd::RobotView::nodeID),
        Nullable("nextNode", &Acsd::RobotView::nextNodeID),
        Nullable("pose", &Acsd::RobotView::pose),
        Nullable("battery", &Acsd::RobotView::battery),
        Nullable("planId", &Acsd::RobotView::planID),
        Nullable("stepNo", &Acsd::RobotView::stepNo),
        Nullable("jobId", &Acsd::RobotView::jobID),
        Required("route", &Acsd::RobotView::route),
        Required("reservedNodes", &Acsd::RobotView::reservedNodeIDs),
        Required("ports", &Acsd::RobotView::ports),
        Required("carrierIds", &Acsd::RobotView::carrierIDs),
        Required("maintenance", &Acsd::RobotView::bInMaintenance),
        Nullable("reason", &Acsd::RobotView::reason),
        Nullable("armUp", &Acsd::RobotView::bArmUp),
        Nullable("topic", &Acsd::RobotView::topic),
        Nullable("protocolVersion", &Acsd::RobotView::protocolVersion),
        Nullable("mode", &Acsd::RobotView::mode),
        Required("errors", &Acsd::RobotView::errors),
        Required("warnings", &Acsd::RobotView::warnings),
        Nullable("lastMessageAt", &Acsd::RobotView::lastMessageAt));
};

template <>
struct JsonFields<Acsd::AlarmView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Acsd::AlarmView::robotID),
        Required("errorCode", &Acsd::AlarmView::errorCode),
        Required("level", &Acsd::AlarmView::level),
        Required("title", &Acsd::AlarmView::title),
        Required("message", &Acsd::AlarmView::message),
        Required("cause", &Acsd::AlarmView::cause),
        Required("remedy", &Acsd::AlarmView::remedy),
        Required("since", &Acsd::AlarmView::since),
        Nullable("planId", &Acsd::AlarmView::planID),
        Nullable("stepNo", &Acsd::AlarmView::stepNo),
        Nullable("jobId", &Acsd::AlarmView::jobID));
};

template <>
struct JsonFields<Acsd::LinkView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("name", &Acsd::LinkView::name),
        Required("up", &Acsd::LinkView::bUp),
        Nullable("reason", &Acsd::LinkView::reason),
        Required("since", &Acsd::LinkView::since),
        Nullable("broker", &Acsd::LinkView::broker));
};

template <>
struct JsonFields<Acsd::OutboxView>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("reports", &Acsd::OutboxView::reports), Nullable("oldest", &Acsd::OutboxView::oldest));
};

template <>
struct JsonFields<Acsd::RefusedReportView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("command", &Acsd::RefusedReportView::command),
        Nullable("planId", &Acsd::RefusedReportView::planID),
        Required("message", &Acsd::RefusedReportView::message),
        Required("retried", &Acsd::RefusedReportView::bRetried));
};

template <>
struct JsonFields<Acsd::RefusedReportsView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("count", &Acsd::RefusedReportsView::count),
        Nullable("last", &Acsd::RefusedReportsView::last));
};

template <>
struct JsonFields<Acsd::PlanCountsView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("active", &Acsd::PlanCountsView::active),
        Required("waiting", &Acsd::PlanCountsView::waiting));
};

template <>
struct JsonFields<Acsd::RobotCountsView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("total", &Acsd::RobotCountsView::total),
        Required("byStatus", &Acsd::RobotCountsView::byStatus));
};

template <>
struct JsonFields<Acsd::AlarmCountsView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("heavy", &Acsd::AlarmCountsView::heavy),
        Required("light", &Acsd::AlarmCountsView::light));
};

template <>
struct JsonFields<Acsd::StatusView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("version", &Acsd::StatusView::version),
        Required("startedAt", &Acsd::StatusView::startedAt),
        Required("ready", &Acsd::StatusView::bReady),
        Required("notReadyReasons", &Acsd::StatusView::notReadyReasons),
        Nullable("isConnected", &Acsd::StatusView::bConnected),
        Required("links", &Acsd::StatusView::links),
        Required("tsc", &Acsd::StatusView::tsc),
        Nullable("tscReason", &Acsd::StatusView::tscReason),
        Required("outbox", &Acsd::StatusView::outbox),
        Required("refusedReports", &Acsd::StatusView::refusedReports),
        Required("plans", &Acsd::StatusView::plans),
        Required("robots", &Acsd::StatusView::robots),
        Required("alarms", &Acsd::StatusView::alarms),
        Required("siteRevision", &Acsd::StatusView::siteRevision));
};

template <>
struct JsonFields<Acsd::SiteNodeView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodeId", &Acsd::SiteNodeView::nodeID),
        Required("x", &Acsd::SiteNodeView::x),
        Required("y", &Acsd::SiteNodeView::y),
        Required("mapId", &Acsd::SiteNodeView::mapID));
};

template <>
struct JsonFields<Acsd::SiteEdgeView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("edgeId", &Acsd::SiteEdgeView::edgeID),
        Required("startNodeId", &Acsd::SiteEdgeView::startNodeID),
        Required("endNodeId", &Acsd::SiteEdgeView::endNodeID),
        Nullable("trajectory", &Acsd::SiteEdgeView::trajectory));
};

template <>
struct JsonFields<Acsd::SiteStationView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("stationId", &Acsd::SiteStationView::stationID),
        Required("nodeIds", &Acsd::SiteStationView::nodeIDs));
};

template <>
struct JsonFields<Acsd::BlockView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Acsd::BlockView::kind),
        Required("id", &Acsd::BlockView::placeID),
        Required("reason", &Acsd::BlockView::reason),
        Required("since", &Acsd::BlockView::since));
};

template <>
struct JsonFields<Acsd::SiteView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodes", &Acsd::SiteView::nodes),
        Required("edges", &Acsd::SiteView::edges),
        Required("stations", &Acsd::SiteView::stations),
        Required("blocked", &Acsd::SiteView::blocked));
};

} // namespace ACS::Json
