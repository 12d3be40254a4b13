#pragma once

#include <acs/protocol/SessionOptions.hpp>

#include <cstddef>
#include <cstdint>

namespace ACS::McsSim
{

/// Whose habits the MCS has.
enum class EProfile : std::uint8_t
{
    Spec,  ///< Those of the document.
    Nexus, ///< Those of the public MCS (section 12 of the specification).
};

/// The buffer into which the public MCS reads.
inline constexpr std::size_t NEXUS_BUFFER_BYTES = 4096;

/// The session's part of a profile.
[[nodiscard]] Protocol::McsSessionOptions MakeSessionOptions(EProfile profile);

} // namespace ACS::McsSim
