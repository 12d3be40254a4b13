#pragma once

#include "api/ApiTypes.hpp"
#include <acs/json/JsonFields.hpp>

#include <tuple>

/// The members of the answers. Required is what a table or a command needs to name a thing; the rest may be missing, so that a
/// program and an acsd of different versions understand each other.
namespace ACS::Json
{

template <>
struct JsonFields<Acsctl::LinkInfo>
{
    using T = Acsctl::LinkInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("name", &T::name),
        Required("up", &T::bUp),
        Nullable("reason", &T::reason),
        Nullable("since", &T::since),
        Nullable("broker", &T::broker));
};

template <>
struct JsonFields<Acsctl::OutboxInfo>
{
    using T = Acsctl::OutboxInfo;
    static constexpr auto FIELDS = std::make_tuple(Required("reports", &T::reports), Nullable("oldest", &T::oldest));
};

template <>
struct JsonFields<Acsctl::RefusedReport>
{
    using T = Acsctl::RefusedReport;
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("command", &T::command),
        Nullable("planId", &T::planID),
        Defaulted("message", &T::message),
        Defaulted("retried", &T::bRetried));
};

template <>
struct JsonFields<Acsctl::RefusedReportsInfo>
{
    using T = Acsctl::RefusedReportsInfo;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("count", &T::count), Nullable("last", &T::last));
};

template <>
struct JsonFields<Acsctl::PlanCounts>
{
    using T = Acsctl::PlanCounts;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("active", &T::active), Defaulted("waiting", &T::waiting));
};

template <>
struct JsonFields<Acsctl::RobotCounts>
{
    using T = Acsctl::RobotCounts;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("total", &T::total), Defaulted("byStatus", &T::byStatus));
};

template <>
struct JsonFields<Acsctl::AlarmCounts>
{
    using T = Acsctl::AlarmCounts;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("heavy", &T::heavy), Defaulted("light", &T::light));
};

template <>
struct JsonFields<Acsctl::StatusInfo>
{
    using T = Acsctl::StatusInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("version", &T::version),
        Nullable("startedAt", &T::startedAt),
        Defaulted("uptimeSeconds", &T::uptimeSeconds),
        Required("ready", &T::bReady),
        Defaulted("notReadyReasons", &T::notReadyReasons),
        Nullable("isConnected", &T::bConnected),
        Required("links", &T::links),
        Required("tsc", &T::tsc),
        Nullable("tscReason", &T::tscReason),
        Defaulted("outbox", &T::outbox),
        Defaulted("refusedReports", &T::refusedReports),
        Defaulted("plans", &T::plans),
        Defaulted("robots", &T::robots),
        Defaulted("alarms", &T::alarms));
};

template <>
struct JsonFields<Acsctl::RobotReason>
{
    using T = Acsctl::RobotReason;
    static constexpr auto FIELDS = std::make_tuple(Required("robotId", &T::robotID), Defaulted("reason", &T::reason));
};

template <>
struct JsonFields<Acsctl::WaitsInfo>
{
    using T = Acsctl::WaitsInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("message", &T::message),
        Nullable("since", &T::since),
        Nullable("queuePosition", &T::queuePosition),
        Defaulted("robots", &T::robots));
};

template <>
struct JsonFields<Acsctl::JobInfo>
{
    using T = Acsctl::JobInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &T::jobID),
        Nullable("from", &T::from),
        Nullable("to", &T::to),
        Defaulted("status", &T::status));
};

template <>
struct JsonFields<Acsctl::StepInfo>
{
    using T = Acsctl::StepInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("stepNo", &T::stepNo),
        Defaulted("action", &T::action),
        Defaulted("position", &T::position),
        Defaulted("status", &T::status),
        Defaulted("carrierIds", &T::carrierIDs),
        Defaulted("jobs", &T::jobs));
};

template <>
struct JsonFields<Acsctl::PlanInfo>
{
    using T = Acsctl::PlanInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &T::planID),
        Nullable("lotId", &T::lotID),
        Nullable("priority", &T::priority),
        Required("status", &T::status),
        Nullable("robotId", &T::robotID),
        Defaulted("stepNo", &T::stepNo),
        Nullable("jobId", &T::jobID),
        Nullable("currentAction", &T::currentAction),
        Nullable("acceptedAt", &T::acceptedAt),
        Nullable("startedAt", &T::startedAt),
        Nullable("endedAt", &T::endedAt),
        Defaulted("message", &T::message),
        Nullable("waits", &T::waits),
        Defaulted("steps", &T::steps));
};

template <>
struct JsonFields<Acsctl::RouteNode>
{
    using T = Acsctl::RouteNode;
    static constexpr auto FIELDS =
        std::make_tuple(Required("nodeId", &T::nodeID), Defaulted("reserved", &T::bReserved));
};

template <>
struct JsonFields<Acsctl::RobotError>
{
    using T = Acsctl::RobotError;
    static constexpr auto FIELDS = std::make_tuple(
        Required("type", &T::type),
        Defaulted("level", &T::level),
        Defaulted("description", &T::description));
};

template <>
struct JsonFields<Acsctl::PoseInfo>
{
    using T = Acsctl::PoseInfo;
    static constexpr auto FIELDS =
        std::make_tuple(Required("x", &T::x), Required("y", &T::y), Nullable("theta", &T::theta));
};

template <>
struct JsonFields<Acsctl::RobotInfo>
{
    using T = Acsctl::RobotInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &T::robotID),
        Defaulted("type", &T::type),
        Defaulted("driver", &T::driver),
        Required("status", &T::status),
        Defaulted("position", &T::position),
        Nullable("node", &T::node),
        Nullable("nextNode", &T::nextNode),
        Nullable("pose", &T::pose),
        Nullable("battery", &T::battery),
        Nullable("planId", &T::planID),
        Nullable("stepNo", &T::stepNo),
        Nullable("jobId", &T::jobID),
        Defaulted("route", &T::route),
        Defaulted("reservedNodes", &T::reservedNodes),
        Defaulted("carrierIds", &T::carrierIDs),
        Defaulted("ports", &T::ports),
        Defaulted("maintenance", &T::bMaintenance),
        Nullable("reason", &T::reason),
        Nullable("armUp", &T::bArmUp),
        Nullable("topic", &T::topic),
        Nullable("protocolVersion", &T::protocolVersion),
        Nullable("mode", &T::mode),
        Defaulted("errors", &T::errors),
        Defaulted("warnings", &T::warnings),
        Nullable("lastMessageAt", &T::lastMessageAt));
};

template <>
struct JsonFields<Acsctl::AlarmInfo>
{
    using T = Acsctl::AlarmInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &T::robotID),
        Required("errorCode", &T::errorCode),
        Required("level", &T::level),
        Defaulted("message", &T::message),
        Nullable("since", &T::since),
        Defaulted("title", &T::title),
        Defaulted("cause", &T::cause),
        Defaulted("remedy", &T::remedy),
        Nullable("planId", &T::planID),
        Nullable("stepNo", &T::stepNo),
        Nullable("jobId", &T::jobID));
};

template <>
struct JsonFields<Acsctl::BlockInfo>
{
    using T = Acsctl::BlockInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &T::kind),
        Required("id", &T::id),
        Nullable("reason", &T::reason),
        Nullable("since", &T::since));
};

template <>
struct JsonFields<Acsctl::QueueEntry>
{
    using T = Acsctl::QueueEntry;
    static constexpr auto FIELDS = std::make_tuple(
        Required("position", &T::position),
        Required("planId", &T::planID),
        Nullable("priority", &T::priority),
        Nullable("acceptedAt", &T::acceptedAt),
        Nullable("waits", &T::waits));
};

template <>
struct JsonFields<Acsctl::PlansAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("plans", &Acsctl::PlansAnswer::plans));
};

template <>
struct JsonFields<Acsctl::RobotsAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("robots", &Acsctl::RobotsAnswer::robots));
};

template <>
struct JsonFields<Acsctl::AlarmsAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("alarms", &Acsctl::AlarmsAnswer::alarms));
};

template <>
struct JsonFields<Acsctl::LinksAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("links", &Acsctl::LinksAnswer::links));
};

template <>
struct JsonFields<Acsctl::QueueAnswer>
{
    using T = Acsctl::QueueAnswer;
    static constexpr auto FIELDS = std::make_tuple(Required("plans", &T::plans), Defaulted("outbox", &T::outbox));
};

template <>
struct JsonFields<Acsctl::NodeInfo>
{
    static constexpr auto FIELDS = std::make_tuple(Required("nodeId", &Acsctl::NodeInfo::nodeID));
};

template <>
struct JsonFields<Acsctl::EdgeInfo>
{
    using T = Acsctl::EdgeInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("edgeId", &T::edgeID),
        Required("startNodeId", &T::startNodeID),
        Required("endNodeId", &T::endNodeID));
};

template <>
struct JsonFields<Acsctl::StationInfo>
{
    using T = Acsctl::StationInfo;
    static constexpr auto FIELDS =
        std::make_tuple(Required("stationId", &T::stationID), Defaulted("nodeIds", &T::nodeIDs));
};

template <>
struct JsonFields<Acsctl::SiteAnswer>
{
    using T = Acsctl::SiteAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("nodes", &T::nodes),
        Defaulted("edges", &T::edges),
        Defaulted("stations", &T::stations),
        Required("blocked", &T::blocked));
};

template <>
struct JsonFields<Acsctl::SnapshotAnswer>
{
    using T = Acsctl::SnapshotAnswer;
    static constexpr auto FIELDS = std::make_tuple(
        Required("eventId", &T::eventID),
        Required("status", &T::status),
        Required("plans", &T::plans),
        Required("robots", &T::robots),
        Required("alarms", &T::alarms));
};

template <>
struct JsonFields<Acsctl::TraceLine>
{
    using T = Acsctl::TraceLine;
    static constexpr auto FIELDS = std::make_tuple(
        Required("time", &T::time),
        Nullable("program", &T::program),
        Required("link", &T::link),
        Nullable("direction", &T::direction),
        Nullable("robot", &T::robot),
        Nullable("topic", &T::topic),
        Defaulted("text", &T::text),
        Nullable("lost", &T::lost));
};

template <>
struct JsonFields<Acsctl::AuditLine>
{
    using T = Acsctl::AuditLine;
    static constexpr auto FIELDS = std::make_tuple(
        Required("time", &T::time),
        Nullable("peer", &T::peer),
        Nullable("name", &T::name),
        Nullable("role", &T::role),
        Nullable("method", &T::method),
        Nullable("request", &T::request),
        Nullable("status", &T::status),
        Defaulted("answer", &T::answer),
        Nullable("lost", &T::lost));
};

template <>
struct JsonFields<Acsctl::EntryEvent>
{
    using T = Acsctl::EntryEvent;
    static constexpr auto FIELDS = std::make_tuple(
        Required("time", &T::time),
        Required("kind", &T::kind),
        Nullable("robotId", &T::robotID),
        Nullable("planId", &T::planID),
        Required("text", &T::text));
};

template <>
struct JsonFields<Acsctl::ActionInfo>
{
    using T = Acsctl::ActionInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionId", &T::actionID),
        Required("actionType", &T::actionType),
        Required("status", &T::status),
        Defaulted("resultDescription", &T::resultDescription),
        Nullable("requestedAt", &T::requestedAt),
        Nullable("endedAt", &T::endedAt));
};

template <>
struct JsonFields<Acsctl::ActionParameterInfo>
{
    using T = Acsctl::ActionParameterInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("key", &T::key),
        Defaulted("valueType", &T::valueType),
        Defaulted("required", &T::bRequired));
};

template <>
struct JsonFields<Acsctl::ActionOfferInfo>
{
    using T = Acsctl::ActionOfferInfo;
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &T::actionType),
        Defaulted("description", &T::description),
        Defaulted("parameters", &T::parameters));
};

template <>
struct JsonFields<Acsctl::ActionsAnswer>
{
    using T = Acsctl::ActionsAnswer;
    static constexpr auto FIELDS = std::make_tuple(Required("actions", &T::actions), Defaulted("offered", &T::offered));
};

template <>
struct JsonFields<Acsctl::ActionAcceptedAnswer>
{
    using T = Acsctl::ActionAcceptedAnswer;
    static constexpr auto FIELDS =
        std::make_tuple(Required("message", &T::message), Required("actionId", &T::actionID));
};

template <>
struct JsonFields<Acsctl::MessageAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("message", &Acsctl::MessageAnswer::message));
};

template <>
struct JsonFields<Acsctl::ErrorAnswer>
{
    static constexpr auto FIELDS = std::make_tuple(Required("error", &Acsctl::ErrorAnswer::error));
};

} // namespace ACS::Json
