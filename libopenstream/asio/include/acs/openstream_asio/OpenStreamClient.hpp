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

struct OpenStreamClientOptions
{
    std::string host = "127.0.0.1"; ///< A name or an address.
    std::uint16_t port = 49'000;
    OpenStream::ClientSessionOptions session;
    /// Called with all bytes that are received or passed to the socket. May be empty. The view is valid during the call,
    /// which is made on the executor and must not call the client.
    std::function<void(std::string_view bytes)> onReceived;
    std::function<void(std::string_view bytes)> onSent;
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

    /// See ClientSession. The handler is called during the call or later.
    void Start();
    void Stop();
    void SetMonitor(std::optional<OpenStream::MonitorRequest> monitorOrNull);
    std::uint64_t SendControl(
        const OpenStream::ControlRequest& request,
        OpenStream::EControlTracking tracking = OpenStream::EControlTracking{});
    std::uint64_t SendControlCall(OpenStream::ControlCall call);
    void StopControl();

    [[nodiscard]] OpenStream::EClientState GetState() const noexcept;
    [[nodiscard]] const OpenStream::ClientSessionStats& GetStats() const noexcept;
    [[nodiscard]] const OpenStream::ClientData* GetLatestOrNull() const noexcept;
    [[nodiscard]] OpenStream::StreamQuality GetQuality() const;
};

} // namespace ACS::OpenStreamAsio
