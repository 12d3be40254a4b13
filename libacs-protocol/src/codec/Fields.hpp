#pragma once

#include "ProtocolEnumNames.hpp"
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

// The one place that names the protocol's members (sections 4 and 5), in the order in which they are written.
namespace ACS::Protocol::Detail
{

/// 128 characters of any script.
inline constexpr std::size_t LONGEST_ID = 512;
inline constexpr std::size_t MOST_STEPS = 10'000;
inline constexpr double HIGHEST_STEP = std::numeric_limits<std::int32_t>::max();

/// The members of every message, found but not decoded: an error in one must not hide the others.
struct WireEnvelope
{
    Json::DeferredValue command;
    Json::DeferredValue transactionID;
    Json::DeferredValue timestamp;
    Json::DeferredValue result;
    Json::DeferredValue message;
    Json::DeferredValue payload;
};

/// D-1: success and ok in any case; everything else is a failure. Notes every spelling but the exact two.
[[nodiscard]] bool IsSuccess(std::string_view text, std::string_view failureWord, Json::DecodeNotes& notes);

/// A time of the wire, to the millisecond; nullopt where it is none.
[[nodiscard]] std::optional<Core::Timestamp> ReadTimestampOrNull(
    const Json::Value& value,
    std::chrono::minutes assumedOffset);

} // namespace ACS::Protocol::Detail

namespace ACS::Json
{

template <>
struct JsonFields<Protocol::Detail::WireEnvelope>
{
    using Message = Protocol::Detail::WireEnvelope;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("command", &Message::command),
        Optional("transactionId", &Message::transactionID),
        Optional("timestamp", &Message::timestamp),
        Optional("result", &Message::result),
        Optional("message", &Message::message),
        Optional("payload", &Message::payload));
};

template <>
struct JsonFields<Protocol::PlanJob>
{
    using Message = Protocol::PlanJob;
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Message::jobID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Optional("from", &Message::from),
        Optional("to", &Message::to));
};

template <>
struct JsonFields<Protocol::PlanStep>
{
    using Message = Protocol::PlanStep;
    static constexpr auto FIELDS = std::make_tuple(
        Required("stepNo", &Message::stepNo).Between(1, Protocol::Detail::HIGHEST_STEP),
        Required("action", &Message::action).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("position", &Message::position).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Defaulted("carrierIds", &Message::carrierIDs).WithElements(0, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Defaulted("jobs", &Message::jobs));
};

template <>
struct JsonFields<Protocol::ExecutionPlan>
{
    using Message = Protocol::ExecutionPlan;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Defaulted("lotId", &Message::lotID).AsIdentifier(),
        Optional("priority", &Message::priority),
        Required("steps", &Message::steps).WithLength(1, Protocol::Detail::MOST_STEPS));
};

template <Protocol::EAcsCommand COMMAND>
struct JsonFields<Protocol::PlanControl<COMMAND>>
{
    using Message = Protocol::PlanControl<COMMAND>;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Optional("reason", &Message::reason));
};

template <Protocol::EAcsCommand COMMAND>
struct JsonFields<Protocol::ResultReport<COMMAND>>
{
    using Message = Protocol::ResultReport<COMMAND>;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("result", &Message::result),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::RequestAcsPlans>
{
    static constexpr std::tuple<> FIELDS{};
};

template <>
struct JsonFields<Protocol::RequestAcsPlanHistory>
{
    using Message = Protocol::RequestAcsPlanHistory;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planIds", &Message::planIDs).WithElements(1, Protocol::Detail::LONGEST_ID).AsIdentifier());
};

template <>
struct JsonFields<Protocol::PlanEntry>
{
    using Message = Protocol::PlanEntry;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Nullable("robotId", &Message::robotID).AsIdentifier(),
        Required("status", &Message::status),
        Required("stepNo", &Message::stepNo).Between(0, Protocol::Detail::HIGHEST_STEP),
        Nullable("jobId", &Message::jobID).AsIdentifier(),
        Nullable("currentAction", &Message::currentAction).AsIdentifier(),
        Nullable("startTime", &Message::startTime),
        Nullable("endTime", &Message::endTime));
};

template <>
struct JsonFields<Protocol::RequestAcsErrorList>
{
    static constexpr std::tuple<> FIELDS{};
};

template <>
struct JsonFields<Protocol::Registration>
{
    static constexpr std::tuple<> FIELDS{};
};

template <>
struct JsonFields<Protocol::TscStateUpdate>
{
    using Message = Protocol::TscStateUpdate;
    static constexpr auto FIELDS = std::make_tuple(Required("state", &Message::state));
};

template <>
struct JsonFields<Protocol::AcsCommStateUpdate>
{
    using Message = Protocol::AcsCommStateUpdate;
    static constexpr auto FIELDS = std::make_tuple(Required("isConnected", &Message::bConnected));
};

template <>
struct JsonFields<Protocol::PlanReport>
{
    using Message = Protocol::PlanReport;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("status", &Message::status),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::StepReport>
{
    using Message = Protocol::StepReport;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("robotId", &Message::robotID).AsIdentifier(),
        Required("stepNo", &Message::stepNo).Between(1, Protocol::Detail::HIGHEST_STEP),
        Required("status", &Message::status),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::JobReport>
{
    using Message = Protocol::JobReport;
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Message::planID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("robotId", &Message::robotID).AsIdentifier(),
        Required("stepNo", &Message::stepNo).Between(1, Protocol::Detail::HIGHEST_STEP),
        Required("jobId", &Message::jobID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("status", &Message::status),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::ErrorReport>
{
    using Message = Protocol::ErrorReport;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Message::robotID).AsIdentifier(),
        Optional("planId", &Message::planID).AsIdentifier(),
        Required("state", &Message::bSet),
        Optional("stepNo", &Message::stepNo),
        Optional("jobId", &Message::jobID).AsIdentifier(),
        Required("errorCode", &Message::errorCode),
        Required("level", &Message::level),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::RobotStatusUpdate>
{
    using Message = Protocol::RobotStatusUpdate;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Message::robotID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("robotType", &Message::robotType),
        Required("robotStatus", &Message::robotStatus),
        Nullable("position", &Message::position),
        Defaulted("carrierIds", &Message::carrierIDs).WithElements(0, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Nullable("planId", &Message::planID).AsIdentifier(),
        Nullable("stepNo", &Message::stepNo),
        Nullable("jobId", &Message::jobID).AsIdentifier(),
        Defaulted("message", &Message::message));
};

template <>
struct JsonFields<Protocol::RobotPosition>
{
    using Message = Protocol::RobotPosition;
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Message::robotID).WithLength(1, Protocol::Detail::LONGEST_ID).AsIdentifier(),
        Required("x", &Message::x),
        Required("y", &Message::y),
        Required("angle", &Message::angle),
        Required("battery", &Message::battery));
};

template <>
struct JsonFields<Protocol::RobotPositionUpdate>
{
    using Message = Protocol::RobotPositionUpdate;
    static constexpr auto FIELDS = std::make_tuple(Required("robots", &Message::robots));
};

template <>
struct JsonFields<Protocol::EmptyAck>
{
    static constexpr std::tuple<> FIELDS{};
};

template <>
struct JsonFields<Protocol::PlanAck>
{
    using Message = Protocol::PlanAck;
    // No identifier: the refusal of one with control characters repeats it.
    static constexpr auto FIELDS = std::make_tuple(Optional("planId", &Message::planID));
};

template <>
struct JsonFields<Protocol::PlanListAck>
{
    using Message = Protocol::PlanListAck;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("plans", &Message::plans));
};

template <>
struct JsonFields<Protocol::ErrorListAck>
{
    using Message = Protocol::ErrorListAck;
    static constexpr auto FIELDS = std::make_tuple(Defaulted("errors", &Message::errors));
};

/// A time that cannot be read is none, and counted (section 2).
template <>
struct ValueDecoder<std::optional<Core::Timestamp>>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        std::optional<Core::Timestamp>& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueEncoder<Core::Timestamp>
{
    static void Encode(const Core::Timestamp& value, JsonWriter& writer);
};

template <>
struct ValueDecoder<Protocol::EReportResult>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Protocol::EReportResult& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueDecoder<Protocol::SyncConfig>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Protocol::SyncConfig& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueEncoder<Protocol::SyncConfig>
{
    static void Encode(const Protocol::SyncConfig& value, JsonWriter& writer);
};

} // namespace ACS::Json
