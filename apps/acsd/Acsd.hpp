#pragma once

#include "config/AcsdConfig.hpp"
#include "operator/HttpAddresses.hpp"
#include "store/OpenStore.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace ACS::Acsd
{

/// acsd as a whole: the I/O around AcsdCore, which are its store, the link to the MCS, the broker, the robots and HTTP. One
/// thread: the executor's.
class Acsd final
{
public:
    using StopHandler = std::function<void()>;

    /// All references must outlive acsd.
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        Core::IClock& clock;
        Core::IRandom& random;
        Core::Logger logger;
        MessageTrace* traceOrNull = nullptr;
        /// Log lines that were dropped until now; empty where nothing is dropped.
        std::function<std::uint64_t()> countDroppedLines;
        /// Called from the event loop at aliveInterval, which is 0 without a watchdog.
        std::function<void()> onAlive;
        Core::Duration aliveInterval{};
        /// Another program has taken the store. The owner must destroy acsd, later.
        std::function<void(const std::string& reason)> onStoreTaken = [](const std::string& /*reason*/) {
        };
        /// Whether robots may be commanded, asked before each message; empty: they always may.
        std::function<bool()> mayCommand{};
    };

private:
    class Impl;

    std::unique_ptr<Impl> _impl;

    explicit Acsd(std::unique_ptr<Impl> impl);

public:
    Acsd(const Acsd&) = delete;
    Acsd& operator=(const Acsd&) = delete;
    ~Acsd();

    /// Restores the contents of the store and answers at the HTTP addresses, which outlive acsd; opens no connection. The
    /// configuration must be without errors. Fails with a sentence about the TLS files of the MCS or the audit log and its remedy.
    [[nodiscard]] static Core::Result<std::unique_ptr<Acsd>> Create(
        Dependencies dependencies,
        HttpAddresses& addresses,
        AcsdConfig config,
        OpenedStore store);

    /// Connects to the MCS, the broker and the arms, and reconnects until it is stopped.
    void Start();

    /// Applies the keys that may change while acsd runs. The fresh configuration must be without errors. Logs for each key
    /// that differs whether it was applied or needs a restart.
    void Reload(const AcsdConfig& fresh);

    /// Refuses plans and controls from now on, waits until the MCS has acknowledged all reports (at most
    /// `shutdown.drain_timeout`), closes all links within AcsdCore::STOP_LIMIT, then calls back, once. Robots continue.
    void StopAsync(StopHandler handler);
};

} // namespace ACS::Acsd
