#pragma once

#include <acs/json/JsonFields.hpp>
#include <acs/json/TaggedVariant.hpp>
#include <acs/json/TickCount.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan_json/PlanEnumNames.hpp>

#include <array>
#include <string_view>
#include <tuple>

namespace ACS::Json
{

// The JSON of a store and of a recording. It is not that of MCS-ACS, although a plan looks alike.

template <>
struct JsonFields<Planning::Job>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::Job::jobID),
        Optional("from", &Planning::Job::from),
        Optional("to", &Planning::Job::to));
};

template <>
struct JsonFields<Planning::Step>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("stepNo", &Planning::Step::stepNo),
        Required("action", &Planning::Step::action),
        Required("position", &Planning::Step::position),
        Optional("carrierIds", &Planning::Step::carrierIDs),
        Optional("jobs", &Planning::Step::jobs));
};

template <>
struct JsonFields<Planning::Plan>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::Plan::planID),
        Optional("lotId", &Planning::Plan::lotID),
        Optional("priority", &Planning::Plan::priority),
        Required("steps", &Planning::Plan::steps));
};

template <>
struct JsonFields<Planning::StepProgress>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("state", &Planning::StepProgress::state),
        Optional("jobs", &Planning::StepProgress::jobs));
};

template <>
struct JsonFields<Planning::PlanProgress>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("state", &Planning::PlanProgress::state),
        Optional("robotId", &Planning::PlanProgress::robotID),
        Optional("message", &Planning::PlanProgress::message),
        OptionalTicks("startedAt", &Planning::PlanProgress::startedAt),
        OptionalTicks("endedAt", &Planning::PlanProgress::endedAt),
        Required("steps", &Planning::PlanProgress::steps),
        Optional("arrived", &Planning::PlanProgress::bArrived),
        Optional("control", &Planning::PlanProgress::control),
        Optional("controlCount", &Planning::PlanProgress::controlCount),
        Optional("controlOrigin", &Planning::PlanProgress::controlOrigin),
        Optional("requestIds", &Planning::PlanProgress::requestIDs),
        OptionalTicks("queuedAt", &Planning::PlanProgress::queuedAt),
        OptionalTicks("storedAt", &Planning::PlanProgress::storedAt),
        Optional("priority", &Planning::PlanProgress::priority));
};

template <>
struct JsonFields<Planning::Alarm>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::Alarm::robotID),
        Required("errorCode", &Planning::Alarm::errorCode),
        Required("level", &Planning::Alarm::level),
        Required("message", &Planning::Alarm::message),
        Optional("planId", &Planning::Alarm::planID),
        Optional("stepNo", &Planning::Alarm::stepNo),
        Optional("jobId", &Planning::Alarm::jobID),
        Optional("mcsCode", &Planning::Alarm::mcsCode));
};

template <>
struct JsonFields<Planning::Block>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Planning::Block::kind),
        Required("id", &Planning::Block::id),
        Optional("reason", &Planning::Block::reason),
        RequiredTicks("since", &Planning::Block::since));
};

template <>
struct JsonFields<Planning::CarriersChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::CarriersChanged::robotID),
        Required("carrierIds", &Planning::CarriersChanged::carrierIDs),
        Optional("ports", &Planning::CarriersChanged::ports));
};

template <>
struct JsonFields<Planning::StartJob>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::StartJob::planID),
        Required("stepNo", &Planning::StartJob::stepNo),
        Required("jobId", &Planning::StartJob::jobID),
        Required("action", &Planning::StartJob::action),
        Required("position", &Planning::StartJob::position),
        Optional("from", &Planning::StartJob::from),
        Optional("to", &Planning::StartJob::to),
        Optional("carrierId", &Planning::StartJob::carrierID),
        Required("commandId", &Planning::StartJob::commandID),
        Optional("mark", &Planning::StartJob::progressToken),
        Optional("jobNumber", &Planning::StartJob::jobNumber),
        Optional("nodeId", &Planning::StartJob::nodeID));
};

template <>
struct JsonFields<Planning::RobotWorkChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::RobotWorkChanged::robotID),
        Optional("commandId", &Planning::RobotWorkChanged::commandID),
        Optional("earlierIds", &Planning::RobotWorkChanged::earlierIDs),
        Optional("mark", &Planning::RobotWorkChanged::progressToken),
        Optional("job", &Planning::RobotWorkChanged::job),
        Optional("pauseAsked", &Planning::RobotWorkChanged::bPauseAsked),
        Optional("doubtful", &Planning::RobotWorkChanged::bUnresolved),
        Optional("nodeIds", &Planning::RobotWorkChanged::nodeIDs),
        Optional("commandTaken", &Planning::RobotWorkChanged::bCommandTaken),
        Optional("jobNumber", &Planning::RobotWorkChanged::jobNumber),
        Optional("abandonedJobId", &Planning::RobotWorkChanged::abandonedJobID),
        Optional("resolvedJob", &Planning::RobotWorkChanged::resolvedJob));
};

template <>
struct JsonFields<Planning::PlanReport>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::PlanReport::planID),
        Required("planState", &Planning::PlanReport::state),
        Optional("message", &Planning::PlanReport::message));
};

template <>
struct JsonFields<Planning::StepReport>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::StepReport::planID),
        Required("robotId", &Planning::StepReport::robotID),
        Required("stepNo", &Planning::StepReport::stepNo),
        Required("stepState", &Planning::StepReport::state),
        Optional("message", &Planning::StepReport::message));
};

template <>
struct JsonFields<Planning::JobReport>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::JobReport::planID),
        Required("robotId", &Planning::JobReport::robotID),
        Required("stepNo", &Planning::JobReport::stepNo),
        Required("jobId", &Planning::JobReport::jobID),
        Required("jobState", &Planning::JobReport::state),
        Optional("message", &Planning::JobReport::message));
};

template <>
struct JsonFields<Planning::ErrorReport>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("set", &Planning::ErrorReport::bSet),
        Required("alarm", &Planning::ErrorReport::alarm));
};

template <>
struct JsonFields<Planning::ControlResultReport>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::ControlResultReport::planID),
        Required("control", &Planning::ControlResultReport::control),
        Required("succeeded", &Planning::ControlResultReport::bSucceeded),
        Optional("message", &Planning::ControlResultReport::message));
};

template <>
struct VariantTag<Planning::Report>
{
    static constexpr std::string_view NAME = "kind";
    static constexpr std::array<std::string_view, 5> WORDS{"Plan", "Step", "Job", "Error", "Control"};
};

template <>
struct JsonFields<Planning::PlanRecord>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("sequence", &Planning::PlanRecord::sequence),
        RequiredTicks("acceptedAt", &Planning::PlanRecord::acceptedAt),
        Required("plan", &Planning::PlanRecord::plan),
        Required("progress", &Planning::PlanRecord::progress),
        Optional("transactionId", &Planning::PlanRecord::transactionID));
};

template <>
struct JsonFields<Planning::OutboxEntry>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("sequence", &Planning::OutboxEntry::sequence),
        Required("transactionId", &Planning::OutboxEntry::transactionID),
        RequiredTicks("time", &Planning::OutboxEntry::time),
        Required("report", &Planning::OutboxEntry::report));
};

template <>
struct JsonFields<Planning::CommandReceipt>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("owner", &Planning::CommandReceipt::owner),
        Required("key", &Planning::CommandReceipt::key),
        Required("answer", &Planning::CommandReceipt::answer),
        RequiredTicks("time", &Planning::CommandReceipt::time));
};

} // namespace ACS::Json
