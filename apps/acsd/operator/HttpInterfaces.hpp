#pragma once

#include "common/http/HttpRoutes.hpp"
#include "common/http/HttpServer.hpp"
#include "common/http/HttpTls.hpp"
#include "common/process/ReadyLine.hpp"
#include "config/HttpConfig.hpp"
#include "operator/AuditLog.hpp"
#include "operator/EventFeed.hpp"
#include "operator/OperatorGate.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The two HTTP addresses of acsd: one for monitoring, which only reads, and one for operators behind the OperatorGate. Used on
/// the executor's thread.
class HttpInterfaces final
{
public:
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        const Core::IClock& clock;
        Core::Logger logger;
    };

private:
    Dependencies _dependencies;
    std::unique_ptr<AuditLog> _audit;
    Apps::HttpRoutes _monitoringRoutes;
    OperatorGate _gate;
    Apps::HttpServer::Handler _handlerInstead; ///< Empty: the gate answers.
    boost::asio::steady_timer _keepAlive;
    std::shared_ptr<EventFeed> _events; ///< Flushed by handlers of the executor, which do not own it.
    Apps::HttpServer _monitoring;
    Apps::HttpServer _operator;
    std::vector<Apps::ReadyAddress> _addresses;
    bool _bListening = false;

public:
    /// The clock and the sink of the logger outlive the interfaces.
    HttpInterfaces(Dependencies dependencies, const HttpConfig& config, std::unique_ptr<AuditLog> audit);

    /// To be filled before Listen.
    [[nodiscard]] Apps::HttpRoutes& GetMonitoringRoutes() noexcept;

    /// Of the operator address.
    [[nodiscard]] OperatorGate& GetGate() noexcept;

    /// Has the handler answer all requests of the operator address instead of the gate.
    void ReplaceGate(Apps::HttpServer::Handler handler);

    /// Of GET /v1/events.
    [[nodiscard]] EventFeed& GetEvents() noexcept;

    [[nodiscard]] Core::Result<void> Listen(const HttpConfig& config);
    void Stop();

    /// Takes the tokens of the same file into `present`, and reads the TLS files of `present` again, for later connections: a
    /// token can be withdrawn and a certificate renewed without a restart.
    void Reload(const OperatorConfig& fresh, OperatorConfig& present);

    /// On which they listen, by name.
    [[nodiscard]] const std::vector<Apps::ReadyAddress>& GetAddresses() const noexcept;

    /// Lines that are missing in the audit log.
    [[nodiscard]] std::uint64_t GetLostAudit() const;

private:
    void RequestFlush();
    void KeepAliveAsync();
    void ReloadTokens(const OperatorConfig& fresh, OperatorConfig& present);
    [[nodiscard]] Core::Result<void> UseTLS(const Apps::HttpTlsFiles& files);
    [[nodiscard]] Core::Result<void> ListenOn(
        Apps::HttpServer& server,
        const std::string& name,
        const HttpListenConfig& config);
};

} // namespace ACS::Acsd
