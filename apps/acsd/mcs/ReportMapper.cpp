#include "mcs/ReportMapper.hpp"

#include "operator/AlarmText.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr double FULL_CIRCLE = 360.0;

// The two enumerations of each pair list the same words in the same order: the casts below rest on it.
static_assert(static_cast<int>(Planning::EPlanState::Aborted) == static_cast<int>(Protocol::EPlanStatus::Aborted));
static_assert(static_cast<int>(Planning::EPlanState::Paused) == static_cast<int>(Protocol::EPlanStatus::Paused));
static_assert(static_cast<int>(Planning::EStepState::Skipped) == static_cast<int>(Protocol::EStepStatus::Skipped));
static_assert(static_cast<int>(Planning::EJobState::Failed) == static_cast<int>(Protocol::EJobStatus::Failed));
static_assert(static_cast<int>(Planning::ERobotStatus::Stopped) == static_cast<int>(Protocol::ERobotStatus::Stopped));
static_assert(static_cast<int>(Planning::ERobotStatus::Arrival) == static_cast<int>(Protocol::ERobotStatus::Arrival));
static_assert(static_cast<int>(Planning::ERobotType::CR) == static_cast<int>(Protocol::ERobotType::Control));
static_assert(static_cast<int>(Planning::ETscState::Paused) == static_cast<int>(Protocol::ETscState::Paused));
static_assert(static_cast<int>(Planning::ETscState::Pausing) == static_cast<int>(Protocol::ETscState::Pausing));
static_assert(static_cast<int>(Planning::EAlarmLevel::Light) == static_cast<int>(Protocol::EErrorLevel::Light));

template <typename TReport>
Protocol::AcsPayload MakeResult(const Planning::ControlResultReport& report, const MessageStyle& style)
{
    const Protocol::EReportResult failure =
        style.bResultFailureIsFail ? Protocol::EReportResult::Fail : Protocol::EReportResult::Failed;
    TReport result;
    result.planID = report.planID;
    result.result = report.bSucceeded ? Protocol::EReportResult::Success : failure;
    result.message = report.message;
    return result;
}

Protocol::AcsPayload MakeControlResult(const Planning::ControlResultReport& report, const MessageStyle& style)
{
    switch (report.control)
    {
        case Planning::EPlanControl::Cancel:
            return MakeResult<Protocol::CancelResultReport>(report, style);
        case Planning::EPlanControl::Abort:
            return MakeResult<Protocol::AbortResultReport>(report, style);
        case Planning::EPlanControl::Pause:
            return MakeResult<Protocol::PauseResultReport>(report, style);
        case Planning::EPlanControl::Resume:
            return MakeResult<Protocol::ResumeResultReport>(report, style);
        default:
            assert(false && "unhandled EPlanControl");
            return MakeResult<Protocol::CancelResultReport>(report, style);
    }
}

Protocol::AcsPayload MakePayload(const Planning::Report& report, const MessageStyle& style)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::PlanReport& plan) -> Protocol::AcsPayload {
                return Protocol::PlanReport{plan.planID, static_cast<Protocol::EPlanStatus>(plan.state), plan.message};
            },
            [](const Planning::StepReport& step) -> Protocol::AcsPayload {
                return Protocol::StepReport{
                    step.planID,
                    step.robotID,
                    step.stepNo,
                    static_cast<Protocol::EStepStatus>(step.state),
                    step.message};
            },
            [](const Planning::JobReport& job) -> Protocol::AcsPayload {
                return Protocol::JobReport{
                    job.planID,
                    job.robotID,
                    job.stepNo,
                    job.jobID,
                    static_cast<Protocol::EJobStatus>(job.state),
                    job.message};
            },
            [&style](const Planning::ErrorReport& error) -> Protocol::AcsPayload {
                return MakeErrorReport(error.alarm, error.bSet, style);
            },
            [&style](const Planning::ControlResultReport& result) -> Protocol::AcsPayload {
                return MakeControlResult(result, style);
            }},
        report);
}

Protocol::RobotPosition MakePosition(const Planning::RobotPose& pose)
{
    const double turned = std::fmod(pose.theta * (FULL_CIRCLE / 2) / std::numbers::pi, FULL_CIRCLE);
    const double degrees = turned < 0 ? turned + FULL_CIRCLE : turned;
    return Protocol::RobotPosition{
        pose.robotID,
        pose.x,
        pose.y,
        degrees < FULL_CIRCLE ? degrees : 0.0, // slightly below 0 rounds to the full circle
        std::round(pose.batteryPercent)};
}

/// Size of the whole message. The session adds a UUID as its transactionId.
std::size_t CountBytes(const Protocol::RobotPositionUpdate& update)
{
    constexpr std::size_t UUID_LENGTH = 36;
    std::string text;
    Protocol::AcsCodec::EncodeRequest({std::string(UUID_LENGTH, '0'), {}, update}, text);
    return text.size();
}

} // namespace

Protocol::AcsRequest MakeReportRequest(
    const Planning::OutboxEntry& entry,
    std::chrono::minutes offset,
    const MessageStyle& style)
{
    return {entry.transactionID, Core::Timestamp{entry.time, offset}, MakePayload(entry.report, style)};
}

Protocol::RobotStatusUpdate MakeStatusUpdate(const Planning::RobotStatus& status, const MessageStyle& style)
{
    Protocol::RobotStatusUpdate update;
    update.robotID = status.robotID;
    update.robotType = static_cast<Protocol::ERobotType>(status.type);
    update.robotStatus = static_cast<Protocol::ERobotStatus>(status.status);
    if (!status.position.empty())
    {
        update.position = status.position;
    }
    update.carrierIDs = status.carrierIDs;
    if (style.bEmptyCarriersOmitted)
    {
        std::erase(update.carrierIDs, std::nullopt);
    }
    update.planID = status.planID;
    update.stepNo = status.stepNo;
    update.jobID = status.jobID;
    update.message = status.message;
    return update;
}

Protocol::TscStateUpdate MakeTscUpdate(Planning::ETscState state)
{
    return Protocol::TscStateUpdate{static_cast<Protocol::ETscState>(state)};
}

std::vector<Protocol::RobotPositionUpdate> MakePositionUpdates(
    const std::vector<Planning::RobotPose>& poses,
    const MessageStyle& style)
{
    std::vector<Protocol::RobotPositionUpdate> updates(1);
    const std::size_t frame = style.longestText > 0 ? CountBytes({}) : 0;
    std::size_t bytes = frame;
    for (const Planning::RobotPose& pose : poses)
    {
        Protocol::RobotPosition position = MakePosition(pose);
        const std::size_t own = style.longestText > 0 ? CountBytes({{position}}) - frame + 1 : 0; // and a comma
        if (style.longestText > 0 && bytes + own > style.longestText && !updates.back().robots.empty())
        {
            updates.emplace_back();
            bytes = frame;
        }
        bytes += own;
        updates.back().robots.push_back(std::move(position));
    }
    return updates;
}

Protocol::PlanEntry MakePlanEntry(
    const Planning::PlanSummary& summary,
    std::chrono::minutes offset,
    const MessageStyle& style)
{
    Protocol::PlanEntry entry;
    entry.planID = summary.planID;
    entry.robotID = summary.robotID;
    if (!entry.robotID.has_value() && style.bUnassignedRobotEmpty)
    {
        entry.robotID.emplace();
    }
    entry.status = static_cast<Protocol::EPlanStatus>(summary.state);
    entry.stepNo = summary.stepNo;
    entry.jobID = summary.jobID;
    entry.currentAction = summary.currentAction;
    entry.startTime = Core::Timestamp{summary.startTime, offset};
    if (summary.endTime.has_value())
    {
        entry.endTime = Core::Timestamp{*summary.endTime, offset};
    }
    return entry;
}

Protocol::ErrorReport MakeErrorReport(const Planning::Alarm& ownAlarm, bool bSet, const MessageStyle& style)
{
    Planning::Alarm told = ownAlarm;
    told.message = MakeAlarmText(ownAlarm);
    const Planning::Alarm alarm = Rename(std::move(told), style.errors);
    Protocol::ErrorReport report;
    report.robotID = alarm.robotID;
    report.planID = alarm.planID;
    report.bSet = bSet;
    report.stepNo = alarm.stepNo;
    report.jobID = alarm.jobID;
    report.errorCode = alarm.errorCode;
    report.level = static_cast<Protocol::EErrorLevel>(alarm.level);
    report.message = alarm.message;
    return report;
}

} // namespace ACS::Acsd
