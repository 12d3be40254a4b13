#pragma once

#include "api/FaultyService.hpp"
#include "common/config/Endpoint.hpp"
#include "common/http/HttpServer.hpp"
#include "common/process/TimerSet.hpp"
#include "controller/ControllerFaults.hpp"
#include "controller/ControllerTrace.hpp"
#include "controller/VirtualController.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace ACS::OpenStreamSim
{

struct HostOptions
{
    /// Follows the component in its log lines ("stream 2"); empty for a single controller.
    std::string label;
    Apps::Endpoint stream{"127.0.0.1", 49'000};        ///< Port 0 selects a free one.
    Apps::Endpoint http{"127.0.0.1", 8888};            ///< Likewise.
    std::size_t sessions = 8;                          ///< Maximum of Open Stream sessions.
    std::chrono::milliseconds handshakeTimeout{5'000}; ///< Of an Open Stream connection; 0: no limit.
    ControllerOptions controller;
    std::uint64_t number = 1;                    ///< In the trace.
    Apps::SimulatorTrace* traceOrNull = nullptr; ///< Outlives the host.
};

/// One simulated controller, its faults and its two ports: Open Stream and the HTTP Open API over the same
/// VirtualController. Runs on the executor's one thread; the clock must outlive it.
class ControllerHost final : private IFaultHost
{
    Core::IClock& _clock;
    HostOptions _options;
    std::unique_ptr<ControllerTrace> _traceOrNull;
    VirtualController _controller;
    Apps::TimerSet<int> _timers; ///< One: for the next event of the faults and the controller.
    ControllerFaults _faults;
    FaultyService _streamService;
    FaultyService _httpService;
    OpenStreamAsio::OpenStreamServer _streamServer;
    Apps::HttpServer _httpServer;

public:
    ControllerHost(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        const Core::Logger& logger,
        HostOptions options);
    ControllerHost(const ControllerHost&) = delete;
    ControllerHost& operator=(const ControllerHost&) = delete;
    ~ControllerHost() override = default;

    /// Opens both ports. The error names the address that is not available.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes both ports and all connections.
    void Stop();

    /// False if the controller has the maximum number of faults.
    [[nodiscard]] bool TryAddFault(const Fault& fault);

    /// Ends the faults of the kind (absent: all), those that have not begun included. Returns the number of them.
    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull);

    /// With the actual ports, after Start.
    [[nodiscard]] const Apps::Endpoint& GetStreamEndpoint() const noexcept;
    [[nodiscard]] const Apps::Endpoint& GetHttpEndpoint() const noexcept;

private:
    [[nodiscard]] Apps::HttpResponse Handle(const Apps::HttpRequest& request);
    void DropSessions() override;
    void WakeAt(std::optional<Core::SteadyTime> timeOrNull) override;
};

} // namespace ACS::OpenStreamSim
