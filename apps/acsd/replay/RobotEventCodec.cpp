#include "replay/RobotEventCodec.hpp"

#include <acs/json/TaggedVariant.hpp>
#include <acs/json/TextCodec.hpp>
#include <acs/plan_json/PlanEnumNames.hpp>

#include <array>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// The member that states whether an event has a job check.
struct JobCheckMark
{
    bool bOn = false;
};

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

/// Written as whether there is a check; read as none.
template <>
struct ValueEncoder<decltype(Planning::JobCheckChanged::jobCheck)>
{
    static void Encode(const decltype(Planning::JobCheckChanged::jobCheck)& jobCheck, JsonWriter& writer)
    {
        writer.WriteBoolean(jobCheck != nullptr);
    }
};

template <>
struct ValueDecoder<decltype(Planning::JobCheckChanged::jobCheck)>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        decltype(Planning::JobCheckChanged::jobCheck)& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        out = nullptr;
        bool bOn = false;
        return ValueDecoder<bool>::TryDecode(value, bOn, bounds, context);
    }
};

template <>
struct JsonFields<Planning::RobotError>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("errorCode", &Planning::RobotError::errorCode),
        Required("level", &Planning::RobotError::level),
        Required("message", &Planning::RobotError::message));
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
struct JsonFields<Planning::RestartEvidence>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("commandId", &Planning::RestartEvidence::commandID),
        Optional("progressToken", &Planning::RestartEvidence::progressToken));
};

template <>
struct JsonFields<Planning::LinkChanged>
{
    static constexpr auto FIELDS = std::make_tuple(Required("on", &Planning::LinkChanged::bOnline));
};

template <>
struct JsonFields<Planning::StateChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Nullable("x", &Planning::StateChanged::x),
        Nullable("y", &Planning::StateChanged::y),
        Nullable("theta", &Planning::StateChanged::theta),
        Nullable("battery", &Planning::StateChanged::batteryPercent),
        Required("poseKnown", &Planning::StateChanged::bPoseKnown),
        Optional("lastNodeId", &Planning::StateChanged::lastNodeID),
        Required("driving", &Planning::StateChanged::bDriving),
        Required("charging", &Planning::StateChanged::bCharging),
        Required("paused", &Planning::StateChanged::bPaused),
        Required("automatic", &Planning::StateChanged::bAutomatic),
        Required("safetyStop", &Planning::StateChanged::bSafetyStop),
        Required("occupied", &Planning::StateChanged::bOccupied),
        Optional("errors", &Planning::StateChanged::errors),
        Defaulted("omittedErrors", &Planning::StateChanged::omittedErrors),
        Optional("heldNodeIds", &Planning::StateChanged::heldNodeIDs),
        Flat(&Planning::StateChanged::restartEvidence),
        Optional("loads", &Planning::StateChanged::loads));
};

template <>
struct JsonFields<Planning::NodePassed>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("driveId", &Planning::NodePassed::driveID),
        Required("nodeId", &Planning::NodePassed::nodeID));
};

template <>
struct JsonFields<Planning::Arrived>
{
    static constexpr auto FIELDS = std::make_tuple(Required("driveId", &Planning::Arrived::driveID));
};

template <>
struct JsonFields<Planning::DriveRejected>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("driveId", &Planning::DriveRejected::driveID),
        Optional("reason", &Planning::DriveRejected::reason));
};

template <>
struct JsonFields<Planning::DriveCancelled>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("driveId", &Planning::DriveCancelled::driveID),
        Optional("nodeId", &Planning::DriveCancelled::nodeID));
};

template <>
struct JsonFields<Planning::JobStarted>
{
    static constexpr auto FIELDS = std::make_tuple(Required("jobId", &Planning::JobStarted::jobID));
};

template <>
struct JsonFields<Planning::JobFinished>
{
    static constexpr auto FIELDS = std::make_tuple(Required("jobId", &Planning::JobFinished::jobID));
};

template <>
struct JsonFields<Planning::JobFailed>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::JobFailed::jobID),
        Optional("reason", &Planning::JobFailed::reason));
};

template <>
struct JsonFields<Planning::JobRejected>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::JobRejected::jobID),
        Optional("reason", &Planning::JobRejected::reason));
};

template <>
struct JsonFields<Planning::JobInterrupted>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::JobInterrupted::jobID),
        Optional("reason", &Planning::JobInterrupted::reason));
};

template <>
struct JsonFields<Planning::JobUnknown>
{
    static constexpr auto FIELDS = std::make_tuple(Required("jobId", &Planning::JobUnknown::jobID));
};

template <>
struct JsonFields<Planning::JobUnresolved>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::JobUnresolved::jobID),
        Optional("reason", &Planning::JobUnresolved::reason));
};

template <>
struct JsonFields<Planning::JobCheckChanged>
{
    static constexpr auto FIELDS = std::make_tuple(Required("on", &Planning::JobCheckChanged::jobCheck));
};

template <>
struct JsonFields<Planning::CompatibilityChanged>
{
    static constexpr auto FIELDS =
        std::make_tuple(Optional("reason", &Planning::CompatibilityChanged::incompatibility));
};

template <>
struct VariantTag<Planning::RobotEvent>
{
    static constexpr std::string_view NAME = "event";
    static constexpr std::array<std::string_view, 15> WORDS{
        "LinkChanged",
        "StateChanged",
        "NodePassed",
        "Arrived",
        "DriveRejected",
        "DriveCancelled",
        "JobStarted",
        "JobFinished",
        "JobFailed",
        "JobRejected",
        "JobInterrupted",
        "JobUnknown",
        "JobUnresolved",
        "JobCheckChanged",
        "CompatibilityChanged"};
};

template <>
struct JsonFields<Acsd::JobCheckMark>
{
    static constexpr auto FIELDS = std::make_tuple(Defaulted("on", &Acsd::JobCheckMark::bOn));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

std::string EncodeRobotEvent(const Planning::RobotEvent& event)
{
    return Json::EncodeText(event);
}

Core::Result<Planning::RobotEvent> DecodeRobotEvent(std::string_view text)
{
    return Json::DecodeText<Planning::RobotEvent>(text);
}

bool HasJobCheck(std::string_view text)
{
    const Core::Result<Planning::RobotEvent> event = DecodeRobotEvent(text);
    if (!event.has_value() || !std::holds_alternative<Planning::JobCheckChanged>(*event))
    {
        return false;
    }
    const Core::Result<JobCheckMark> mark = Json::DecodeText<JobCheckMark>(text);
    return mark.has_value() && mark->bOn;
}

} // namespace ACS::Acsd
