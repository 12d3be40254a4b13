#pragma once

#include "HandlerMemory.hpp"
#include "ServiceCaller.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/openstream/IOpenApiService.hpp>
#include <acs/openstream/ServerSession.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::OpenStreamAsio
{

/// An accepted connection: carries out the actions of its ServerSession and reports events to it. Exists while a handler or
/// the server holds it; after Abort its handlers do nothing.
class ServerConnection final : public std::enable_shared_from_this<ServerConnection>
{
public:
    /// What it needs from its server.
    struct Handlers
    {
        std::function<void(ServerConnection& connection)> onClosed;
        /// Whether a connection other than this one controls the robot.
        std::function<bool(const ServerConnection& connection)> isOtherInControl;
    };

private:
    using Timers = Net::TimerArray<OpenStream::EServerTimer, OpenStream::SERVER_TIMER_COUNT>;

    static constexpr std::size_t READ_BYTES = 64U * 1024U;

    HandlerMemory _writeMemory;
    boost::asio::ip::tcp::socket _socket;
    Core::IClock& _clock;
    Core::Logger _logger;
    std::uint64_t _number;
    std::function<void(std::uint64_t connection, std::string_view bytes)>
        _onReceived; ///< May be empty, as the next two.
    std::function<void(std::uint64_t connection, std::string_view bytes)> _onSent;
    std::function<void(std::uint64_t connection)> _onEnded;
    ServiceCaller _service;
    Handlers _handlers;
    std::string _peer;
    OpenStream::ServerSession _session;
    OpenStream::ServerActions _actions;
    std::shared_ptr<Timers> _timers;
    std::array<char, READ_BYTES> _input{};
    bool _bReading = false;
    bool _bPaused = false;
    bool _bPeerClosed = false;
    bool _bClosed = false;

public:
    ServerConnection(
        boost::asio::ip::tcp::socket socket,
        Core::IClock& clock,
        Core::Logger logger,
        const OpenStreamServerOptions& options,
        std::uint64_t number,
        OpenStream::IOpenApiService& service,
        Handlers handlers);

    void Start();
    /// Instead of Start, or later to give its place to another client.
    void Reject(std::string_view message);
    /// Closes at once. The closed handler is not called.
    void Abort();

    [[nodiscard]] OpenStream::EServerState GetState() const noexcept;
    /// ServerSession::HasControl.
    [[nodiscard]] bool HasControl() const noexcept;
    [[nodiscard]] const OpenStream::ServerSessionStats& GetStats() const noexcept;

private:
    void Execute();
    void Do(const OpenStream::ServerSend& action);
    void Do(const OpenStream::ServerCall& action);
    void Do(const OpenStream::ServerStopControl& action);
    void Do(const OpenStream::ServerStartTimer& action);
    void Do(const OpenStream::ServerCancelTimer& action);
    void Do(const OpenStream::ServerPauseReading& action);
    void Do(const OpenStream::ServerResumeReading& action);
    void Do(const OpenStream::ServerContinue& action);
    void Do(const OpenStream::ServerShutdownSend& action);
    void Do(const OpenStream::ServerClose& action);
    void ReadMoreAsync();
    void OnRead(const boost::system::error_code& error, std::size_t size);
    void OnWritten(const boost::system::error_code& error, std::size_t size);
    void OnTimer(OpenStream::EServerTimer timer);
    void OnAnswerDue(const ServiceCaller::Answer& answer);
    void OnContinue();
};

} // namespace ACS::OpenStreamAsio
