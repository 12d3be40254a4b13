#pragma once

#include "wire/McsBehaviour.hpp"

#include <cstddef>
#include <cstdint>

namespace ACS::McsSim
{

/// MCS behaviour profile.
enum class EProfile : std::uint8_t
{
    Spec,  ///< As specified.
    Nexus, ///< As the public MCS behaves.
};

/// Size of the receive buffer of the public MCS.
inline constexpr std::size_t NEXUS_BUFFER_BYTES = 4096;

[[nodiscard]] McsBehaviour MakeBehaviour(EProfile profile);

} // namespace ACS::McsSim
