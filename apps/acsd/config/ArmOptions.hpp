#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// How acsd works with one arm: where its programs show what they do, one array of words in its relays that MONITOR reads,
/// and how the inputs of a program are written.
struct ArmOptions
{
    std::string monitorURL = "/project/plc/m/val_s32";
    std::uint32_t firstByte = 400;
    std::chrono::milliseconds period{20};
    std::size_t startedIndex = 0;
    std::size_t finishedIndex = 1;
    std::size_t failedIndex = 2;
    /// The word into which a program writes the number of its job before it raises the started counter. Absent: programs
    /// cannot echo, and any change of the counters is taken for the job's own.
    std::optional<std::size_t> echoIndex = 4;
    /// How long inputs may take to read back as they were written before they are written again.
    std::chrono::milliseconds inputTimeout{2'000};
    std::size_t inputRetries = 2; ///< How often they are written again before the job fails.
};

} // namespace ACS::Acsd
