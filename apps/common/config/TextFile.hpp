#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <string>

namespace ACS::Apps
{

/// Protects the memory from a wrong path: no valid file is longer.
constexpr std::size_t MAX_TEXT_FILE_BYTES = 64U * 1024U * 1024U;

/// The whole of a regular file, or why it cannot be read ("No such file or directory", "Is a directory", "it is a pipe;
/// …"), without its name. Never waits for another program: a FIFO or a device is refused unread.
[[nodiscard]] tl::expected<std::string, std::string> ReadTextFile(const std::string& path);

/// The same with the caller's limit.
[[nodiscard]] tl::expected<std::string, std::string> ReadTextFileUpTo(
    const std::string& path,
    std::size_t maximumBytes);

} // namespace ACS::Apps
