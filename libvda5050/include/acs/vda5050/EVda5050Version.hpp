#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::VDA5050
{

/// The protocol versions that the codec writes. Reading is lenient: either version's messages are understood.
enum class EVda5050Version : std::uint8_t
{
    Version200,
    Version210,
};

/// "2.0.0", "2.1.0": what stands in the header of a message.
[[nodiscard]] std::string_view GetVersionText(EVda5050Version version);

/// The version to speak with a peer that says this: any 2.0 is 2.0.0, any later 2.x is 2.1.0, another major is none.
[[nodiscard]] std::optional<EVda5050Version> ReadVersionOrNull(std::string_view text);

} // namespace ACS::VDA5050
