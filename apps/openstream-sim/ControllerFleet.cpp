#include "ControllerFleet.hpp"

#include <cassert>
#include <string>

namespace ACS::OpenStreamSim
{

namespace
{

Apps::Endpoint MakeEndpoint(Apps::Endpoint endpoint, std::size_t index)
{
    if (endpoint.port != 0)
    {
        endpoint.port = static_cast<std::uint16_t>(endpoint.port + index);
    }
    return endpoint;
}

} // namespace

ControllerFleet::ControllerFleet(
    const boost::asio::any_io_executor& executor,
    Core::IClock& clock,
    const Core::Logger& logger,
    const FleetOptions& options)
{
    assert(options.controllers > 0 && options.controllers <= FleetOptions::MAX_CONTROLLERS);
    for (std::size_t i = 0; i < options.controllers; ++i)
    {
        HostOptions host = options.first;
        host.stream = MakeEndpoint(host.stream, i);
        host.http = MakeEndpoint(host.http, i);
        host.label = options.controllers > 1 ? std::to_string(i + 1) : std::string();
        _hosts.push_back(std::make_unique<ControllerHost>(executor, clock, logger, std::move(host)));
    }
}

Core::Result<void> ControllerFleet::Start()
{
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        Core::Result<void> started = host->Start();
        if (!started.has_value())
        {
            Stop();
            return started;
        }
    }
    return {};
}

void ControllerFleet::Stop()
{
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        host->Stop();
    }
}

std::vector<Apps::ReadyAddress> ControllerFleet::GetAddresses() const
{
    std::vector<Apps::ReadyAddress> addresses;
    std::string number; // The first one's words are those of a controller that is alone: what reads them goes on to.
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        addresses.push_back({"stream" + number, host->GetStreamEndpoint()});
        addresses.push_back({"http" + number, host->GetHttpEndpoint()});
        number = std::to_string(addresses.size() / 2 + 1);
    }
    return addresses;
}

ControllerHost& ControllerFleet::GetHost(std::size_t number)
{
    assert(number > 0 && number <= _hosts.size());
    return *_hosts[number - 1];
}

} // namespace ACS::OpenStreamSim
