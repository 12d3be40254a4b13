#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol/SessionStatistics.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// An McsSession behind a WebSocket server. Everything runs on the given executor, which must be that of one thread (or a
/// strand), and is called from there only.
class McsServer
{
    class Impl;
    std::shared_ptr<Impl> _impl;

    explicit McsServer(std::shared_ptr<Impl> impl);

public:
    /// Listens. Fails with a sentence that names the address, or the file for TLS, and says what to do. Clock, random
    /// source, log sink and handler outlive the server.
    [[nodiscard]] static Core::Result<std::unique_ptr<McsServer>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        const ServerOptions& options,
        ISessionHandler& handler);

    McsServer(const McsServer&) = delete;
    McsServer& operator=(const McsServer&) = delete;
    /// Drops every connection at once; the handler is not called any more.
    ~McsServer();

    /// The port that is listened on.
    [[nodiscard]] std::uint16_t GetPort() const;

    /// No new connections, a closing handshake for those that are there. No event tells its end: destroy the server when
    /// the executor has run dry or enough time has passed.
    void Stop();

    /// These run McsSession's function of the same name and carry out what it returns; events reach the handler after
    /// the call has returned.
    [[nodiscard]] Protocol::AcsRequest MakeRequest(Protocol::AcsPayload payload);
    [[nodiscard]] bool TrySend(const Protocol::AcsRequest& request);
    [[nodiscard]] bool TrySendText(std::string_view text);
    void HoldAcks(const Protocol::AckHold& hold);
    void RefuseRegistrations(std::size_t count, std::string_view message);
    void EndFaults();
    void Drop(std::uint16_t code, std::string_view reason);

    /// Closes the registered connection's socket without a handshake, as a cut cable would.
    void Cut();

    [[nodiscard]] bool IsRegistered() const;
    [[nodiscard]] bool IsTakingPlans() const;
    [[nodiscard]] std::size_t GetPendingCount() const;
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
};

} // namespace ACS::ProtocolBeast
