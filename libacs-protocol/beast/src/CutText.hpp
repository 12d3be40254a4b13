#pragma once

#include <cstddef>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// The text, or as much of its beginning as fits into so many bytes without a part of a character (UTF-8).
[[nodiscard]] std::string_view CutAtCharacter(std::string_view text, std::size_t maximum);

} // namespace ACS::ProtocolBeast
