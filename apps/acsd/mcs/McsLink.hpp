#pragma once

#include "common/log/LogRateLimiter.hpp"
#include "config/AcsdConfig.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/McsNoteLog.hpp"
#include "mcs/RegistrationWatch.hpp"
#include "trace/MessageTrace.hpp"
#include "view/ProgramState.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The session with the MCS over a WebSocket, and its log. One thread: the executor's.
class McsLink final : public IMcsOutput, private ProtocolBeast::ISessionHandler
{
public:
    using EventHandler = std::function<void(const Protocol::SessionEvent& event)>;
    using StopHandler = std::function<void()>;

    /// In addition to the statistics of the session.
    struct Metrics
    {
        bool bConnected = false;
        std::size_t longestSent = 0; ///< Bytes of the longest message that was sent.
        std::uint64_t unanswered = 0;
    };

private:
    const Core::IClock& _clock;
    Core::Logger _logger;
    Apps::LogRateLimiter _log; ///< For lines that the MCS can trigger.
    McsNoteLog _notes;
    RegistrationWatch _watch;
    EventHandler _handler;
    StopHandler _stopHandler;
    std::unique_ptr<ProtocolBeast::AcsClient> _client;
    std::string _url;
    Metrics _metrics;
    std::uint64_t _connectsBefore = 0; ///< Value at the last loss of a connection or failed attempt.
    std::size_t _warnBytes = 0;
    MessageTrace* _traceOrNull = nullptr;
    std::string _loggedOutage; ///< The reason that was logged last for the present outage.

public:
    /// The clock must outlive the link.
    McsLink(const Core::IClock& clock, Core::Logger logger, EventHandler handler);
    McsLink(const McsLink&) = delete;
    McsLink& operator=(const McsLink&) = delete;
    ~McsLink() override;

    /// Call once, before everything else. Fails with a sentence about the URL; opens no connection. The trace must outlive the
    /// link.
    [[nodiscard]] Core::Result<void> Open(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        const AcsdConfig& config,
        MessageTrace* traceOrNull);

    void Start();

    /// Applies the keys that may change while acsd runs (see LiveConfig).
    void SetLimits(const McsConfig& config);

    /// Reads the TLS files again, for the next connection.
    void ReloadTLS();

    /// Reports the end to the MCS, closes the connection, then calls back.
    void StopAsync(StopHandler handler);

    [[nodiscard]] bool IsRegistered() const override;
    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override;
    void ReplayDone() override;
    void SendStatus(const Protocol::AcsPayload& status) override;
    void SendPosition(const Protocol::RobotPositionUpdate& positions) override;
    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override;
    void SetSiteOffset(std::chrono::minutes offset) override;

    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
    [[nodiscard]] Metrics GetMetrics() const;
    /// Up while acsd is registered.
    [[nodiscard]] LinkStatus GetLink() const;

private:
    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void LogEvent(const Protocol::SessionEvent& event);
    void Warn(std::string_view kind, std::string_view message, std::initializer_list<Core::LogField> fields);
    void WatchWire(ProtocolBeast::EWireDirection direction, std::string_view text);
    void LogOutage(const Protocol::LinkLost& lost);
};

} // namespace ACS::Acsd
