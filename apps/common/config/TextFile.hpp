#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <string>

namespace ACS::Apps
{

/// Limits the memory that a wrong path can use; valid files are shorter.
constexpr std::size_t MAX_TEXT_FILE_BYTES = 64U * 1024U * 1024U;

/// The content of a regular file, or why it cannot be read ("No such file or directory", "Is a directory", "it is a pipe;
/// …"), without its name. Never blocks for another program: a FIFO or a device is refused without reading it.
[[nodiscard]] tl::expected<std::string, std::string> ReadTextFile(const std::string& path);

/// The same with a limit of the caller.
[[nodiscard]] tl::expected<std::string, std::string> ReadTextFileUpTo(
    const std::string& path,
    std::size_t maximumBytes);

} // namespace ACS::Apps
