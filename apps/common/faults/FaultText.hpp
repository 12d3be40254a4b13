#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Apps
{

// Each function reads the value of a KEY=VALUE. It returns an empty text, or the expected value.

[[nodiscard]] std::string ReadDurationValue(std::string_view text, Core::Duration& target);
/// 0 to max.
[[nodiscard]] std::string ReadNumberValue(std::string_view text, double max, double& target);
/// 1 to max.
[[nodiscard]] std::string ReadCountValue(std::string_view text, std::uint32_t max, std::uint32_t& target);
[[nodiscard]] std::string ReadNameValue(std::string_view text, std::string& target);

/// Allowed words and their values.
template <typename TValue, std::size_t Count>
using ValueEnumNames = std::array<std::pair<std::string_view, TValue>, Count>;

template <typename TValue, std::size_t Count>
[[nodiscard]] std::string ReadWordValue(
    std::string_view text,
    const ValueEnumNames<TValue, Count>& words,
    TValue& target)
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

/// Checks that the line of a command has at most 1000 bytes and is valid UTF-8.
[[nodiscard]] Core::Result<void> CheckCommandLine(std::string_view line);

/// Calls the reader with each line of a file or message that has a command. Empty lines, comments after `#` and a byte order
/// mark are skipped. More than 1000 commands are refused. The path of an error begins with "line N".
[[nodiscard]] Core::Result<void> ReadCommandLines(
    std::string_view text,
    const std::function<Core::Result<void>(std::string_view line)>& reader);

/// Whether the targets of a command (a name, or a prefix and `*`) include this name.
[[nodiscard]] bool IsTarget(std::string_view targets, std::string_view name);

} // namespace ACS::Apps
