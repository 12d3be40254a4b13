#pragma once

#include "common/http/HttpRoutes.hpp"
#include "config/HttpConfig.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/AuditLog.hpp"
#include "operator/EventFeed.hpp"
#include "operator/HttpAddresses.hpp"
#include "operator/OperatorGate.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>
#include <memory>

namespace ACS::Acsd
{

/// What acsd answers at its two HTTP addresses while it leads: one is for monitoring, which only reads, and one for operators
/// behind the OperatorGate. Used on the executor's thread.
class HttpInterfaces final
{
public:
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        const Core::IClock& clock;
        Core::Logger logger;
        HttpAddresses& addresses;
    };

private:
    Dependencies _dependencies;
    std::unique_ptr<AuditLog> _audit;
    Apps::HttpRoutes _monitoringRoutes;
    OperatorGate _gate;
    boost::asio::steady_timer _keepAlive;
    std::shared_ptr<EventFeed> _events; ///< Flushed by handlers of the executor, which do not own it.
    bool _bOpen = false;

public:
    /// The clock, the addresses and the sink of the logger outlive the interfaces.
    HttpInterfaces(Dependencies dependencies, const AccessPolicy::Options& access, std::unique_ptr<AuditLog> audit);
    HttpInterfaces(const HttpInterfaces&) = delete;
    HttpInterfaces& operator=(const HttpInterfaces&) = delete;

    /// Closes.
    ~HttpInterfaces();

    /// To be filled before Open.
    [[nodiscard]] Apps::HttpRoutes& GetMonitoringRoutes() noexcept;

    /// Of the operator address.
    [[nodiscard]] OperatorGate& GetGate() noexcept;

    /// Of GET /v1/events.
    [[nodiscard]] EventFeed& GetEvents() noexcept;

    /// Answers requests from now on.
    void Open();

    /// Answers no request from now on, and ends all streams.
    void Close();

    /// Replaces the tokens of `present` by those of the same file: a token can be withdrawn without a restart.
    void ReloadTokens(const OperatorConfig& fresh, OperatorConfig& present);

    /// Lines that are missing in the audit log.
    [[nodiscard]] std::uint64_t GetLostAudit() const;

private:
    void RequestFlush();
    void KeepAliveAsync();
};

} // namespace ACS::Acsd
