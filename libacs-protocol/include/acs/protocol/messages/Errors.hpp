#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// Section 6.15.
enum class EErrorLevel : std::uint8_t
{
    Heavy,
    Light,
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EErrorLevel level);

/// ACS to MCS: an error or warning came or went (section 6.15). Also an entry of ErrorListAck, there always set.
/// What does not apply is left out, never null: an MCS exists that cannot read a null stepNo.
struct ErrorReport
{
    std::string robotID;
    std::optional<std::string> planID;
    bool bSet = true; ///< `state` on the wire: false is a cleared error.
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::string errorCode;
    EErrorLevel level = EErrorLevel::Heavy;
    std::string message;

    bool operator==(const ErrorReport&) const = default;
};

/// MCS to ACS: which errors are set (section 6.17)? Acknowledged with ErrorListAck.
struct RequestAcsErrorList
{
    bool operator==(const RequestAcsErrorList&) const = default;
};

} // namespace ACS::Protocol
