#pragma once

#include "common/ReadyLine.hpp"
#include "ControllerHost.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace ACS::OpenStreamSim
{

struct FleetOptions
{
    static constexpr std::size_t MAX_CONTROLLERS = 500;

    HostOptions first;           ///< The next ones have the next ports; where its port is 0, each takes a free one.
    std::size_t controllers = 1; ///< 1 to MAX_CONTROLLERS; the ports must not go beyond 65535.
};

/// The controllers of one process, called 1, 2 and so on. Runs on the executor's one thread; the clock must outlive it.
class ControllerFleet final
{
    std::vector<std::unique_ptr<ControllerHost>> _hosts;

public:
    ControllerFleet(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        const Core::Logger& logger,
        const FleetOptions& options);
    ControllerFleet(const ControllerFleet&) = delete;
    ControllerFleet& operator=(const ControllerFleet&) = delete;
    ~ControllerFleet() = default;

    /// Opens all ports, or none. The error names the address that could not be had.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes all ports and connections.
    void Stop();

    /// stream and http of the first one, stream2 and http2 of the second and so on, with the ports that were got.
    [[nodiscard]] std::vector<Apps::ReadyAddress> GetAddresses() const;

    /// The first one has number 1.
    [[nodiscard]] ControllerHost& GetHost(std::size_t number);
};

} // namespace ACS::OpenStreamSim
