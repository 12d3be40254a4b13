#pragma once

#include "common/Endpoint.hpp"
#include "common/HttpServer.hpp"
#include "VirtualController.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <string>

namespace ACS::OpenStreamSim
{

struct HostOptions
{
    /// Behind what its log lines begin with ("stream 2"); empty for a controller that is alone.
    std::string label;
    Apps::Endpoint stream{"127.0.0.1", 49'000}; ///< Port 0 takes a free one.
    Apps::Endpoint http{"127.0.0.1", 8888};     ///< Likewise.
    ControllerOptions controller;
};

/// One simulated controller and its two ports: Open Stream and the HTTP Open API over the same VirtualController. Runs on
/// the executor's one thread; the clock must outlive it.
class ControllerHost final
{
    Core::IClock& _clock;
    HostOptions _options;
    VirtualController _controller;
    OpenStreamAsio::OpenStreamServer _streamServer;
    Apps::HttpServer _httpServer;

    [[nodiscard]] Apps::HttpResponse Handle(const Apps::HttpRequest& request);

public:
    ControllerHost(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        const Core::Logger& logger,
        HostOptions options);
    ControllerHost(const ControllerHost&) = delete;
    ControllerHost& operator=(const ControllerHost&) = delete;
    ~ControllerHost() = default;

    /// Opens both ports. The error names the address that could not be had.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes both ports and all connections.
    void Stop();

    /// With the ports that were got, after Start.
    [[nodiscard]] const Apps::Endpoint& GetStreamEndpoint() const noexcept;
    [[nodiscard]] const Apps::Endpoint& GetHttpEndpoint() const noexcept;
};

} // namespace ACS::OpenStreamSim
