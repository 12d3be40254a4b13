#pragma once

#include "common/config/Endpoint.hpp"
#include "common/http/HttpServer.hpp"
#include "common/process/ReadyLine.hpp"
#include "controller/ControllerHost.hpp"
#include "controller/Fault.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStreamSim
{

struct FleetOptions
{
    static constexpr std::size_t MAX_CONTROLLERS = 500;

    HostOptions first;                         ///< The others use the next ports, or free ones if its port is 0.
    std::map<std::size_t, std::string> robots; ///< By the number of their controller, from 1.
    std::size_t controllers = 1;               ///< 1 to MAX_CONTROLLERS; the ports must not go beyond 65535.
    std::vector<FaultCommand> faults;          ///< Their times count from Start.
    std::optional<Apps::Endpoint> control;     ///< Address of the HTTP commands; port 0 selects a free one.
};

/// The controllers of one process, numbered from 1, and the commands to them. Runs on the executor's one thread; the clock
/// must outlive it.
class ControllerFleet final
{
    Core::Logger _logger;
    FleetOptions _options;
    std::vector<std::unique_ptr<ControllerHost>> _hosts;
    Apps::HttpServer _controlServer;

public:
    ControllerFleet(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        const Core::Logger& logger,
        FleetOptions options);
    ControllerFleet(const ControllerFleet&) = delete;
    ControllerFleet& operator=(const ControllerFleet&) = delete;
    ~ControllerFleet() = default;

    /// Opens all ports, or none, and adds the faults. The error names the address that is not available.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes all ports and connections.
    void Stop();

    /// stream and http of the first controller, stream2 and http2 of the second and so on, then control, with the actual
    /// ports.
    [[nodiscard]] std::vector<Apps::ReadyAddress> GetAddresses() const;

    /// Executes the commands of a message, all or none; the answer has a line for each. An error is one line that begins with
    /// "error: ".
    [[nodiscard]] std::string Command(std::string_view text);

private:
    [[nodiscard]] Apps::HttpResponse Handle(const Apps::HttpRequest& request);
    [[nodiscard]] Apps::HttpResponse Answer(const Apps::HttpRequest& request);
    void Trace(bool bIn, std::string_view text) const;
    /// Empty, or why the command fits no controller.
    [[nodiscard]] std::string CheckTarget(const FaultCommand& command) const;
    [[nodiscard]] std::string Apply(const FaultCommand& command);
    /// Returns the number of faults begun or ended.
    [[nodiscard]] static std::size_t ApplyTo(ControllerHost& host, const FaultCommand& command);
};

} // namespace ACS::OpenStreamSim
