#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// Which process leads, as the store shows it. Several processes may have one store: only the leader stores plans and commands
/// robots, the others are standbys.
struct LeaseState
{
    std::uint64_t epoch = 0;               ///< One higher with each leader; 0: there was none.
    std::uint64_t renewal = 0;             ///< One higher with each renewal.
    std::string holder;                    ///< Name of the leader, for people.
    std::string config;                    ///< LeaseClaim::config of the leader.
    std::chrono::milliseconds duration{0}; ///< The lease ends this time after its last renewal.
    bool bReleased = true;                 ///< The leader has ended properly: it commands nothing any more.

    bool operator==(const LeaseState&) const = default;
};

/// What a process writes when it takes the lease.
struct LeaseClaim
{
    std::string holder; ///< As of LeaseState.
    std::string config; ///< Identifies what all processes of a store must agree about: site, robots, options.
    std::chrono::milliseconds duration{0}; ///< As of LeaseState.
};

/// The lease of a store. Used by one thread; calls block, each for a limited time. Errors of all functions:
/// EPlanningError::StoreFailed, StoreCorrupt, StoreTooNew.
class ACS_API ILease
{
public:
    ILease() = default;
    ILease(const ILease&) = delete;
    ILease& operator=(const ILease&) = delete;
    virtual ~ILease() = default;

    /// Reads the present state.
    [[nodiscard]] virtual Core::Result<LeaseState> Read() = 0;

    /// Takes the lease if it is still as seen: from then on, no transaction of a former leader is stored. Returns the new epoch;
    /// nullopt if the lease has changed. A failure may have taken the lease; the process must not lead then.
    [[nodiscard]] virtual Core::Result<std::optional<std::uint64_t>> TryTakeOrNull(
        const LeaseState& seen,
        const LeaseClaim& claim) = 0;

    /// Renews the lease; false if another process has taken it.
    [[nodiscard]] virtual Core::Result<bool> TryRenew(std::uint64_t epoch) = 0;

    /// Ends the lease at once, so that a standby need not wait. Call it when nothing is commanded any more.
    [[nodiscard]] virtual Core::Result<void> Release(std::uint64_t epoch) = 0;
};

} // namespace ACS::Planning
