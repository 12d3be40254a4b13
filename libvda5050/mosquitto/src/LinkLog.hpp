#pragma once

#include "BrokerRotation.hpp"
#include <acs/core/Logger.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace ACS::VDA5050
{

/// What a MosquittoLink logs: each outage once for each broker and not for each attempt, with the reason and the remedy.
class LinkLog
{
    Core::Logger _logger;
    const MosquittoOptions& _options;
    const BrokerRotation& _rotation;
    std::set<std::size_t> _outages;    ///< Brokers, since the last connection.
    std::set<std::size_t> _refusals;   ///< Brokers, since the last connection.
    bool _bLaterRefusalLogged = false; ///< In this connection.
    bool _bTooLongLogged = false;      ///< In this connection.
    bool _bRivalLogged = false;

public:
    /// Both outlive the log.
    LinkLog(Core::Logger logger, const MosquittoOptions& options, const BrokerRotation& rotation);

    /// An attempt to connect begins.
    void OnAttempt() noexcept;

    /// The link is up. earlyDropped: messages that were dropped before.
    void OnUp(std::size_t earlyDropped);

    /// Another client with the same id would have been back by now.
    void ForgetRival() noexcept;

    void OnOutage(bool bWasUp, const std::error_code& reason);
    void OnRenewal() const;
    void OnRival(const std::error_code& reason);
    void OnTooLong(const std::string& topic, std::size_t bytes);

    /// A subscription that the link waits for was refused.
    void OnRefused(const std::string& filter);

    /// A subscription that came later was refused.
    void OnLaterRefused(const std::string& filter);

    /// A subscription could not be sent.
    void OnUnsent(const std::string& filter) const;

private:
    [[nodiscard]] std::string GetAddress() const;
    [[nodiscard]] std::string GetAddress(std::size_t index) const;
    [[nodiscard]] std::string MakePlan(std::string_view until) const;
};

/// The broker with this number: 0 is MosquittoOptions::host, N the Nth of furtherBrokers.
[[nodiscard]] MosquittoBroker GetBroker(const MosquittoOptions& options, std::size_t index);

} // namespace ACS::VDA5050
