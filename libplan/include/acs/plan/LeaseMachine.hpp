#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ILease.hpp>
#include <acs/plan/LeaseAction.hpp>
#include <acs/plan/LeaseTerm.hpp>
#include <acs/plan/LeaseWait.hpp>
#include <acs/plan/LeaseWatch.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// Takes the lease of a shared store when it is free, and renews it until it is released or lost. Pure: its owner calls the store, one
/// call after the other, and passes the results in this order; it also runs the timers. All functions append to out what the owner has
/// to do. Used by one thread.
class ACS_API LeaseMachine
{
    enum class EState : std::uint8_t
    {
        Watching,
        Leading,
        Releasing, ///< Release was called, and is not complete.
        Ended
    };

    /// The call of the store that has no result yet, if the next decision depends on it.
    enum class ECall : std::uint8_t
    {
        None,
        Take,
        Renew,
        Release
    };

    LeaseClaim _claim;
    LeaseWatch _watch;
    EState _state = EState::Watching;
    ECall _call = ECall::None;
    Core::SteadyTime _askedAt{}; ///< When the call was requested.
    std::optional<LeaseTerm> _term;
    std::uint64_t _epoch = 0;
    std::string _fault;       ///< Why the store could not be asked the last time; empty: it could.
    std::string _pauseReason; ///< Of Start.
    Core::SteadyTime _pauseEnd{};

public:
    /// The duration is at least LeaseTerm::SHORTEST.
    explicit LeaseMachine(LeaseClaim claim);

    /// Once, first. The lease is not taken before the pause has ended: for a process that could not use the store before. The reason,
    /// which may be empty, is shown while no other process leads.
    void Start(Core::Duration pause, std::string reason, Core::SteadyTime now, LeaseActions& out);

    /// Of StartLeaseTimer. A lease whose time is over is lost.
    void OnTimer(ELeaseTimer timer, Core::SteadyTime now, LeaseActions& out);

    /// The result of ReadLease. A lease that is free is taken.
    void OnRead(const Core::Result<LeaseState>& state, Core::SteadyTime now, LeaseActions& out);

    /// The result of TakeLease. This process leads, unless it took too long: then the lease is released, and read again.
    void OnTaken(const Core::Result<std::optional<std::uint64_t>>& taken, Core::SteadyTime now, LeaseActions& out);

    /// The result of RenewLease. A failed renewal is repeated until the time of the lease is over.
    void OnRenewed(const Core::Result<bool>& renewed, Core::SteadyTime now, LeaseActions& out);

    /// ReleaseLease has a result: also a failed release ends.
    void OnReleased(LeaseActions& out);

    /// Ends the machine: revokes and releases a lease that is held or is being taken. One LeaseEnded follows, at once or later; none for
    /// a call before that.
    void Release(LeaseActions& out);

    /// Why this process does not lead; while it does: TakesOver.
    [[nodiscard]] LeaseWait GetWait() const;

private:
    void ReadLater(LeaseActions& out) const;
    void Renew(Core::SteadyTime now, LeaseActions& out);
    void Lead(std::uint64_t epoch, const LeaseTerm& term, Core::SteadyTime now, LeaseActions& out);
    void Extend(Core::SteadyTime now, LeaseActions& out) const;
    /// A lease that has ended is lost.
    [[nodiscard]] bool HasEnded(Core::SteadyTime now, LeaseActions& out);
    void Lose(std::string reason, LeaseActions& out);
    void End(LeaseActions& out);
    void SetFault(std::string fault, LeaseActions& out);
    /// Empty: the store can be used, or another process leads.
    [[nodiscard]] std::string GetStoreFault() const;
};

} // namespace ACS::Planning
