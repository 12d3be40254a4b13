#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Apps
{

/// What every simulator's faults have in common: which one it is, and when. A program's own Fault derives from it and
/// adds what its kinds need. Times are of the wall clock, not scaled.
template <typename TKind>
struct FaultBase
{
    using Kind = TKind;

    TKind kind{};
    std::string text;                     ///< As written, with single blanks; for the log.
    bool bOnce = false;                   ///< Takes effect once and ends at once.
    Core::Duration delay{};               ///< From the start, or from the arrival at the place, to the begin.
    std::string place;                    ///< Not empty: begins once this was reached (FaultBoard::OnPlace).
    std::optional<Core::Duration> lasts;  ///< Absent: until it is ended, or used up.
    std::optional<Core::Duration> every;  ///< Period of repetition; longer than it lasts.
    std::optional<std::uint32_t> maxUses; ///< Of kinds that are used: how often; absent: once, or while it lasts.

    bool operator==(const FaultBase&) const = default;
};

} // namespace ACS::Apps
