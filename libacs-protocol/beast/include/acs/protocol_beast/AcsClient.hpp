#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/SessionStatistics.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <memory>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// An AcsSession over a WebSocket: connects, registers and reconnects indefinitely. Runs entirely on the given executor,
/// which must be single-threaded (or a strand), and is called from there only.
class ACS_API AcsClient
{
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

    explicit AcsClient(std::shared_ptr<Impl> impl);

public:
    AcsClient(const AcsClient&) = delete;
    AcsClient& operator=(const AcsClient&) = delete;
    /// Closes the connection at once, without a closing handshake; the handler is not called any more.
    ~AcsClient();

    /// Opens no connection. The error concerns the URL, a header or a TLS file. Clock, random source, log sink and handler
    /// must outlive the client.
    [[nodiscard]] static Core::Result<std::unique_ptr<AcsClient>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        const ClientOptions& options,
        ISessionHandler& handler);

    /// AcsSession::Start: connects, and reconnects until Stop. This and the following calls run AcsSession's function of the
    /// same name and carry out its actions; events reach the handler after the call has returned.
    void Start();
    /// AcsSession::Stop: reports isConnected=false, then closes. The last event is Stopped.
    void Stop();
    /// AcsSession::TrySendDurable: sends a report. False: keep it and send it after Registered or WindowOpened.
    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request);
    /// AcsSession::ReplayDone: ends the replay after Registered, once per connection.
    void ReplayDone();
    /// AcsSession::SendStatus: a TscStateUpdate, AcsCommStateUpdate or RobotStatusUpdate, whose latest value is kept and sent.
    void SendStatus(const Protocol::AcsPayload& status);
    /// AcsSession::SendPosition: positions that may be dropped.
    void SendPosition(const Protocol::RobotPositionUpdate& positions);
    /// AcsSession::Answer: the Ack of a RequestReceived.
    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload);
    /// AcsSession::SetSiteOffset: UTC offset of the timestamps that are sent from now on, and of those without one that are received.
    void SetSiteOffset(std::chrono::minutes offset);

    /// Sends a text past the session, for example an invalid message in a test of an MCS; no effect without a connection. The
    /// session ignores an Ack of it, except one that it matches by its command (SessionOptions::bAcksMatchedByCommand).
    void SendText(std::string_view text);

    /// Reads the files of ClientOptions::tls again, for later connections; without TLS it does nothing. After an error, which
    /// is one of Create, the former ones stay in use.
    [[nodiscard]] Core::Result<void> ReloadTLS();

    /// Whether the MCS has accepted the Registration of the current connection.
    [[nodiscard]] bool IsRegistered() const;
    /// Number of requests that TrySendDurable would accept now.
    [[nodiscard]] std::size_t GetRoom() const;
    /// Counters since the client was created, over all connections.
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
};

} // namespace ACS::ProtocolBeast
