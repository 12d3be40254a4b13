#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Apps
{

/// Base of the faults of all simulators: kind and times. The Fault of a program derives from it and adds the parameters of its
/// kinds. Times are real time, not scaled.
template <typename TKind>
struct FaultBase
{
    using Kind = TKind;

    TKind kind{};
    std::string text;                     ///< As written, with single blanks; for the log.
    bool bOnce = false;                   ///< Takes effect once and ends immediately.
    Core::Duration delay{};               ///< Delay of its begin, after the start or after the place was reached.
    std::string place;                    ///< Not empty: begins when this place is reached (FaultBoard::OnPlace).
    std::optional<Core::Duration> lasts;  ///< Duration; nullopt: until it is ended or used up.
    std::optional<Core::Duration> every;  ///< Period of repetition, longer than `lasts`.
    std::optional<std::uint32_t> maxUses; ///< Maximum number of uses; nullopt: once, or unlimited if `lasts` is given.

    bool operator==(const FaultBase&) const = default;
};

} // namespace ACS::Apps
