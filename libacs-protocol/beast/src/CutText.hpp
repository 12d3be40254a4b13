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

/// What a peer has written for people, in quotation marks: UTF-8 without control characters, "..." for what exceeds the limit.
[[nodiscard]] std::string QuoteReason(std::string_view text);

} // namespace ACS::ProtocolBeast
