#pragma once

#include "common/process/TimerSet.hpp"
#include "standby/LeaseGuard.hpp"
#include "store/ResourceThread.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ILease.hpp>
#include <acs/plan/LeaseMachine.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace ACS::Acsd
{

/// A LeaseMachine with the lease of a store, which is asked in a thread of its own; everything else runs on the executor's thread.
class LeaseKeeper final
{
public:
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        const Core::IClock& clock;
        Core::Logger logger;
        LeaseGuard& guard; ///< Is extended by each renewal.
    };

    /// Makes the lease, whose calls end soon when the function returns true.
    using LeaseMaker = std::function<std::unique_ptr<Planning::ILease>(std::function<bool()> shouldStop)>;

    struct Handlers
    {
        std::function<void(std::uint64_t epoch)> onTaken;
        /// Nothing may be commanded any more. The lease is not taken again by this object.
        std::function<void(const std::string& reason)> onLost;
    };

private:
    Dependencies _dependencies;
    Planning::LeaseClaim _claim;
    Handlers _handlers;
    std::shared_ptr<std::atomic<bool>> _stopping; ///< Ends the call that is under way. Ends with this object.
    ResourceThread<Planning::ILease> _lease;
    Apps::TimerSet<Planning::ELeaseTimer> _timers;
    Planning::LeaseMachine _machine;
    std::function<void()> _onReleased; ///< Of ReleaseAsync.

public:
    /// The clock, the sink of the logger and the guard outlive it.
    LeaseKeeper(Dependencies dependencies, const LeaseMaker& makeLease, Planning::LeaseClaim claim, Handlers handlers);
    LeaseKeeper(const LeaseKeeper&) = delete;
    LeaseKeeper& operator=(const LeaseKeeper&) = delete;

    /// Ends the call of the store that is under way. Calls no handler any more.
    ~LeaseKeeper();

    /// The lease is not taken before the pause has ended: for a process that could not use the store. The reason is shown while no other
    /// process leads.
    void Start(Core::Duration pause = {}, std::string reason = {});

    /// Ends: a lease that is held is released, then the handler is called, later. It replaces a handler that was not called yet.
    void ReleaseAsync(std::function<void()> handler);

    /// Why this process does not lead, as one sentence.
    [[nodiscard]] std::string GetWaitReason() const;

    /// Likewise, without names of the store and its server: for clients that are not identified.
    [[nodiscard]] std::string GetPublicReason() const;

private:
    /// Carries out what the machine asks for.
    void Execute(const Planning::LeaseActions& actions);
    void Execute(const Planning::ReadLease& action);
    void Execute(const Planning::TakeLease& action);
    void Execute(const Planning::RenewLease& action);
    void Execute(const Planning::ReleaseLease& action);
    void Execute(const Planning::StartLeaseTimer& action);
    void Execute(const Planning::LeaseExtended& action);
    void Execute(const Planning::LeaseRevoked& action);
    void Execute(const Planning::LeaseTaken& action) const;
    void Execute(const Planning::LeaseLost& action) const;
    void Execute(const Planning::LeaseFault& action) const;
    void Execute(const Planning::LeaseEnded& action);
    [[nodiscard]] Core::SteadyTime GetNow() const;
};

} // namespace ACS::Acsd
