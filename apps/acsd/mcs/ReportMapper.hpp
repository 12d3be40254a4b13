#pragma once

#include "mcs/MessageStyle.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <vector>

namespace ACS::Acsd
{

/// Convert reports and states of the engine to messages for the MCS. The offset is that of the site's local time.

/// Has the report's own transactionId and time, so that a resent report is the same message.
[[nodiscard]] Protocol::AcsRequest MakeReportRequest(
    const Planning::OutboxEntry& entry,
    std::chrono::minutes offset,
    const MessageStyle& style = {});

[[nodiscard]] Protocol::RobotStatusUpdate MakeStatusUpdate(
    const Planning::RobotStatus& status,
    const MessageStyle& style = {});

[[nodiscard]] Protocol::TscStateUpdate MakeTscUpdate(Planning::ETscState state);

/// All robots in one update, or in several if it would be longer than the style allows (section 6.19), each with at least
/// one robot. Angles are converted from radians to degrees from 0 to below 360, the battery to a whole number.
[[nodiscard]] std::vector<Protocol::RobotPositionUpdate> MakePositionUpdates(
    const std::vector<Planning::RobotPose>& poses,
    const MessageStyle& style = {});

[[nodiscard]] Protocol::PlanEntry MakePlanEntry(
    const Planning::PlanSummary& summary,
    std::chrono::minutes offset,
    const MessageStyle& style = {});

[[nodiscard]] Protocol::ErrorReport MakeErrorReport(
    const Planning::Alarm& ownAlarm,
    bool bSet,
    const MessageStyle& style = {});

} // namespace ACS::Acsd
