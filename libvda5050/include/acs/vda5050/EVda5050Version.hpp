#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::VDA5050
{

/// The protocol versions that the codec writes. It reads both.
enum class EVda5050Version : std::uint8_t
{
    Version200, ///< 2.0.0
    Version210, ///< 2.1.0
};

/// The version in the header of a message: "2.0.0", "2.1.0".
[[nodiscard]] ACS_API std::string_view GetVersionText(EVda5050Version version);

/// The version to use with a peer that reports this one: 2.0.0 for 2.0.x, 2.1.0 for a later 2.x, none for other major
/// versions.
[[nodiscard]] ACS_API std::optional<EVda5050Version> ReadVersionOrNull(std::string_view text);

} // namespace ACS::VDA5050
