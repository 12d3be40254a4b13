#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>

#include <chrono>

namespace ACS::Planning
{

/// How long a leader may command. Pure. All times are of this process: clocks of other machines do not matter, only that all
/// steady clocks run at about the same speed.
class ACS_API LeaseTerm
{
public:
    /// A leader stops this time before a standby may take the lease: for messages that are on their way.
    static constexpr std::chrono::milliseconds MARGIN{500};

    /// The shortest lease. Half of it is left to work after the margin.
    static constexpr std::chrono::milliseconds SHORTEST{2'000};

    /// The longest lease.
    static constexpr std::chrono::milliseconds LONGEST{60'000};

private:
    Core::Duration _duration;
    Core::SteadyTime _renewedAt;

public:
    /// askedAt: when the request was made that took the lease.
    LeaseTerm(Core::Duration duration, Core::SteadyTime askedAt) noexcept;

    /// A renewal has succeeded. askedAt: when it was requested.
    void OnRenewed(Core::SteadyTime askedAt) noexcept;

    /// Whether the process may command at this time.
    [[nodiscard]] bool IsHeld(Core::SteadyTime now) const noexcept;

    /// From then on it must not.
    [[nodiscard]] Core::SteadyTime GetEnd() const noexcept;

    /// The interval of renewals, several of which fit into the lease.
    [[nodiscard]] Core::Duration GetRenewInterval() const noexcept;
};

} // namespace ACS::Planning
