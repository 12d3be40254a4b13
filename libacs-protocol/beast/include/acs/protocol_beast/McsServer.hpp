#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/IMcsSession.hpp>
#include <acs/protocol/SessionStatistics.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsPort.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// An McsSession behind a WebSocket server. Runs entirely on the given executor, which must be single-threaded (or a
/// strand), and is called from there only.
class ACS_API McsServer
{
public:
    /// Adds actions to be carried out, for example by calling a session of one's own.
    using SessionCall = std::function<void(Core::Now now, Protocol::SessionActions& out)>;

private:
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

    explicit McsServer(std::shared_ptr<Impl> impl);

public:
    McsServer(const McsServer&) = delete;
    McsServer& operator=(const McsServer&) = delete;
    /// Closes all connections at once, without a closing handshake; the handler is not called any more.
    ~McsServer();

    /// Listens, with an McsSession made of options.session. The error names the address, or the file for TLS, and the
    /// remedy. Clock, random source, log sink and handler must outlive the server.
    [[nodiscard]] static Core::Result<std::unique_ptr<McsServer>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        const ServerOptions& options,
        ISessionHandler& handler);

    /// Likewise, with a given session; options.session is ignored.
    [[nodiscard]] static Core::Result<std::unique_ptr<McsServer>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        const Core::Logger& logger,
        const ServerOptions& options,
        std::unique_ptr<Protocol::IMcsSession> session,
        ISessionHandler& handler);

    /// Likewise, at a port that it shares with other servers. Of options only path, checkUpgrade and onWire have an effect.
    [[nodiscard]] static std::unique_ptr<McsServer> Create(
        McsPort& port,
        const Core::IClock& clock,
        const Core::Logger& logger,
        const ServerOptions& options,
        std::unique_ptr<Protocol::IMcsSession> session,
        ISessionHandler& handler);

    /// The port that the server listens on.
    [[nodiscard]] std::uint16_t GetPort() const;

    /// Accepts no new connections (a shared port answers them with 404) and starts the closing handshake of the open ones.
    /// Its end is not reported: destroy the server when the executor has run out of work, or after a time limit.
    void Stop();

    /// Starts the closing handshake of one connection with code 1008 (policy violation), for example of an ACS whose token was
    /// withdrawn; an ACS connects again, see ServerOptions::checkUpgrade. Has no effect on a connection that is closed already.
    /// At most 123 bytes of the reason reach the client.
    void Close(Protocol::ConnectionID connection, std::string_view reason);

    /// IMcsSession::TryAnswer: the Ack of a RequestReceived with a token. This and the following calls run the session's
    /// function of the same name and carry out its actions; events reach the handler after the call has returned.
    [[nodiscard]] bool TryAnswer(Protocol::AnswerToken token, Protocol::EAckResult result, std::string_view message);
    /// IMcsSession::MakeRequest: a request with a new transactionID and the current time. Not sent.
    [[nodiscard]] Protocol::AcsRequest MakeRequest(Protocol::AcsPayload payload);
    /// IMcsSession::TrySend: sends a request. False: no ACS is registered, too many requests are pending, or plans are
    /// withheld.
    [[nodiscard]] bool TrySend(const Protocol::AcsRequest& request);
    /// Carries out the actions that the call adds.
    void Run(const SessionCall& call);

    /// Whether an ACS is registered.
    [[nodiscard]] bool IsRegistered() const;
    /// The connection of the registered ACS; nullopt: none.
    [[nodiscard]] std::optional<Protocol::ConnectionID> GetRegisteredOrNull() const;
    /// Whether an ACS is registered and has not reported isConnected=false (section 6.21).
    [[nodiscard]] bool IsTakingPlans() const;
    /// Number of requests without an Ack.
    [[nodiscard]] std::size_t GetPendingCount() const;
    /// Number of requests of the ACS that wait for TryAnswer.
    [[nodiscard]] std::size_t GetUnansweredCount() const;
    /// Counters since the session was created, over all connections.
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
};

} // namespace ACS::ProtocolBeast
