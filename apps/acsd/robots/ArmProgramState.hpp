#pragma once

#include <cstddef>
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

/// The selection was not refused; the first counters of after it have not come.
struct VerifyingSelection
{
};

struct WritingInputs
{
    std::size_t attempt = 0;
    std::size_t next = 0; ///< The one under way.
};

struct ReadingInputs
{
    std::size_t attempt = 0;
    std::string difference; ///< Of the latest sample; empty: none has come.
};

/// The inputs are as they were written; the first counters of after that have not come.
struct VerifyingCounters
{
};

/// It can be started, at the latest when the pause ends.
struct Prepared
{
    bool bVerified = false; ///< Inputs and counters, just now.
};

/// The controller refused one of these CONTROLs; the motor is probed.
struct Refused
{
    std::string reason;
};

/// The CONTROL that starts it is under way.
struct Starting
{
    bool bBegun = false;
};

/// What is known of a program that is awaited.
enum class EArmStart : std::uint8_t
{
    Sent,    ///< It was started now.
    Unknown, ///< It was started before a restart, or never.
    Counted, ///< The counters show after a restart that it has begun; it may have been paused since.
};

/// It was started, and has not begun.
struct Awaited
{
    EArmStart start = EArmStart::Sent;
    std::string refusal; ///< One that came late; empty: none.
};

struct Running
{
    EArmStart start = EArmStart::Sent;
    bool bStopRefused = false;      ///< Not asked for again before the next pause.
    std::size_t standingProbes = 0; ///< In a row.
};

/// The CONTROL that stops it was sent, and is not verified.
struct Stopping
{
};

struct Stopped
{
};

/// Likewise of the one that starts it again.
struct Resuming
{
};

/// The connection broke meanwhile: it runs, or is stopped.
struct Doubtful
{
};

/// The controller refused to resume it: whether it runs is probed.
struct ResumeRefused
{
    std::string refusal;
    bool bRetries = false;     ///< It is resumed as soon as another probe has seen that it is stopped.
    bool bSeenStopped = false; ///< Counters are to come after that: it may have come to its end.
};

/// The CONTROL that abandons it is under way.
struct Resetting
{
    bool bRCode = false; ///< By r_code; otherwise by the reset of its task.
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
    Doubtful,
    ResumeRefused,
    Resetting>;

} // namespace ACS::Acsd::ArmStates
