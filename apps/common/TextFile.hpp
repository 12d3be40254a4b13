#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <string>

namespace ACS::Apps
{

/// A longer file is none that a program here reads; it keeps /dev/zero and a wrong path from filling the memory.
constexpr std::size_t MAX_TEXT_FILE_BYTES = 64U * 1024U * 1024U;

/// The whole file, or why it cannot be read ("No such file or directory", "Is a directory"), without its name.
[[nodiscard]] tl::expected<std::string, std::string> ReadTextFile(const std::string& path);

} // namespace ACS::Apps
