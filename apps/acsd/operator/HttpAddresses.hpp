#pragma once

#include "common/http/HttpServer.hpp"
#include "common/http/HttpTls.hpp"
#include "common/process/ReadyLine.hpp"
#include "config/HttpConfig.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The two HTTP addresses of acsd, which stay open from its start to its end. What they answer changes when the process begins or
/// ceases to lead. One thread: the executor's.
class HttpAddresses final
{
public:
    struct Handlers
    {
        Apps::HttpServer::Handler monitoring; ///< Of the address that only reads; empty: 503.
        Apps::HttpServer::Handler control;    ///< Of the operator address; empty: 503.
    };

private:
    Core::Logger _logger;
    Apps::HttpServer _monitoring;
    Apps::HttpServer _operator;
    std::vector<Apps::ReadyAddress> _addresses;

public:
    /// The sink of the logger outlives the addresses.
    HttpAddresses(const boost::asio::any_io_executor& executor, const Core::Logger& logger, const HttpConfig& config);

    /// Fails with a sentence about an address or a TLS file.
    [[nodiscard]] Core::Result<void> Listen(const HttpConfig& config);

    /// As HttpServer::SetHandler. They are called until others are set.
    void SetHandlers(Handlers handlers);

    /// Reads the files again, for later connections: a certificate can be renewed without a restart. What cannot be read is
    /// logged.
    void ReloadTLS(const Apps::HttpTlsFiles& files);

    /// Closes them and all connections.
    void Stop();

    /// On which they listen: "http" for monitoring, "operator".
    [[nodiscard]] const std::vector<Apps::ReadyAddress>& GetAddresses() const noexcept;

private:
    [[nodiscard]] Core::Result<void> UseTLS(const Apps::HttpTlsFiles& files);
    [[nodiscard]] Core::Result<void> ListenOn(
        Apps::HttpServer& server,
        const std::string& name,
        const HttpListenConfig& config);
};

} // namespace ACS::Acsd
