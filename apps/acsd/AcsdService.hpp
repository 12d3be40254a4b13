#pragma once

#include "Acsd.hpp"
#include "config/AcsdConfig.hpp"
#include "standby/LeaseGuard.hpp"
#include "standby/LeaseKeeper.hpp"
#include "standby/StandbyServer.hpp"
#include "store/OpenStore.hpp"
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// acsd from its start to its end. With a store of this machine it leads at once. With a shared one it is a standby until it has the
/// lease, and again when it has lost it. One thread: the executor's.
class AcsdService final
{
public:
    struct Handlers
    {
        std::function<void()> onStopped; ///< The end of a stop.
        /// It cannot continue: another program has taken the store of this machine, or what was opened at the start cannot be opened
        /// by a leader.
        std::function<void(const std::string& reason)> onFailed;
    };

private:
    Acsd::Dependencies _dependencies;
    AcsdConfig _config;
    Handlers _handlers;
    LeaseGuard _guard;
    std::unique_ptr<LeaseKeeper> _keeper; ///< Of a shared store.
    std::unique_ptr<StandbyServer> _standby;
    std::unique_ptr<Acsd> _acsd; ///< Set while this process leads.
    bool _bStopping = false;

public:
    /// What the dependencies refer to outlives the service; the configuration has no errors.
    AcsdService(Acsd::Dependencies dependencies, AcsdConfig config, Handlers handlers);
    AcsdService(const AcsdService&) = delete;
    AcsdService& operator=(const AcsdService&) = delete;
    ~AcsdService() = default;

    /// Fails with a sentence about the store or an HTTP address, and its remedy. A shared store may be opened later.
    [[nodiscard]] Core::Result<void> Start();

    /// As Acsd::StopAsync; a lease is released. Ends with onStopped.
    void StopAsync();

    /// As Acsd::Reload; a standby takes all keys.
    void Reload(const AcsdConfig& fresh);

    /// As Acsd::GetAddresses. They stay the same when the process begins or ceases to lead.
    [[nodiscard]] std::vector<Apps::ReadyAddress> GetAddresses() const;

private:
    [[nodiscard]] Core::Result<void> StartStandby();
    [[nodiscard]] Core::Result<void> Lead(OpenedStore store);
    void OnTaken(std::uint64_t epoch);
    void LoseLead(const std::string& reason);
    void Finish();
    void KeepPorts(const std::vector<Apps::ReadyAddress>& addresses);
};

} // namespace ACS::Acsd
