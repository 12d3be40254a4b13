#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/ILease.hpp>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// The timers of a LeaseMachine; there is at most one of each.
enum class ELeaseTimer : std::uint8_t
{
    Read,  ///< A standby reads the lease again.
    Renew, ///< The leader renews it.
    End    ///< The lease of the leader ends.
};

/// Call ILease::Read, then LeaseMachine::OnRead.
struct ReadLease
{
    bool operator==(const ReadLease&) const = default;
};

/// Call ILease::TryTakeOrNull, then LeaseMachine::OnTaken.
struct TakeLease
{
    LeaseState seen; ///< The lease as it was read; it is taken only if it is still so.

    bool operator==(const TakeLease&) const = default;
};

/// Call ILease::TryRenew, then LeaseMachine::OnRenewed.
struct RenewLease
{
    std::uint64_t epoch = 0; ///< Of this process's lease.

    bool operator==(const RenewLease&) const = default;
};

/// Call ILease::Release, then LeaseMachine::OnReleased.
struct ReleaseLease
{
    std::uint64_t epoch = 0; ///< Of this process's lease.

    bool operator==(const ReleaseLease&) const = default;
};

/// Call LeaseMachine::OnTimer after the delay. A running timer of this kind starts again; LeaseRevoked cancels all.
struct StartLeaseTimer
{
    ELeaseTimer timer = ELeaseTimer::Read;
    Core::Duration delay{};

    bool operator==(const StartLeaseTimer&) const = default;
};

/// This process may command until then, or until LeaseRevoked. Check the time before each message: a process can stall.
struct LeaseExtended
{
    Core::SteadyTime end; ///< From then on nothing may be commanded.

    bool operator==(const LeaseExtended&) const = default;
};

/// Nothing may be commanded any more. Cancel all timers.
struct LeaseRevoked
{
    bool operator==(const LeaseRevoked&) const = default;
};

/// This process leads. Always the last action of its list.
struct LeaseTaken
{
    std::uint64_t epoch = 0; ///< For each transaction of this process: LeaseState::epoch.

    bool operator==(const LeaseTaken&) const = default;
};

/// This process does not lead any more; the machine has ended. Always the last action of its list.
struct LeaseLost
{
    std::string reason;

    bool operator==(const LeaseLost&) const = default;
};

/// The store cannot be read or written; reported once for each reason.
struct LeaseFault
{
    std::string reason;

    bool operator==(const LeaseFault&) const = default;
};

/// What LeaseMachine::Release began is complete. Always the last action of its list.
struct LeaseEnded
{
    bool operator==(const LeaseEnded&) const = default;
};

/// What a LeaseMachine asks of its owner.
using LeaseAction = std::variant<
    ReadLease,
    TakeLease,
    RenewLease,
    ReleaseLease,
    StartLeaseTimer,
    LeaseExtended,
    LeaseRevoked,
    LeaseTaken,
    LeaseLost,
    LeaseFault,
    LeaseEnded>;

/// To be carried out in this order.
using LeaseActions = std::vector<LeaseAction>;

} // namespace ACS::Planning
