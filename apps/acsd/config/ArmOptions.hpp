#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// How acsd works with one arm: the relays in which its programs show their progress (one array of words, read by MONITOR),
/// and how the inputs of a program are written.
struct ArmOptions
{
    std::string monitorURL = "/project/plc/m/val_s32";
    std::uint32_t firstByte = 400;
    std::chrono::milliseconds period{20};
    std::size_t startedIndex = 0;
    std::size_t finishedIndex = 1;
    std::size_t failedIndex = 2;
    /// The word into which a program writes the number of its job before it raises the started counter. Absent: programs do
    /// not echo the number, and every change of the counters counts for the present job.
    std::optional<std::size_t> echoIndex = 4;
    /// Maximum time until the inputs read back as they were written; after it they are written again.
    std::chrono::milliseconds inputTimeout{2'000};
    std::size_t inputRetries = 2; ///< Number of times that they are written again before the job fails.
};

} // namespace ACS::Acsd
