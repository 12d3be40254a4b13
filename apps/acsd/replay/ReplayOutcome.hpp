#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Where a replay differs from the recorded run.
struct ReplayDifference
{
    Core::Now now;        ///< Of the input.
    std::string place;    ///< "FILE:LINE" of the record; empty if it has none.
    std::string input;    ///< What led to it.
    std::string expected; ///< The record, or why there is none.
    std::string actual;   ///< Of this acsd.
};

/// The result of a replay.
struct ReplayOutcome
{
    std::size_t inputs = 0;
    std::size_t reports = 0;
    std::size_t commands = 0;             ///< To robots.
    std::optional<Core::Now> firstOrNull; ///< Time of the first input.
    std::optional<Core::Now> lastOrNull;  ///< Time of the last input.
    std::optional<ReplayDifference> differenceOrNull;
    std::string fault; ///< Why the records cannot be replayed, or not to their end; empty: they can.
};

} // namespace ACS::Acsd
