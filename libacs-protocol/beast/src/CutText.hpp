#pragma once

#include <cstddef>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// The text, truncated to this number of bytes at a character boundary (UTF-8).
[[nodiscard]] std::string_view CutAtCharacter(std::string_view text, std::size_t maximum);

} // namespace ACS::ProtocolBeast
