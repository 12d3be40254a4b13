#include "controller/Fault.hpp"

#include "common/faults/FaultText.hpp"
#include "controller/ControllerOptions.hpp"
#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::chrono::milliseconds HOLE{100};
constexpr std::chrono::milliseconds SLOWNESS{500};
constexpr std::chrono::minutes LONGEST_DELAY{1};
constexpr int FIRST_REFUSAL = 400;
constexpr int LAST_REFUSAL = 599;

constexpr Apps::ValueEnumNames<bool, 2> MOMENTS{{{"start", true}, {"end", false}}};
constexpr Apps::ValueEnumNames<EFaultSide, 3> SIDES{
    {{"stream", EFaultSide::Stream}, {"http", EFaultSide::Http}, {"both", EFaultSide::Both}}};

template <typename TInteger>
std::string ReadInteger(std::string_view text, TInteger lowest, TInteger highest, TInteger& target)
{
    const std::optional<TInteger> number = Core::ParseNumberOrNull<TInteger>(text);
    if (!number.has_value() || *number < lowest || *number > highest)
    {
        return fmt::format("a number from {} to {}", lowest, highest);
    }
    target = *number;
    return {};
}

/// Limited because an HTTP connection is kept until its answer has been sent, even if the client no longer waits.
std::string ReadSlowness(std::string_view text, Fault& fault)
{
    const std::string expected = Apps::ReadDurationValue(text, fault.time);
    return expected.empty() && fault.time > LONGEST_DELAY ? "a duration of at most 1m" : expected;
}

std::string ReadProgram(std::string_view text, Fault& fault)
{
    int number = 0;
    std::string expected = ReadInteger(text, FIRST_PROGRAM, LAST_PROGRAM, number);
    if (expected.empty())
    {
        fault.place = fmt::to_string(number);
    }
    return expected;
}

constexpr std::array<Apps::FaultParameter<Fault>, 11> PARAMETERS{
    {Apps::FAULT_AT<Fault>,
     {"program", "NUMBER", ReadProgram},
     Apps::FAULT_FOR<Fault>,
     Apps::FAULT_EVERY<Fault>,
     Apps::FAULT_COUNT<Fault>,
     {"time", "DURATION", ReadSlowness},
     {"side",
      "stream|http|both",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, SIDES, fault.side);
      }},
     {"status",
      "400..599",
      [](std::string_view text, Fault& fault) {
          return ReadInteger(text, FIRST_REFUSAL, LAST_REFUSAL, fault.status);
      }},
     {"code",
      "NUMBER",
      [](std::string_view text, Fault& fault) {
          using Limits = std::numeric_limits<std::int32_t>;
          return ReadInteger(text, Limits::min(), Limits::max(), fault.code);
      }},
     {"silence",
      "DURATION",
      [](std::string_view text, Fault& fault) {
          return Apps::ReadDurationValue(text, fault.silence);
      }},
     {"when", "start|end", [](std::string_view text, Fault& fault) {
          return Apps::ReadWordValue(text, MOMENTS, fault.bAtStart);
      }}}};

constexpr std::array<Apps::FaultRow<Fault>, 11> ROWS{
    {{EFaultKind::Silence, "silence", "", "stays connected and answers commands, but sends no data lines"},
     {EFaultKind::Hole, "hole", "", "the same for 100 ms, or for the time of for"},
     {EFaultKind::Drop, "drop", "", "closes every Open Stream connection without a last message", true},
     {EFaultKind::Slow, "slow", "time side", "delays each answer of the Open API, by default by 500 ms"},
     {EFaultKind::Refuse, "refuse", "count status code", "refuses the next CONTROL, by default with 403 and -1554"},
     {EFaultKind::Mode,
      "mode",
      "silence",
      "the mode switch leaves remote; with silence the stream is silent at each turn"},
     {EFaultKind::EmergencyStop, "estop", "", "the emergency stop is pressed"},
     {EFaultKind::ProtectiveStop,
      "protective-stop",
      "",
      "a safeguard is open: the motor is off and cannot be switched on"},
     {EFaultKind::MotorOff, "motor-off", "", "the operator switches the motor off", true},
     {EFaultKind::ProgramFails, "program-fails", "when count", "the next program fails at its end, or when it begins"},
     {EFaultKind::WrongValue, "wrong-value", "count", "the next relay that a client writes gets another value"}}};

/// Sets the defaults of a kind.
Core::Result<void> CheckWhole(Fault& fault, const std::set<std::string_view>& keys)
{
    if (fault.kind == EFaultKind::Hole && !fault.lasts.has_value())
    {
        fault.lasts = HOLE;
    }
    if (fault.kind == EFaultKind::Slow && !keys.contains("time"))
    {
        fault.time = SLOWNESS;
    }
    return {};
}

} // namespace

const Apps::FaultGrammar<Fault>& GetFaultGrammar()
{
    static constexpr Apps::FaultGrammar<Fault> GRAMMAR{
        .target = "CONTROLLER",
        .when = "at program for every",
        .whenOnce = "at program every",
        .parameters = PARAMETERS,
        .rows = ROWS,
        .check = CheckWhole};
    return GRAMMAR;
}

} // namespace ACS::OpenStreamSim
