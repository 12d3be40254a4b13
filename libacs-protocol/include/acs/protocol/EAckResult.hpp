#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Protocol
{

/// The `result` of an Ack (section 6.1). On receipt, success and ok in any case are Success, everything else is Fail.
enum class EAckResult : std::uint8_t
{
    Success,
    Fail,
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EAckResult result);

} // namespace ACS::Protocol
