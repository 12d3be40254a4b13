#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// The text; one that is not UTF-8 has '?' for each byte outside of ASCII. RFC 6455, section 5.5.1: a reason is UTF-8.
[[nodiscard]] std::string MakeUTF8(std::string_view text);

/// The text, truncated to this number of bytes at a character boundary (UTF-8).
[[nodiscard]] std::string_view CutAtCharacter(std::string_view text, std::size_t maximum);

} // namespace ACS::ProtocolBeast
