#include "vda-sim/Fault.hpp"

#include "common/DurationText.hpp"
#include "vda-sim/WordReader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
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

template <typename TValue, std::size_t Count>
using Words = std::array<std::pair<std::string_view, TValue>, Count>;

constexpr Words<bool, 2> YES_OR_NO{{{"yes", true}, {"no", false}}};
constexpr Words<bool, 2> MOMENTS{{{"start", true}, {"end", false}}};
constexpr Words<EFaultDirection, 3> DIRECTIONS{
    {{"in", EFaultDirection::In}, {"out", EFaultDirection::Out}, {"both", EFaultDirection::Both}}};
constexpr Words<ETopic, VDA5050::TOPIC_COUNT> TOPICS{
    {{"order", ETopic::Order},
     {"instantActions", ETopic::InstantActions},
     {"state", ETopic::State},
     {"visualization", ETopic::Visualization},
     {"connection", ETopic::Connection},
     {"factsheet", ETopic::Factsheet}}};
constexpr Words<EEmergencyStop, 3> EMERGENCY_STOPS{
    {{"AUTOACK", EEmergencyStop::AutoAcknowledge},
     {"MANUAL", EEmergencyStop::Manual},
     {"REMOTE", EEmergencyStop::Remote}}};
/// AUTOMATIC is no fault: the end of one brings it back.
constexpr Words<EOperatingMode, 4> MODES{
    {{"MANUAL", EOperatingMode::Manual},
     {"SERVICE", EOperatingMode::Service},
     {"TEACHIN", EOperatingMode::TeachIn},
     {"SEMIAUTOMATIC", EOperatingMode::SemiAutomatic}}};
constexpr Words<EErrorLevel, 2> LEVELS{{{"WARNING", EErrorLevel::Warning}, {"FATAL", EErrorLevel::Fatal}}};

template <typename TValue, std::size_t Count>
std::string ReadWord(std::string_view text, const Words<TValue, Count>& words, TValue& target)
{
    const auto found = std::ranges::find(words, text, &std::pair<std::string_view, TValue>::first);
    if (found != words.end())
    {
        target = found->second;
        return {};
    }
    std::string expected;
    for (const auto& [word, value] : words)
    {
        expected += (expected.empty() ? "" : ", ") + std::string(word);
    }
    return "one of " + expected;
}

std::string ReadDuration(std::string_view text, Core::Duration& target)
{
    const Core::Result<std::chrono::milliseconds> duration = Apps::ParseDuration(text);
    if (!duration.has_value())
    {
        return duration.error().expected;
    }
    target = *duration;
    return {};
}

std::string ReadNumber(std::string_view text, double max, double& target)
{
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number) || number < 0.0
        || number > max)
    {
        return fmt::format("a number from 0 to {}", max);
    }
    target = number;
    return {};
}

std::string ReadName(std::string_view text, std::string& target)
{
    target = std::string(text);
    return text.empty() ? "a name" : "";
}

constexpr double MAX_PERCENT = 100.0;
constexpr double MAX_SWERVE = 10.0; ///< m
constexpr std::uint32_t MAX_COUNT = 1'000'000;

/// Puts the value into the fault and returns nothing, or what was expected.
using FaultReader = std::string (*)(std::string_view text, Fault& fault);

struct FaultParameter
{
    std::string_view key;
    std::string_view values; ///< For the help.
    FaultReader read;
};

constexpr std::array<FaultParameter, 19> PARAMETERS{
    {{"at",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return ReadDuration(text, fault.delay);
      }},
     {"node",
      "NODEID",
      [](std::string_view text, Fault& fault) {
          return ReadName(text, fault.nodeID);
      }},
     {"for",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return ReadDuration(text, fault.lasts.emplace());
      }},
     {"count",
      "N",
      [](std::string_view text, Fault& fault) -> std::string {
          std::uint32_t count = 0;
          const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
          if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > MAX_COUNT)
          {
              return fmt::format("a number from 1 to {}", MAX_COUNT);
          }
          fault.maxUses = count;
          return {};
      }},
     {"will",
      "yes|no",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, YES_OR_NO, fault.bWill);
      }},
     {"topic",
      "TOPIC",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, TOPICS, fault.topic.emplace());
      }},
     {"direction",
      "in|out|both",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, DIRECTIONS, fault.direction);
      }},
     {"percent",
      "0..100",
      [](std::string_view text, Fault& fault) {
          return ReadNumber(text, MAX_PERCENT, fault.percent);
      }},
     {"time",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return ReadDuration(text, fault.hold);
      }},
     {"jitter",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return ReadDuration(text, fault.jitter);
      }},
     {"swerve",
      "METRES",
      [](std::string_view text, Fault& fault) {
          return ReadNumber(text, MAX_SWERVE, fault.swerve);
      }},
     {"type",
      "ACTIONTYPE",
      [](std::string_view text, Fault& fault) {
          return ReadName(text, fault.actionType);
      }},
     {"id",
      "ACTIONID",
      [](std::string_view text, Fault& fault) {
          return ReadName(text, fault.actionID);
      }},
     {"when",
      "start|end",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, MOMENTS, fault.bAtStart);
      }},
     {"ack",
      "MANUAL|REMOTE|AUTOACK",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, EMERGENCY_STOPS, fault.emergencyStop);
      }},
     {"mode",
      "MODE",
      [](std::string_view text, Fault& fault) {
          return ReadWord(text, MODES, fault.mode);
      }},
     {"charge",
      "PERCENT",
      [](std::string_view text, Fault& fault) {
          return ReadNumber(text, MAX_PERCENT, fault.charge);
      }},
     {"error",
      "ERRORTYPE",
      [](std::string_view text, Fault& fault) {
          return ReadName(text, fault.errorType);
      }},
     {"level", "WARNING|FATAL", [](std::string_view text, Fault& fault) {
          return ReadWord(text, LEVELS, fault.errorLevel);
      }}}};

/// What every kind understands; a battery is set once, and has no `for`.
constexpr std::string_view WHEN = "at node for";

struct FaultRow
{
    EFaultKind kind;
    std::string_view name;
    std::string_view parameters; ///< Beside `at node for`.
    std::string_view effect;
};

constexpr std::array<FaultRow, 12> ROWS{
    {{EFaultKind::Drop, "drop", "will", "the connection breaks; will=no: the broker is not told, ONLINE stays"},
     {EFaultKind::Silence, "silence", "topic", "connected, but nothing is published; with topic: nothing on that one"},
     {EFaultKind::Stuck, "stuck", "error level", "stands at once and says nothing of why, unless error names a type"},
     {EFaultKind::Blocked,
      "blocked",
      "swerve",
      "an obstacle: brakes, fieldViolation; passes where a corridor has room"},
     {EFaultKind::Lost, "lost", "", "loses its position: brakes, positionInitialized=false; initPosition ends it"},
     {EFaultKind::ActionFails, "action-fails", "type id when count error level", "the next action fails"},
     {EFaultKind::EmergencyStop, "estop", "ack", "stands hard, eStop says who has to acknowledge"},
     {EFaultKind::Mode, "mode", "mode", "another operating mode, by default MANUAL"},
     {EFaultKind::Battery, "battery", "charge", "sets the charge, by default to 10 %; below 15 % batteryLow"},
     {EFaultKind::Refuse, "refuse", "count error level", "refuses the next order, by default with orderError"},
     {EFaultKind::Loss, "loss", "percent topic direction", "messages vanish"},
     {EFaultKind::Delay, "delay", "time jitter topic direction", "messages come late, none before another"}}};

const FaultRow& GetRow(EFaultKind kind)
{
    return *std::ranges::find(ROWS, kind, &FaultRow::kind);
}

bool IsListed(std::string_view words, std::string_view wanted)
{
    while (!words.empty())
    {
        if (TakeWord(words) == wanted)
        {
            return true;
        }
    }
    return false;
}

std::string MakeKeys(const FaultRow& row)
{
    std::string keys(row.kind == EFaultKind::Battery ? "at node" : WHEN);
    return row.parameters.empty() ? keys : keys + " " + std::string(row.parameters);
}

const FaultParameter* FindParameterOrNull(std::string_view key)
{
    const auto* const found = std::ranges::find(PARAMETERS, key, &FaultParameter::key);
    return found != PARAMETERS.end() ? &*found : nullptr;
}

Core::Result<void> ReadParameter(std::string_view word, const FaultRow& row, Fault& fault)
{
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    const FaultParameter* const parameter = FindParameterOrNull(key);
    const std::string keys = MakeKeys(row);
    if (equals == std::string_view::npos || parameter == nullptr || !IsListed(keys, key))
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            std::string(row.name),
            fmt::format("KEY=VALUE with a key of: {}", keys),
            Core::QuoteForError(word));
    }
    const std::string_view value = word.substr(equals + 1);
    std::string expected = parameter->read(value, fault);
    if (!expected.empty())
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            fmt::format("{} {}", row.name, key),
            std::move(expected),
            Core::QuoteForError(value));
    }
    return {};
}

/// Else the vehicle hears it.
bool IsPublished(ETopic topic)
{
    return topic != ETopic::Order && topic != ETopic::InstantActions;
}

/// A topic that the fault would never meet.
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
            fmt::format("{} direction", GetRow(fault.kind).name),
            fmt::format(
                "{}: a vehicle {} the topic {}",
                bPublished ? "out" : "in",
                bPublished ? "publishes" : "hears",
                VDA5050::GetTopicName(topic)));
    }
    return {};
}

/// What together makes no fault, or one that could never show.
Core::Result<void> CheckWhole(const Fault& fault, bool bHasLevel)
{
    if (bHasLevel && fault.errorType.empty() && fault.kind != EFaultKind::Refuse)
    {
        return Core::Fail(
            Core::ECoreError::MissingField,
            fmt::format("{} level", GetRow(fault.kind).name),
            "error=ERRORTYPE, whose level it is");
    }
    if (fault.topic.has_value())
    {
        return CheckTopic(fault, *fault.topic);
    }
    if (fault.kind == EFaultKind::Delay && fault.hold + fault.jitter == Core::Duration::zero())
    {
        return Core::Fail(Core::ECoreError::MissingField, "delay", "time=DURATION, jitter=DURATION or both");
    }
    return {};
}

} // namespace

std::string_view GetFaultName(EFaultKind kind)
{
    return GetRow(kind).name;
}

Core::Result<EFaultKind> ParseFaultKind(std::string_view name)
{
    const auto* const found = std::ranges::find(ROWS, name, &FaultRow::name);
    if (found != ROWS.end())
    {
        return found->kind;
    }
    std::string names;
    for (const FaultRow& row : ROWS)
    {
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "fault", "one of " + names, Core::QuoteForError(name));
}

Core::Result<Fault> ParseFault(std::string_view text)
{
    const std::string_view name = TakeWord(text);
    const Core::Result<EFaultKind> kind = ParseFaultKind(name);
    if (!kind.has_value())
    {
        return tl::make_unexpected(kind.error());
    }
    const FaultRow& row = GetRow(*kind);
    Fault fault;
    fault.kind = *kind;
    fault.text = name;
    std::set<std::string_view> known;
    for (std::string_view word = TakeWord(text); !word.empty(); word = TakeWord(text))
    {
        const Core::Result<void> read = ReadParameter(word, row, fault);
        if (!read.has_value())
        {
            return tl::make_unexpected(read.error());
        }
        if (!known.insert(word.substr(0, word.find('='))).second)
        {
            return Core::Fail(
                Core::ECoreError::UnknownWord,
                std::string(row.name),
                "each key once",
                Core::QuoteForError(word));
        }
        fault.text.append(" ").append(word);
    }
    const Core::Result<void> whole = CheckWhole(fault, known.contains("level"));
    if (!whole.has_value())
    {
        return tl::make_unexpected(whole.error());
    }
    return fault;
}

std::string MakeFaultHelp()
{
    std::string help;
    for (const FaultRow& row : ROWS)
    {
        std::string_view keys = row.parameters;
        std::string parameters;
        for (std::string_view key = TakeWord(keys); !key.empty(); key = TakeWord(keys))
        {
            parameters += fmt::format(" [{}={}]", key, FindParameterOrNull(key)->values);
        }
        help += fmt::format("  {}{}\n      {}\n", row.name, parameters, row.effect);
    }
    return help;
}

} // namespace ACS::VdaSim
