#include "vda-sim/Fault.hpp"

#include "common/faults/FaultText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::EEmergencyStop;
using VDA5050::EErrorLevel;
using VDA5050::EOperatingMode;
using VDA5050::ETopic;

constexpr Apps::ValueEnumNames<bool, 2> YES_OR_NO{{{"yes", true}, {"no", false}}};
constexpr Apps::ValueEnumNames<bool, 2> MOMENTS{{{"start", true}, {"end", false}}};
constexpr Apps::ValueEnumNames<EFaultDirection, 3> DIRECTIONS{
    {{"in", EFaultDirection::In}, {"out", EFaultDirection::Out}, {"both", EFaultDirection::Both}}};
constexpr Apps::ValueEnumNames<ETopic, VDA5050::TOPIC_COUNT> TOPICS{
    {{"order", ETopic::Order},
     {"instantActions", ETopic::InstantActions},
     {"state", ETopic::State},
     {"visualization", ETopic::Visualization},
     {"connection", ETopic::Connection},
     {"factsheet", ETopic::Factsheet}}};
constexpr Apps::ValueEnumNames<EEmergencyStop, 3> EMERGENCY_STOPS{
    {{"AUTOACK", EEmergencyStop::AutoAcknowledge},
     {"MANUAL", EEmergencyStop::Manual},
     {"REMOTE", EEmergencyStop::Remote}}};
/// AUTOMATIC is not a fault: the mode returns to it when the fault ends.
constexpr Apps::ValueEnumNames<EOperatingMode, 4> MODES{
    {{"MANUAL", EOperatingMode::Manual},
     {"SERVICE", EOperatingMode::Service},
     {"TEACHIN", EOperatingMode::TeachIn},
     {"SEMIAUTOMATIC", EOperatingMode::SemiAutomatic}}};
constexpr Apps::ValueEnumNames<EErrorLevel, 2> LEVELS{
    {{"WARNING", EErrorLevel::Warning}, {"FATAL", EErrorLevel::Fatal}}};

constexpr double MAX_PERCENT = 100.0;
constexpr double MAX_SWERVE = 10.0; ///< m

constexpr std::array<Apps::FaultParameter<Fault>, 19> PARAMETERS{
    {Apps::FAULT_AT<Fault>,
     {"node",
      "NODEID",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNameValue(text, fault.place);
      }},
     Apps::FAULT_FOR<Fault>,
     Apps::FAULT_COUNT<Fault>,
     {"will",
      "yes|no",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, YES_OR_NO, fault.bWill);
      }},
     {"topic",
      "TOPIC",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, TOPICS, fault.topic.emplace());
      }},
     {"direction",
      "in|out|both",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, DIRECTIONS, fault.direction);
      }},
     {"percent",
      "0..100",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNumberValue(text, MAX_PERCENT, fault.percent);
      }},
     {"time",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadDurationValue(text, fault.hold);
      }},
     {"jitter",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadDurationValue(text, fault.jitter);
      }},
     {"swerve",
      "METRES",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNumberValue(text, MAX_SWERVE, fault.swerve);
      }},
     {"type",
      "ACTIONTYPE",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNameValue(text, fault.actionType);
      }},
     {"id",
      "ACTIONID",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNameValue(text, fault.actionID);
      }},
     {"when",
      "start|end",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, MOMENTS, fault.bAtStart);
      }},
     {"ack",
      "MANUAL|REMOTE|AUTOACK",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, EMERGENCY_STOPS, fault.emergencyStop);
      }},
     {"mode",
      "MODE",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, MODES, fault.mode);
      }},
     {"charge",
      "PERCENT",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNumberValue(text, MAX_PERCENT, fault.charge);
      }},
     {"error",
      "ERRORTYPE",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadNameValue(text, fault.errorType);
      }},
     {"level", "WARNING|FATAL", [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, LEVELS, fault.errorLevel);
      }}}};

constexpr std::array<Apps::FaultRow<Fault>, 12> ROWS{
    {{EFaultKind::Drop,
      "drop",
      "will",
      "the connection breaks; with will=no without the last will, so that ONLINE stays"},
     {EFaultKind::Silence,
      "silence",
      "topic",
      "stays connected, but publishes nothing; with topic: nothing on that topic"},
     {EFaultKind::Stuck,
      "stuck",
      "error level",
      "stops at once without an error; with error: with an error of that type"},
     {EFaultKind::Blocked,
      "blocked",
      "swerve",
      "an obstacle: brakes, fieldViolation=true; with swerve it passes if a corridor has room"},
     {EFaultKind::Lost, "lost", "", "loses its position: brakes, positionInitialized=false; initPosition ends it"},
     {EFaultKind::ActionFails,
      "action-fails",
      "type id when count error level",
      "the next action fails at its end; with when=start when it begins"},
     {EFaultKind::EmergencyStop, "estop", "ack", "emergency stop: brakes hard, actions stop, eStop is MANUAL or ack"},
     {EFaultKind::Mode, "mode", "mode", "changes the operating mode, by default to MANUAL"},
     {EFaultKind::Battery,
      "battery",
      "charge",
      "sets the charge once, by default to 10 %; below 15 % with batteryLow",
      true},
     {EFaultKind::Refuse, "refuse", "count error level", "refuses the next order, by default with orderError"},
     {EFaultKind::Loss, "loss", "percent topic direction", "messages are lost, by default all"},
     {EFaultKind::Delay,
      "delay",
      "time jitter topic direction",
      "messages are delayed by time and up to jitter more, in their order"}}};

/// Otherwise the vehicle receives it.
bool IsPublished(ETopic topic)
{
    return topic != ETopic::Order && topic != ETopic::InstantActions;
}

/// Rejects a topic on which the fault has no effect.
Core::Result<void> CheckTopic(const Fault& fault, ETopic topic)
{
    const bool bPublished = IsPublished(topic);
    if (fault.kind == EFaultKind::Silence && (!bPublished || topic == ETopic::Connection))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            "silence topic",
            "one of state, visualization, factsheet",
            Core::QuoteForError(VDA5050::GetTopicName(topic)));
    }
    if (fault.direction == (bPublished ? EFaultDirection::In : EFaultDirection::Out))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            fmt::format("{} direction", GetFaultName(fault.kind)),
            fmt::format(
                "{}: a vehicle {} the topic {}",
                bPublished ? "out" : "in",
                bPublished ? "publishes" : "receives",
                VDA5050::GetTopicName(topic)));
    }
    return {};
}

/// Rejects combinations without effect.
Core::Result<void> CheckWhole(Fault& fault, const std::set<std::string_view>& keys)
{
    if (keys.contains("level") && fault.errorType.empty() && fault.kind != EFaultKind::Refuse)
    {
        return Core::Fail(
            Core::ECoreError::MissingField,
            fmt::format("{} level", GetFaultName(fault.kind)),
            "error=ERRORTYPE with the level");
    }
    if (fault.kind == EFaultKind::Delay && fault.hold + fault.jitter == Core::Duration::zero())
    {
        return Core::Fail(Core::ECoreError::MissingField, "delay", "time=DURATION, jitter=DURATION or both");
    }
    return fault.topic.has_value() ? CheckTopic(fault, *fault.topic) : Core::Result<void>();
}

} // namespace

const Apps::FaultGrammar<Fault>& GetFaultGrammar()
{
    static constexpr Apps::FaultGrammar<Fault> GRAMMAR{
        .target = "VEHICLE",
        .when = "at node for",
        .whenOnce = "at node",
        .bTriggers = true,
        .parameters = PARAMETERS,
        .rows = ROWS,
        .check = CheckWhole};
    return GRAMMAR;
}

std::string_view GetFaultName(EFaultKind kind)
{
    return Apps::GetFaultRow(GetFaultGrammar(), kind).name;
}

} // namespace ACS::VdaSim
