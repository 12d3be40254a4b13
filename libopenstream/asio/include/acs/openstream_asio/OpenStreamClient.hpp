#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSession.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStreamAsio
{

/// Where an OpenStreamClient connects, and the options of its session.
struct OpenStreamClientOptions
{
    std::string host = "127.0.0.1";           ///< A name or an address.
    std::uint16_t port = 49'000;              ///< That of Open Stream on a Hi6 controller.
    OpenStream::ClientSessionOptions session; ///< Times and limits of the ClientSession.
    /// Called with all bytes that are received or passed to the socket. May be empty. The view is valid during the call,
    /// which is made on the executor and must not call the client.
    std::function<void(std::string_view bytes)> onReceived;
    /// See onReceived.
    std::function<void(std::string_view bytes)> onSent;
    /// Asked on the executor before each message: false closes the connection instead of sending it. For a program that may command
    /// for a time only. May be empty: it may always send.
    std::function<bool()> maySend{};
};

/// Runs a ClientSession over TCP (no delay, keep-alive) on a single-threaded executor. After destruction no handler is
/// called. Clock and random source must outlive the client.
class ACS_API OpenStreamClient
{
public:
    /// May call the client, but must not destroy it.
    using EventHandler = std::function<void(const OpenStream::ClientEvent& event, Core::Now now)>;

private:
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// Opens no connection before Start. The handler is called on the executor.
    OpenStreamClient(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::IRandom& random,
        Core::Logger logger,
        OpenStreamClientOptions options,
        EventHandler handler);
    OpenStreamClient(const OpenStreamClient&) = delete;
    OpenStreamClient& operator=(const OpenStreamClient&) = delete;
    ~OpenStreamClient();

    /// ClientSession::Start: connects, and reconnects until Stop. This and the following calls run ClientSession's function of
    /// the same name and carry out its actions; the handler is called during the call or later.
    void Start();
    /// ClientSession::Stop: sends STOP session, then closes. ClientEnded is the last event.
    void Stop();
    /// ClientSession::SetMonitor: the MONITOR, also for later connections; nullopt: none.
    void SetMonitor(std::optional<OpenStream::MonitorRequest> monitorOrNull);
    /// ClientSession::SendControl: sends a CONTROL. ClientControlSettled has the returned token.
    std::uint64_t SendControl(
        const OpenStream::ControlRequest& request,
        OpenStream::EControlTracking tracking = OpenStream::EControlTracking{});
    /// ClientSession::SendControlCall: likewise, with a time limit and a confirmation of its own.
    std::uint64_t SendControlCall(OpenStream::ControlCall call);
    /// ClientSession::StopControl: STOP control, the hard stop.
    void StopControl();

    /// How far the connection is.
    [[nodiscard]] OpenStream::EClientState GetState() const noexcept;
    /// Counters since the client was created.
    [[nodiscard]] const OpenStream::ClientSessionStats& GetStats() const noexcept;
    /// The newest sample of the current MONITOR; null before the first one and without a connection. Valid until the executor
    /// runs again.
    [[nodiscard]] const OpenStream::ClientData* GetLatestOrNull() const noexcept;
    /// Quality of the current MONITOR since it was established.
    [[nodiscard]] OpenStream::StreamQuality GetQuality() const;
};

} // namespace ACS::OpenStreamAsio
