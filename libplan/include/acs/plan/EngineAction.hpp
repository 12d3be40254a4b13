#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <cstdint>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace ACS::Planning
{

enum class EEngineTimer : std::uint8_t
{
    Dispatch,       ///< Look for work for the robots.
    StoreRetry,     ///< Try again to store what could not be stored.
    Acknowledged,   ///< Store which reports were acknowledged.
    DriveExtension, ///< Of a robot: its drive has not been confirmed, release the next nodes anyway.
    ControlConfirm, ///< Of a robot: it has not confirmed that it stopped, or goes on.
    JobTimeout,     ///< Of a robot: its job takes too long.
    HomeRetry,      ///< Of a robot: try again to send it home.
    Startup,        ///< After a start: continue without the robots that have not reported their position.
    ChargeRetry,    ///< Of a robot: it was told to charge and has not shown that it does.
    JobEnd,         ///< Of a robot: it has not told the end of a job that was given up.
    DriveStall,     ///< Of a robot: its drive has passed no node for long.
    LoadAlarm,      ///< Of a robot: the alarm about its reported loads may be set or updated again.
};

/// One timer; of a robot or, with an empty robotID, of the engine.
struct EngineTimer
{
    EEngineTimer kind = EEngineTimer::Dispatch;
    std::string robotID;

    bool operator==(const EngineTimer&) const = default;

    bool operator<(const EngineTimer& other) const noexcept
    {
        return std::tie(kind, robotID) < std::tie(other.kind, other.robotID);
    }
};

/// Append the batch to the store, as one transaction, and call PlanEngine::OnStored with the result. The only action of its
/// call: what depends on it is withheld until then.
struct StorePlans
{
    StoreBatch batch;

    bool operator==(const StorePlans&) const = default;
};

/// The one answer to a command that has a replyToken: the Ack of SubmitPlan and ControlPlan, and what the operator is told of
/// the others.
struct ReplyCommand
{
    ReplyToken replyToken = 0;
    bool bAccepted = false;
    std::string message;

    bool operator==(const ReplyCommand&) const = default;
};

/// Send the report, now or when the MCS is there again; tell MessageAcknowledged when it is acknowledged. Also kept:
/// see PlanEngine::GetUnacknowledged.
struct SendReport
{
    OutboxEntry entry;

    bool operator==(const SendReport&) const = default;
};

struct CommandRobot
{
    std::string robotID;
    RobotCommand command;

    bool operator==(const CommandRobot&) const = default;
};

/// Something in the robot's status has changed (RobotStatusUpdate). Not stored: only the latest counts.
struct RobotStatusChanged
{
    RobotStatus status;

    bool operator==(const RobotStatusChanged&) const = default;
};

/// TscStateUpdate. Only the latest counts.
struct TscStateChanged
{
    ETscState state = ETscState::Auto;

    bool operator==(const TscStateChanged&) const = default;
};

/// Call PlanEngine::OnTimer after the delay (zero: as soon as possible, but not inside this call). A running timer of
/// this name starts again.
struct StartEngineTimer
{
    EngineTimer timer;
    Core::Duration delay{};

    bool operator==(const StartEngineTimer&) const = default;
};

struct CancelEngineTimer
{
    EngineTimer timer;

    bool operator==(const CancelEngineTimer&) const = default;
};

using EngineAction = std::variant<
    StorePlans,
    ReplyCommand,
    SendReport,
    CommandRobot,
    RobotStatusChanged,
    TscStateChanged,
    StartEngineTimer,
    CancelEngineTimer>;
using EngineActions = std::vector<EngineAction>;

} // namespace ACS::Planning
