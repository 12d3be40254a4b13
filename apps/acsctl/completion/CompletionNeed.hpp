#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// What acsd, the configuration or the shell must supply for a completion.
enum class ECompletionSource : std::uint8_t
{
    None,
    Plans,
    Robots,
    PlansAndRobots,
    Jobs,    ///< Of the plan.
    Steps,   ///< Of the plan.
    Actions, ///< Types of the instant actions that the robot offers.
    Alarms,  ///< Codes of the active alarms of the robot.
    Places,  ///< Of the kind.
    Contexts,
    Files,
};

/// The candidates for a word of a command line: words, and a source of names.
struct CompletionNeed
{
    std::vector<std::string> words;
    ECompletionSource source = ECompletionSource::None;
    std::string subject{};      ///< The plan, the robot or the kind.
    std::string prefix{};       ///< What precedes each candidate in the word: "--state=".
    bool bBeforeDashes = false; ///< The word is a positional argument, without "--" before it.
};

} // namespace ACS::Acsctl
