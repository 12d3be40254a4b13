#include "vda-sim/VdaSim.hpp"

#include "common/ReadyLine.hpp"
#include "common/SignalWaiter.hpp"
#include "common/SpdlogSink.hpp"
#include "common/SystemClock.hpp"
#include "common/SystemRandom.hpp"
#include "vda-sim/VehicleRunner.hpp"

#include <boost/asio/io_context.hpp>
#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

/// The vehicles of one process, and how many are connected or gone.
class Fleet
{
    const VdaSimOptions* _options;
    boost::asio::io_context _context;
    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    Apps::SpdlogSink _log;
    std::vector<std::unique_ptr<VehicleRunner>> _runners;
    std::set<std::size_t> _connected;
    bool _bReady = false;

public:
    explicit Fleet(const VdaSimOptions& options)
        : _options(&options),
          _log(options.common.logLevel)
    {
    }

    void Add(const VehicleSpec& spec, const std::string& startNodeID, const Planning::SiteMap& site)
    {
        VirtualVehicleOptions vehicle;
        vehicle.address = {_options->interfaceName, _options->manufacturer, spec.name};
        vehicle.version = _options->version;
        vehicle.type = spec.type;
        vehicle.startNodeID = startNodeID;
        vehicle.timeScale = _options->timeScale;

        VDA5050::MosquittoOptions link;
        link.host = _options->broker.peer.host;
        link.port = _options->broker.peer.port;
        link.clientID = fmt::format("vda-sim-{}-{}", _options->manufacturer, spec.name);
        if (Apps::IsSecure(_options->broker.scheme))
        {
            link.tls = VDA5050::MosquittoTls{};
        }
        const Core::Logger logger(_log, spec.name);
        _runners.push_back(std::make_unique<VehicleRunner>(
            _context.get_executor(),
            _clock,
            _random,
            logger,
            VirtualVehicle(std::move(vehicle), site, logger),
            std::move(link)));
    }

    void Run()
    {
        Apps::SignalWaiter signals(_context.get_executor(), [this](int /*signal*/) { Stop(); });
        for (std::size_t i = 0; i < _runners.size(); ++i)
        {
            _runners[i]->Start([this, i]() { CountConnected(i); });
        }
        _context.run();
    }

private:
    void CountConnected(std::size_t index)
    {
        _connected.insert(index);
        if (!_bReady && _connected.size() == _runners.size())
        {
            _bReady = true;
            Apps::PrintReadyLine({{"broker", _options->broker.peer}});
        }
    }

    void Stop()
    {
        const auto left = std::make_shared<std::size_t>(_runners.size());
        for (const std::unique_ptr<VehicleRunner>& runner : _runners)
        {
            runner->StopAsync([this, left]() {
                --*left;
                if (*left == 0)
                {
                    _context.stop();
                }
            });
        }
    }
};

int Refuse(const std::string& mistake)
{
    Apps::PrintMistake("vda-sim", mistake);
    return Apps::EXIT_BAD_COMMAND_LINE;
}

} // namespace

int RunVdaSim(const VdaSimOptions& options)
{
    const tl::expected<Planning::SiteMap, std::string> site = LoadSite(options.sitePath);
    if (!site.has_value())
    {
        return Refuse(site.error());
    }
    Fleet fleet(options);
    for (std::size_t i = 0; i < options.vehicles.size(); ++i)
    {
        const VehicleSpec& vehicle = options.vehicles[i];
        const tl::expected<std::string, std::string> startNodeID = GetStartNode(vehicle, i, *site);
        if (!startNodeID.has_value())
        {
            return Refuse(startNodeID.error());
        }
        fleet.Add(vehicle, *startNodeID, *site);
    }
    fleet.Run();
    return 0;
}

} // namespace ACS::VdaSim
