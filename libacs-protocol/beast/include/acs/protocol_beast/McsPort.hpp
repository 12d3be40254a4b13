#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace ACS::ProtocolBeast
{

/// Where an McsPort listens.
struct PortOptions
{
    std::string address = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 0;            ///< 0: a free port, see GetPort.
    std::size_t maximumClients =
        16; ///< Maximum number of connections of all servers, those before the upgrade included.
    std::optional<TlsOptions> tls{}; ///< If set: wss only, with certificate and key.
    LinkOptions link{};              ///< Of all connections.
};

/// A TCP port that several McsServers share: an MCS with several ACSs, each with a session of its own. A client gets the
/// first server, in the order of their Create, that has its path and whose checkUpgrade accepts it. Runs entirely on the
/// given executor, which must be single-threaded (or a strand), and is called from there only.
class ACS_API McsPort
{
    friend class McsServer;

    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

    explicit McsPort(std::shared_ptr<Impl> impl);

public:
    McsPort(const McsPort&) = delete;
    McsPort& operator=(const McsPort&) = delete;
    /// Accepts no new connections. The servers keep those that they have.
    ~McsPort();

    /// Listens. The error names the address, or the file for TLS, and the remedy. The log sink must outlive the port.
    [[nodiscard]] static Core::Result<std::unique_ptr<McsPort>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::Logger& logger,
        const PortOptions& options);

    /// The port that it listens on.
    [[nodiscard]] std::uint16_t GetPort() const;
};

} // namespace ACS::ProtocolBeast
