#pragma once

#include "Acsd.hpp"
#include "common/process/LoopWatchdog.hpp"
#include "config/AcsdConfig.hpp"
#include "standby/BootClock.hpp"
#include "standby/LeaseGuard.hpp"
#include "standby/LeaseKeeper.hpp"
#include "standby/StandbyRoutes.hpp"
#include "standby/TakeoverPause.hpp"
#include "store/OpenStore.hpp"
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/thread_pool.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// acsd from its start to its end. With a store of this machine it leads at once. With a shared one it is a standby until it has the
/// lease, and again when it has lost it. One thread: the executor's. It outlives the event loop.
class AcsdService final
{
public:
    struct Handlers
    {
        std::function<void()> onStopped; ///< The end of a stop.
        /// It cannot continue: another program has taken the store of this machine, or the audit log or a TLS file cannot be
        /// opened again. It is logged.
        std::function<void()> onFailed;
    };

private:
    enum class EState : std::uint8_t
    {
        Starting,
        Standby,
        Opening, ///< The lease is held, and the store is read.
        Leading,
        Stopping
    };

    Acsd::Dependencies _dependencies;
    AcsdConfig _config;
    const std::string _fingerprint; ///< Of the configuration as it was read.
    Handlers _handlers;
    BootClock _leaseClock;
    LeaseGuard _guard;
    HttpAddresses _addresses;
    std::unique_ptr<LeaseKeeper> _keeper;        ///< Of a shared store.
    std::optional<Apps::LoopWatchdog> _watchdog; ///< While there is no Acsd, which has its own.
    StandbyRoutes _standby;
    std::unique_ptr<Acsd> _acsd; ///< Set while this process leads.
    TakeoverPause _takeoverPause;
    Core::Duration _pause{}; ///< Before the lease is taken again.
    std::string _storeFault; ///< Why the store could not be used when this process led; empty: it was not the reason.
    EState _state = EState::Starting;
    std::uint64_t _epoch = 0;            ///< Of the lease that was taken last.
    boost::asio::thread_pool _opener{1}; ///< Reads a shared store while the lease is renewed.

public:
    /// What the dependencies refer to outlives the service; the configuration has no errors.
    AcsdService(Acsd::Dependencies dependencies, AcsdConfig config, Handlers handlers);
    AcsdService(const AcsdService&) = delete;
    AcsdService& operator=(const AcsdService&) = delete;

    /// Waits for calls of a shared store, which end soon.
    ~AcsdService();

    /// Fails with a sentence about the store or an HTTP address, and its remedy. A shared store may be opened later.
    [[nodiscard]] Core::Result<void> Start();

    /// As Acsd::StopAsync; a lease is released. Ends with onStopped.
    void StopAsync();

    /// As Acsd::Reload, also for the times when this process is a standby and when it leads again.
    void Reload(const AcsdConfig& fresh);

    /// As HttpAddresses::GetAddresses. They stay open when the process begins or ceases to lead.
    [[nodiscard]] const std::vector<Apps::ReadyAddress>& GetAddresses() const noexcept;

private:
    [[nodiscard]] Core::Result<void> CheckAuditLog() const;
    [[nodiscard]] Core::Result<void> CreateAcsd(OpenedStore store);
    void BeStandby();
    void Lead();
    void OnTaken(std::uint64_t epoch);
    void OnOpened(std::uint64_t epoch, Core::Result<OpenedStore> store);
    void LoseStore(const std::string& reason);
    void LoseLead(const std::string& reason);
    void Finish();
    void Fail(const Core::Error& error) const;
};

} // namespace ACS::Acsd
