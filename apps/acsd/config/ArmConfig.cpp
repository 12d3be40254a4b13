#include "config/ArmConfig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;

constexpr std::int64_t HIGHEST_RELAY_BYTE = 65'535;
constexpr std::size_t COUNTER_BYTES = 4;
constexpr std::int64_t HIGHEST_WORD_INDEX = 255;
constexpr std::int64_t MOST_INPUT_RETRIES = 100;
constexpr std::int64_t NO_ECHO = -1;

struct CounterWord
{
    std::string key;
    std::size_t index = 0;
};

std::size_t ReadIndex(const ConfigSection& arm, const std::string& key, std::size_t fallback)
{
    return static_cast<std::size_t>(arm.GetInteger(key, 0, HIGHEST_WORD_INDEX, static_cast<std::int64_t>(fallback)));
}

std::optional<std::size_t> ReadEchoOrNull(const ConfigSection& arm, std::optional<std::size_t> fallbackOrNull)
{
    const std::int64_t present = fallbackOrNull.has_value() ? static_cast<std::int64_t>(*fallbackOrNull) : NO_ECHO;
    const std::int64_t index = arm.GetInteger("counter_echo", NO_ECHO, HIGHEST_WORD_INDEX, present);
    return index == NO_ECHO ? std::nullopt : std::optional(static_cast<std::size_t>(index));
}

/// With the same word, a job would be reported done when it begins. If this table gives no index, the table with the
/// defaults has been checked already.
void RefuseSharedWords(const ConfigSection& arm, const std::vector<CounterWord>& words)
{
    const bool bGiven = std::ranges::any_of(words, [&arm](const CounterWord& word) { return arm.HasKey(word.key); });
    if (!bGiven)
    {
        return;
    }
    for (auto second = words.begin(); second != words.end(); ++second)
    {
        const auto first = std::find_if(words.begin(), second, [&second](const CounterWord& word) {
            return word.index == second->index;
        });
        if (first != second)
        {
            // The error belongs to the key that is given; the other one may be the default.
            const bool bSecond = arm.HasKey(second->key);
            arm.AddError(
                bSecond ? second->key : first->key,
                fmt::format(
                    "is {}, the same as {}.{}: each counter needs a word of its own",
                    second->index,
                    arm.GetPath(),
                    bSecond ? first->key : second->key));
        }
    }
}

/// MONITOR reads all words from the first one to the last counter. Of a table without these keys as for RefuseSharedWords.
void CheckWords(const ConfigSection& arm, std::uint32_t firstByte, const std::vector<CounterWord>& words)
{
    const CounterWord& last = *std::ranges::max_element(words, {}, &CounterWord::index);
    const std::size_t end = firstByte + (last.index + 1) * COUNTER_BYTES;
    const bool bGiven = arm.HasKey("monitor_start")
        || std::ranges::any_of(words, [&arm](const CounterWord& word) { return arm.HasKey(word.key); });
    if (bGiven && end > HIGHEST_RELAY_BYTE + 1)
    {
        arm.AddError(
            arm.HasKey("monitor_start") || !arm.HasKey(last.key) ? "monitor_start" : last.key,
            fmt::format(
                "the word of {}, index {}, ends at byte {}; the last byte of the relays is {}",
                last.key,
                last.index,
                end - 1,
                HIGHEST_RELAY_BYTE));
    }
}

} // namespace

ArmOptions ReadArmOptions(const ConfigSection& arm, const ArmOptions& defaults)
{
    ArmOptions options = defaults;
    options.monitorURL = arm.GetString("monitor_url", options.monitorURL);
    if (arm.HasKey("monitor_url") && !options.monitorURL.starts_with('/'))
    {
        arm.AddError("monitor_url", R"(expected a path that begins with "/", such as "/project/plc/m/val_s32")");
    }
    options.firstByte =
        static_cast<std::uint32_t>(arm.GetInteger("monitor_start", 0, HIGHEST_RELAY_BYTE, options.firstByte));
    options.period = arm.GetDuration("monitor_period", 2ms, 30s, options.period);
    options.startedIndex = ReadIndex(arm, "counter_started", options.startedIndex);
    options.finishedIndex = ReadIndex(arm, "counter_finished", options.finishedIndex);
    options.failedIndex = ReadIndex(arm, "counter_failed", options.failedIndex);
    options.echoIndex = ReadEchoOrNull(arm, options.echoIndex);
    options.inputTimeout = arm.GetDuration("input_timeout", 1ms, 10min, options.inputTimeout);
    options.inputRetries = static_cast<std::size_t>(
        arm.GetInteger("input_retries", 0, MOST_INPUT_RETRIES, static_cast<std::int64_t>(options.inputRetries)));
    std::vector<CounterWord> words{
        {"counter_started", options.startedIndex},
        {"counter_finished", options.finishedIndex},
        {"counter_failed", options.failedIndex}};
    if (options.echoIndex.has_value())
    {
        words.push_back({"counter_echo", *options.echoIndex});
    }
    RefuseSharedWords(arm, words);
    CheckWords(arm, options.firstByte, words);
    return options;
}

} // namespace ACS::Acsd
