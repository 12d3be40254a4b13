#pragma once

#include "robots/ArmControls.hpp"

#include <cstdint>
#include <string>
#include <variant>

namespace ACS::Acsd::ArmStates
{

struct NoJob
{
};

/// The CONTROL that selects the program is under way.
struct Selecting
{
};

/// The selection was refused until the program counter is set, which is under way.
struct Rewinding
{
};

/// The selection was not refused. The first counters after it have not come.
struct VerifyingSelection
{
};

/// The CONTROL that writes one of the inputs is under way.
struct WritingInputs
{
};

struct ReadingInputs
{
};

/// The inputs are as they were written. The first counters after that have not come.
struct VerifyingCounters
{
};

/// It can be started as soon as no pause is wanted.
struct Prepared
{
    bool bPaused = false; ///< Another program may have been selected meanwhile: it is selected again.
};

/// The controller refused a CONTROL before the program was started. The motor is probed.
struct Refused
{
    std::string reason;
};

/// The CONTROL that starts it is under way.
struct Starting
{
    bool bBegun = false;
};

/// What is known of a start whose effect is awaited.
enum class EArmStart : std::uint8_t
{
    Sent,    ///< Sent since this start of acsd.
    Unknown, ///< Sent before a restart of acsd, or never.
    Counted, ///< The counters show after a restart that the program has begun. It may have been paused since.
};

/// It was started, and has not begun.
struct Awaited
{
    EArmStart start = EArmStart::Sent;
    std::string refusal;       ///< One that arrived late; empty: none.
    bool bReconnected = false; ///< Since it was started.
};

struct Running
{
    EArmStart start = EArmStart::Sent;
    bool bStopRefused = false; ///< Not sent again before the next pause.
};

/// The CONTROL that stops it was sent. Its effect is not verified.
struct Stopping
{
};

/// What is known of a program since its stop was verified.
enum class EArmHalt : std::uint8_t
{
    Unchecked, ///< It may have been resumed at the controller.
    Shown,     ///< A probe found it stopped. Counters must follow: the program may have ended.
    Verified,
    Replaced, ///< It is stopped, and another program is selected. It is probed again later.
};

struct Stopped
{
    EArmHalt halt = EArmHalt::Unchecked;
};

/// The CONTROL that resumes it was sent. Its effect is not verified.
struct Resuming
{
};

/// It is stopped again before anything else: the connection broke while it was being stopped or resumed, or the stop had
/// no effect.
struct Unverified
{
};

/// The controller refused to resume it, or shows that it does not run after that. Whether it runs is probed.
struct ResumeRefused
{
    std::string refusal;
    bool bRetries = false;     ///< It is resumed as soon as another probe has found it stopped.
    bool bSeenStopped = false; ///< Counters must follow: the program may have ended.
};

/// The CONTROL that abandons it was sent. It may be refused late.
struct Resetting
{
    bool bAccepted = false; ///< Not refused at once.
};

/// Where the program of a job is between its selection and its end.
using ArmProgramState = std::variant<
    NoJob,
    Selecting,
    Rewinding,
    VerifyingSelection,
    WritingInputs,
    ReadingInputs,
    VerifyingCounters,
    Prepared,
    Refused,
    Starting,
    Awaited,
    Running,
    Stopping,
    Stopped,
    Resuming,
    Unverified,
    ResumeRefused,
    Resetting>;

template <typename TState>
[[nodiscard]] bool Is(const ArmProgramState& state) noexcept
{
    return std::holds_alternative<TState>(state);
}

/// The state is the one in which this CONTROL is under way. Otherwise its job has ended meanwhile.
[[nodiscard]] bool IsAwaiting(const ArmProgramState& state, EArmControl kind);
/// It is selected and not started: a program that changes the counters now is another one.
[[nodiscard]] bool IsPreparing(const ArmProgramState& state);
/// Its start was not sent, and no selection is under way.
[[nodiscard]] bool IsBeforeStart(const ArmProgramState& state);

} // namespace ACS::Acsd::ArmStates
