#include "replay/RobotEventCodec.hpp"

#include "replay/RecordJson.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

struct RobotErrorText
{
    std::string errorCode;
    std::string level;
    std::string message;
};

/// A StateChanged; of its numbers those that are not finite are absent.
struct RobotStateText
{
    std::optional<double> x;
    std::optional<double> y;
    std::optional<double> theta;
    std::optional<double> batteryPercent;
    bool bPoseKnown = false;
    std::string lastNodeID;
    bool bDriving = false;
    bool bCharging = false;
    bool bPaused = false;
    bool bAutomatic = true;
    bool bSafetyStop = false;
    bool bOccupied = false;
    std::vector<RobotErrorText> errors;
    std::size_t omittedErrors = 0;
    std::vector<std::string> heldNodeIDs;
    std::optional<std::string> commandID;
    std::string progressToken;
    std::optional<std::vector<Planning::PortLoad>> loads;
};

/// An event of any kind: what a kind does not have is absent.
struct RobotEventText
{
    std::string event;
    std::optional<RobotStateText> state;
    std::optional<bool> bOn; ///< Online, or a job check.
    std::string driveID;
    std::string nodeID;
    std::string jobID;
    std::string reason;
};

constexpr std::string_view LINK_EVENT = "LinkChanged";
constexpr std::string_view STATE_EVENT = "StateChanged";
constexpr std::string_view PASSED_EVENT = "NodePassed";
constexpr std::string_view ARRIVED_EVENT = "Arrived";
constexpr std::string_view DRIVE_REJECTED_EVENT = "DriveRejected";
constexpr std::string_view DRIVE_CANCELLED_EVENT = "DriveCancelled";
constexpr std::string_view JOB_STARTED_EVENT = "JobStarted";
constexpr std::string_view JOB_FINISHED_EVENT = "JobFinished";
constexpr std::string_view JOB_FAILED_EVENT = "JobFailed";
constexpr std::string_view JOB_REJECTED_EVENT = "JobRejected";
constexpr std::string_view JOB_INTERRUPTED_EVENT = "JobInterrupted";
constexpr std::string_view JOB_UNKNOWN_EVENT = "JobUnknown";
constexpr std::string_view JOB_UNRESOLVED_EVENT = "JobUnresolved";
constexpr std::string_view JOB_CHECK_EVENT = "JobCheckChanged";
constexpr std::string_view COMPATIBILITY_EVENT = "CompatibilityChanged";

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::RobotErrorText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("errorCode", &Acsd::RobotErrorText::errorCode),
        Required("level", &Acsd::RobotErrorText::level),
        Required("message", &Acsd::RobotErrorText::message));
};

template <>
struct JsonFields<Planning::PortLoad>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("port", &Planning::PortLoad::port),
        Required("loaded", &Planning::PortLoad::bLoaded),
        Optional("carrierId", &Planning::PortLoad::carrierID));
};

template <>
struct JsonFields<Acsd::RobotStateText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("x", &Acsd::RobotStateText::x),
        Optional("y", &Acsd::RobotStateText::y),
        Optional("theta", &Acsd::RobotStateText::theta),
        Optional("battery", &Acsd::RobotStateText::batteryPercent),
        Required("poseKnown", &Acsd::RobotStateText::bPoseKnown),
        Optional("lastNodeId", &Acsd::RobotStateText::lastNodeID),
        Required("driving", &Acsd::RobotStateText::bDriving),
        Required("charging", &Acsd::RobotStateText::bCharging),
        Required("paused", &Acsd::RobotStateText::bPaused),
        Required("automatic", &Acsd::RobotStateText::bAutomatic),
        Required("safetyStop", &Acsd::RobotStateText::bSafetyStop),
        Required("occupied", &Acsd::RobotStateText::bOccupied),
        Optional("errors", &Acsd::RobotStateText::errors),
        Defaulted("omittedErrors", &Acsd::RobotStateText::omittedErrors),
        Optional("heldNodeIds", &Acsd::RobotStateText::heldNodeIDs),
        Optional("commandId", &Acsd::RobotStateText::commandID),
        Optional("progressToken", &Acsd::RobotStateText::progressToken),
        Optional("loads", &Acsd::RobotStateText::loads));
};

template <>
struct JsonFields<Acsd::RobotEventText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("event", &Acsd::RobotEventText::event),
        Optional("state", &Acsd::RobotEventText::state),
        Optional("on", &Acsd::RobotEventText::bOn),
        Optional("driveId", &Acsd::RobotEventText::driveID),
        Optional("nodeId", &Acsd::RobotEventText::nodeID),
        Optional("jobId", &Acsd::RobotEventText::jobID),
        Optional("reason", &Acsd::RobotEventText::reason));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

std::optional<double> MakeFiniteOrNull(double value)
{
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double ReadFinite(const std::optional<double>& valueOrNull)
{
    return valueOrNull.value_or(std::numeric_limits<double>::quiet_NaN());
}

RobotStateText MakeRobotStateText(const Planning::StateChanged& state)
{
    RobotStateText text{
        MakeFiniteOrNull(state.x),
        MakeFiniteOrNull(state.y),
        MakeFiniteOrNull(state.theta),
        MakeFiniteOrNull(state.batteryPercent),
        state.bPoseKnown,
        state.lastNodeID,
        state.bDriving,
        state.bCharging,
        state.bPaused,
        state.bAutomatic,
        state.bSafetyStop,
        state.bOccupied,
        {},
        state.omittedErrors,
        state.heldNodeIDs,
        state.restartEvidence.commandID,
        state.restartEvidence.progressToken,
        state.loads};
    std::ranges::transform(state.errors, std::back_inserter(text.errors), [](const Planning::RobotError& error) {
        return RobotErrorText{error.errorCode, std::string(GetText(error.level)), error.message};
    });
    return text;
}

Planning::StateChanged MakeRobotState(RobotStateText text)
{
    Planning::StateChanged state;
    state.x = ReadFinite(text.x);
    state.y = ReadFinite(text.y);
    state.theta = ReadFinite(text.theta);
    state.batteryPercent = ReadFinite(text.batteryPercent);
    state.bPoseKnown = text.bPoseKnown;
    state.lastNodeID = std::move(text.lastNodeID);
    state.bDriving = text.bDriving;
    state.bCharging = text.bCharging;
    state.bPaused = text.bPaused;
    state.bAutomatic = text.bAutomatic;
    state.bSafetyStop = text.bSafetyStop;
    state.bOccupied = text.bOccupied;
    for (RobotErrorText& error : text.errors)
    {
        const bool bHeavy = error.level == GetText(Planning::EAlarmLevel::Heavy);
        state.errors.push_back(
            {std::move(error.errorCode),
             bHeavy ? Planning::EAlarmLevel::Heavy : Planning::EAlarmLevel::Light,
             std::move(error.message)});
    }
    state.omittedErrors = text.omittedErrors;
    state.heldNodeIDs = std::move(text.heldNodeIDs);
    state.restartEvidence = {std::move(text.commandID), std::move(text.progressToken)};
    state.loads = std::move(text.loads);
    return state;
}

RobotEventText MakeJobText(std::string_view event, const std::string& jobID, const std::string& reason)
{
    return {std::string(event), {}, {}, {}, {}, jobID, reason};
}

RobotEventText MakeRobotEventText(const Planning::RobotEvent& event)
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    return std::visit(
        Core::Overloaded{
            [](const LinkChanged& link) {
                return RobotEventText{std::string(LINK_EVENT), {}, link.bOnline, {}, {}, {}, {}};
            },
            [](const StateChanged& state) {
                return RobotEventText{std::string(STATE_EVENT), MakeRobotStateText(state), {}, {}, {}, {}, {}};
            },
            [](const NodePassed& passed) {
                return RobotEventText{std::string(PASSED_EVENT), {}, {}, passed.driveID, passed.nodeID, {}, {}};
            },
            [](const Arrived& arrived) {
                return RobotEventText{std::string(ARRIVED_EVENT), {}, {}, arrived.driveID, {}, {}, {}};
            },
            [](const DriveRejected& rejected) {
                return RobotEventText{
                    std::string(DRIVE_REJECTED_EVENT),
                    {},
                    {},
                    rejected.driveID,
                    {},
                    {},
                    rejected.reason};
            },
            [](const DriveCancelled& cancelled) {
                return RobotEventText{
                    std::string(DRIVE_CANCELLED_EVENT),
                    {},
                    {},
                    cancelled.driveID,
                    cancelled.nodeID,
                    {},
                    {}};
            },
            [](const JobStarted& job) { return MakeJobText(JOB_STARTED_EVENT, job.jobID, {}); },
            [](const JobFinished& job) { return MakeJobText(JOB_FINISHED_EVENT, job.jobID, {}); },
            [](const JobFailed& job) { return MakeJobText(JOB_FAILED_EVENT, job.jobID, job.reason); },
            [](const JobRejected& job) { return MakeJobText(JOB_REJECTED_EVENT, job.jobID, job.reason); },
            [](const JobInterrupted& job) { return MakeJobText(JOB_INTERRUPTED_EVENT, job.jobID, job.reason); },
            [](const JobUnknown& job) { return MakeJobText(JOB_UNKNOWN_EVENT, job.jobID, {}); },
            [](const JobUnresolved& job) { return MakeJobText(JOB_UNRESOLVED_EVENT, job.jobID, job.reason); },
            [](const JobCheckChanged& changed) {
                return RobotEventText{std::string(JOB_CHECK_EVENT), {}, changed.jobCheck != nullptr, {}, {}, {}, {}};
            },
            [](const CompatibilityChanged& changed) {
                return RobotEventText{std::string(COMPATIBILITY_EVENT), {}, {}, {}, {}, {}, changed.incompatibility};
            }},
        event);
}

Core::Result<Planning::RobotEvent> MakeJobEvent(RobotEventText& text)
{
    if (text.event == JOB_STARTED_EVENT)
    {
        return Planning::JobStarted{std::move(text.jobID)};
    }
    if (text.event == JOB_FINISHED_EVENT)
    {
        return Planning::JobFinished{std::move(text.jobID)};
    }
    if (text.event == JOB_FAILED_EVENT)
    {
        return Planning::JobFailed{std::move(text.jobID), std::move(text.reason)};
    }
    if (text.event == JOB_REJECTED_EVENT)
    {
        return Planning::JobRejected{std::move(text.jobID), std::move(text.reason)};
    }
    if (text.event == JOB_INTERRUPTED_EVENT)
    {
        return Planning::JobInterrupted{std::move(text.jobID), std::move(text.reason)};
    }
    if (text.event == JOB_UNKNOWN_EVENT)
    {
        return Planning::JobUnknown{std::move(text.jobID)};
    }
    if (text.event == JOB_UNRESOLVED_EVENT)
    {
        return Planning::JobUnresolved{std::move(text.jobID), std::move(text.reason)};
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "event", "an event of a robot", Core::QuoteForError(text.event));
}

Core::Result<Planning::RobotEvent> MakeRobotEvent(RobotEventText text)
{
    if (text.event == LINK_EVENT)
    {
        return Planning::LinkChanged{text.bOn.value_or(false)};
    }
    if (text.event == STATE_EVENT)
    {
        return MakeRobotState(std::move(text.state).value_or(RobotStateText()));
    }
    if (text.event == PASSED_EVENT)
    {
        return Planning::NodePassed{std::move(text.driveID), std::move(text.nodeID)};
    }
    if (text.event == ARRIVED_EVENT)
    {
        return Planning::Arrived{std::move(text.driveID)};
    }
    if (text.event == DRIVE_REJECTED_EVENT)
    {
        return Planning::DriveRejected{std::move(text.driveID), std::move(text.reason)};
    }
    if (text.event == DRIVE_CANCELLED_EVENT)
    {
        return Planning::DriveCancelled{std::move(text.driveID), std::move(text.nodeID)};
    }
    if (text.event == JOB_CHECK_EVENT)
    {
        return Planning::JobCheckChanged{};
    }
    if (text.event == COMPATIBILITY_EVENT)
    {
        return Planning::CompatibilityChanged{std::move(text.reason)};
    }
    return MakeJobEvent(text);
}

} // namespace

std::string EncodeRobotEvent(const Planning::RobotEvent& event)
{
    return EncodeRecord(MakeRobotEventText(event));
}

Core::Result<Planning::RobotEvent> DecodeRobotEvent(std::string_view text)
{
    return DecodeRecord<RobotEventText>(text).and_then(
        [](RobotEventText&& read) { return MakeRobotEvent(std::move(read)); });
}

bool HasJobCheck(std::string_view text)
{
    const Core::Result<RobotEventText> read = DecodeRecord<RobotEventText>(text);
    return read.has_value() && read->event == JOB_CHECK_EVENT && read->bOn.value_or(false);
}

} // namespace ACS::Acsd
