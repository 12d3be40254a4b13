#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/ILease.hpp>

#include <optional>
#include <string>

namespace ACS::Planning
{

/// When a standby may take the lease. Pure. It uses no time of the store or of the leader: the lease has ended when its renewal has
/// not changed for its whole duration.
class ACS_API LeaseWatch
{
    std::string _config;
    std::optional<LeaseState> _seen;
    Core::SteadyTime _seenSince;

public:
    /// The config is that of LeaseClaim.
    explicit LeaseWatch(std::string config);

    /// The lease was read; now: after the answer. Returns whether to take it, as it was read. With another configuration than that
    /// of the leader, only a lease that was released may be taken: an operator has ended that leader.
    [[nodiscard]] bool ShouldTake(const LeaseState& state, Core::SteadyTime now);

    /// The lease as read last; nullopt: not yet.
    [[nodiscard]] const std::optional<LeaseState>& GetSeenOrNull() const noexcept;

    /// The leader has another configuration than this process.
    [[nodiscard]] bool IsOtherConfig() const noexcept;
};

} // namespace ACS::Planning
