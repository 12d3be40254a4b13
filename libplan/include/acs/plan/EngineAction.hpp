#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// What the engine does when the timer expires. The first three, Startup and AlarmQuiet belong to the engine, the others to a
/// robot.
enum class EEngineTimer : std::uint8_t
{
    Dispatch,       ///< Assign plans and drives to robots.
    StoreRetry,     ///< Store again what could not be stored.
    Acknowledged,   ///< Store which reports were acknowledged.
    DriveExtension, ///< The robot has not confirmed its drive: release the next nodes anyway.
    ControlConfirm, ///< The robot has not confirmed that it stopped or resumed.
    JobTimeout,     ///< The job exceeds ActionRule::timeout.
    HomeRetry,      ///< Send the robot to its parking position again.
    Startup,        ///< After a start: continue without the robots that have not reported their position.
    ChargeRetry,    ///< The robot does not show that it charges: repeat StartCharging.
    JobEnd,         ///< The robot has not reported the end of a cancelled job.
    DriveStall,     ///< The robot has passed no node for EngineOptions::stallTimeout.
    RejectionRetry, ///< Send a command again to the robot that rejected one.
    DriveWait,      ///< The robot has waited for EngineOptions::waitTimeout.
    LoadAlarm,      ///< The alarm about reported loads may be set or updated again.
    AlarmQuiet,     ///< An alarm that came and went too often may be cleared.
};

/// A timer of a robot, or of the engine if robotID is empty.
struct EngineTimer
{
    EEngineTimer kind = EEngineTimer::Dispatch; ///< There is one timer of each kind, or of each kind and robot.
    std::string robotID;                        ///< Empty: a timer of the engine.

    bool operator==(const EngineTimer&) const = default;

    /// An order for use as a key.
    bool operator<(const EngineTimer& other) const noexcept
    {
        return std::tie(kind, robotID) < std::tie(other.kind, other.robotID);
    }
};

/// Append the batch to the store as one transaction and call PlanEngine::OnStored with the result. It is the only action of
/// its call: actions that depend on the batch are withheld until OnStored.
struct StorePlans
{
    StoreBatch batch; ///< For IPlanStore::Append.

    bool operator==(const StorePlans&) const = default;
};

/// The only answer to a command with a replyToken: the Ack of SubmitPlan and ControlPlan, the operator's answer for the other
/// commands.
struct ReplyCommand
{
    ReplyToken replyToken = 0; ///< As in the command.
    bool bAccepted = false;    ///< Whether the command is executed.
    std::string message;       ///< Why it was rejected, for the MCS or the operator; may be empty if it was accepted.

    bool operator==(const ReplyCommand&) const = default;
};

/// Send the report to the MCS, after a reconnect if it is not connected. Pass MessageAcknowledged to the engine once the MCS
/// has acknowledged the report; until then it is in PlanEngine::GetUnacknowledged too.
struct SendReport
{
    OutboxEntry entry; ///< Its transactionID and time are the same each time that it is sent.
    /// Sequence of an earlier report of the same alarm, which need not be sent any more: the engine has removed it.
    std::optional<std::uint64_t> replaced{};

    bool operator==(const SendReport&) const = default;
};

/// Pass the command to the robot's adapter (IRobotAdapter::Handle).
struct CommandRobot
{
    std::string robotID;
    RobotCommand command; ///< Not repeated by the engine.

    bool operator==(const CommandRobot&) const = default;
};

/// Publish the robot's status (RobotStatusUpdate). Not stored; a newer status replaces an unsent one.
struct RobotStatusChanged
{
    RobotStatus status; ///< The whole status, not only what changed.

    bool operator==(const RobotStatusChanged&) const = default;
};

/// Publish the TSC state (TscStateUpdate). A newer state replaces an unsent one.
struct TscStateChanged
{
    ETscState state = ETscState::Auto; ///< The new one.

    bool operator==(const TscStateChanged&) const = default;
};

/// Call PlanEngine::OnTimer after the delay. 0: as soon as possible, but not before the current call has returned. A timer of
/// the same identity that is running is restarted.
struct StartEngineTimer
{
    EngineTimer timer;
    Core::Duration delay{};

    bool operator==(const StartEngineTimer&) const = default;
};

/// Do not call OnTimer for this timer.
struct CancelEngineTimer
{
    EngineTimer timer;

    bool operator==(const CancelEngineTimer&) const = default;
};

/// What the engine requests of its host. Each alternative states what to do.
using EngineAction = std::variant<
    StorePlans,
    ReplyCommand,
    SendReport,
    CommandRobot,
    RobotStatusChanged,
    TscStateChanged,
    StartEngineTimer,
    CancelEngineTimer>;
/// To be executed strictly in order, before the next call of the engine.
using EngineActions = std::vector<EngineAction>;

} // namespace ACS::Planning
