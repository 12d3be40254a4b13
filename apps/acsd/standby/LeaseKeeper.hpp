#pragma once

#include "common/process/TimerSet.hpp"
#include "standby/LeaseGuard.hpp"
#include "store/ResourceThread.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ILease.hpp>
#include <acs/plan/LeaseTerm.hpp>
#include <acs/plan/LeaseWatch.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Takes the lease of a shared store when it is free, and renews it until it is released or lost. The store is asked in a thread of
/// its own; everything else runs on the executor's thread.
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
    enum class EState : std::uint8_t
    {
        Watching,
        Leading,
        Ended
    };

    enum class ETimer : std::uint8_t
    {
        Read,
        Renew,
        End
    };

    Dependencies _dependencies;
    Planning::LeaseClaim _claim;
    Handlers _handlers;
    Planning::LeaseWatch _watch;
    std::shared_ptr<std::atomic<bool>> _stopping; ///< Ends the call that is under way.
    ResourceThread<Planning::ILease> _lease;
    Apps::TimerSet<ETimer> _timers;
    EState _state = EState::Watching;
    std::uint64_t _epoch = 0;
    std::optional<Planning::LeaseTerm> _term;
    std::string _fault;       ///< Why the store could not be asked the last time; empty: it could.
    std::string _pauseReason; ///< Of StartAfter.
    Core::SteadyTime _pauseEnd{};
    bool _bRenewing = false;
    bool _bTaking = false;
    std::function<void()> _onReleased; ///< Of ReleaseAsync, while the lease is being taken.

public:
    /// The clock, the sink of the logger and the guard outlive it.
    LeaseKeeper(Dependencies dependencies, const LeaseMaker& makeLease, Planning::LeaseClaim claim, Handlers handlers);
    LeaseKeeper(const LeaseKeeper&) = delete;
    LeaseKeeper& operator=(const LeaseKeeper&) = delete;

    /// Ends the call of the store that is under way. Calls no handler any more.
    ~LeaseKeeper();

    void Start();

    /// Likewise, for a process that could not use the store: does not take the lease before the pause has ended. The reason is shown
    /// while no other process leads.
    void StartAfter(Core::Duration pause, std::string reason);

    /// Ends: a lease that is held is released, then the handler is called, later. Call it when nothing is commanded any more.
    void ReleaseAsync(std::function<void()> handler);

    /// Why this process does not lead, as one sentence.
    [[nodiscard]] std::string GetWaitReason() const;

    /// Likewise, without names of the store and its server: for clients that are not identified.
    [[nodiscard]] std::string GetPublicReason() const;

private:
    void OnTimer(ETimer timer);
    void Read();
    void OnRead(const Core::Result<Planning::LeaseState>& state);
    void Take(const Planning::LeaseState& seen);
    void OnTaken(const Core::Result<std::optional<std::uint64_t>>& taken, Core::SteadyTime askedAt);
    void Renew();
    void OnRenewed(const Core::Result<bool>& renewed, Core::SteadyTime askedAt);
    [[nodiscard]] bool HasEnded();
    void Extend();
    void ReadLater();
    void ReleaseTaken(std::uint64_t epoch, std::function<void()> handler);
    void SetFault(std::string fault);
    [[nodiscard]] std::string GetStoreFault() const;
    void Lose(const std::string& reason);
};

} // namespace ACS::Acsd
