#include "vda-sim/VdaSim.hpp"

#include "common/faults/FaultAnswers.hpp"
#include "common/log/SpdlogSink.hpp"
#include "common/process/FileLimit.hpp"
#include "common/process/ReadyLine.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "common/process/TimerSet.hpp"
#include "common/trace/SimulatorTrace.hpp"
#include "vda-sim/ControlChannel.hpp"
#include "vda-sim/VehicleRandom.hpp"
#include "vda-sim/VehicleRunner.hpp"
#include "vda-sim/WorldWatch.hpp"
#include "world/WorldFile.hpp"

#include <boost/asio/io_context.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

/// The vehicles of one process, their connections and the commands to them.
class Fleet
{
    struct Member
    {
        std::string name;
        std::unique_ptr<VehicleRandom> random;
        std::unique_ptr<VehicleRunner> runner;
    };

    const VdaSimOptions* _options;
    const Planning::SiteMap* _site;
    Sim::IWorld* _worldOrNull;
    boost::asio::io_context _context;
    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    Apps::SpdlogSink _log;
    Core::Logger _logger;
    std::unique_ptr<Apps::SimulatorTrace> _traceOrNull;
    std::uint64_t _seed;
    std::vector<Member> _members;
    std::optional<ControlChannel> _control;
    std::optional<WorldWatch> _worldWatch;
    Apps::TimerSet<int> _worldTimer;
    std::set<std::size_t> _connected; ///< The control channel's number is that after the last vehicle.
    bool _bReady = false;

public:
    /// All outlive it.
    Fleet(const VdaSimOptions& options, const Planning::SiteMap& site, Sim::IWorld* worldOrNull)
        : _options(&options),
          _site(&site),
          _worldOrNull(worldOrNull),
          _log(options.common.logLevel),
          _logger(_log, "vda-sim"),
          _seed(options.seed.has_value() ? *options.seed : _random.GetNext()),
          _worldWatch(
              worldOrNull == nullptr ? std::nullopt : std::optional<WorldWatch>(std::in_place, *worldOrNull, _logger)),
          _worldTimer(_context.get_executor(), [this](int /*key*/) { PollWorld(); })
    {
    }

    /// Opens the trace and adds the vehicles. The error is one sentence.
    [[nodiscard]] tl::expected<void, std::string> Prepare()
    {
        if (!_options->trace.folder.empty())
        {
            auto created = Apps::SimulatorTrace::Create("vda-sim", _options->trace, _clock, _logger);
            if (!created.has_value())
            {
                return tl::make_unexpected(std::move(created.error()));
            }
            _traceOrNull = std::move(*created);
        }
        for (std::size_t i = 0; i < _options->vehicles.size(); ++i)
        {
            const tl::expected<std::string, std::string> startNodeID = GetStartNode(_options->vehicles[i], i, *_site);
            if (!startNodeID.has_value())
            {
                return tl::make_unexpected(startNodeID.error());
            }
            Add(_options->vehicles[i], *startNodeID);
        }
        if (!_options->controlTopic.empty())
        {
            VDA5050::MosquittoOptions link = MakeLinkOptions(fmt::format("vda-sim-control-{:016x}", _random.GetNext()));
            _control.emplace(
                _context.get_executor(),
                _random,
                _logger,
                std::move(link),
                _options->controlTopic,
                [this](std::string_view text) { return Command(text); },
                MqttTrace(_traceOrNull.get(), {}));
        }
        return {};
    }

    void Run(const std::vector<std::string>& siteWarnings)
    {
        for (const std::string& warning : siteWarnings)
        {
            _logger.Warning(warning, {{"site", _options->sitePath}});
        }
        _logger.Info("vehicles start", {{"count", std::to_string(_members.size())}, {"seed", std::to_string(_seed)}});
        Apps::SignalWaiter signals(_context.get_executor(), [this](int /*signal*/) { Stop(); });
        for (const FaultCommand& command : _options->faults)
        {
            const std::string result = Apply(command);
            if (!result.starts_with("ok: "))
            {
                _logger.Warning("this fault might have no effect", {{"fault", command.fault.text}, {"result", result}});
            }
        }
        for (std::size_t i = 0; i < _members.size(); ++i)
        {
            VehicleRunner& runner = *_members[i].runner;
            runner.Start([this, i, &runner]() { CountConnected(i, runner.GetBrokerIndex()); });
        }
        if (_control.has_value())
        {
            _control->Start([this]() { CountConnected(_members.size(), _control->GetBrokerIndex()); });
        }
        if (_worldWatch.has_value())
        {
            PollWorld();
        }
        _context.run();
    }

private:
    void Add(const VehicleSpec& spec, const std::string& startNodeID)
    {
        VirtualVehicleOptions vehicle;
        vehicle.address = {_options->interfaceName, _options->manufacturer, spec.name};
        vehicle.version = spec.version.value_or(_options->version);
        vehicle.qos = _options->link.qos;
        vehicle.type = spec.type;
        vehicle.startNodeID = startNodeID;
        vehicle.startPosition = spec.startPosition;
        vehicle.timeScale = _options->timeScale;
        vehicle.charge = spec.charge;
        vehicle.profile = spec.profile.value_or(_options->profile);
        vehicle.actionSeconds = _options->actionSeconds;
        vehicle.handling = spec.handling;
        vehicle.parameterCheck =
            _options->bLenientParameters ? VDA5050::EParameterCheck::Lenient : VDA5050::EParameterCheck::Strict;
        vehicle.worldOrNull = _worldOrNull;

        const Core::Logger logger(_log, spec.name);
        Member& member = _members.emplace_back();
        member.name = spec.name;
        member.random = std::make_unique<VehicleRandom>(_seed, spec.name);
        member.runner = std::make_unique<VehicleRunner>(
            _context.get_executor(),
            _clock,
            _random,
            logger,
            VirtualVehicle(std::move(vehicle), *_site, *member.random, logger),
            MakeLinkOptions(fmt::format("vda-sim-{}-{}", _options->manufacturer, spec.name)),
            MqttTrace(_traceOrNull.get(), spec.name));
    }

    /// Updates the states after changes of the world by any program.
    void PollWorld()
    {
        constexpr std::chrono::milliseconds INTERVAL{500};
        if (_worldWatch->HasChanged())
        {
            for (const Member& member : _members)
            {
                member.runner->OnWorldChanged();
            }
        }
        _worldTimer.Start(0, INTERVAL);
    }

    [[nodiscard]] VDA5050::MosquittoOptions MakeLinkOptions(std::string clientID) const
    {
        VDA5050::MosquittoOptions link;
        const std::vector<Apps::Url>& brokers = _options->brokers;
        link.host = brokers.front().peer.host;
        link.port = brokers.front().peer.port;
        std::transform(
            brokers.begin() + 1,
            brokers.end(),
            std::back_inserter(link.furtherBrokers),
            [](const Apps::Url& url) {
                return VDA5050::MosquittoBroker{url.peer.host, url.peer.port};
            });
        link.maxQos = _options->link.maxQos;
        link.clientID = std::move(clientID);
        link.version = _options->link.version;
        link.username = _options->link.username;
        link.password = _options->link.password;
        if (Apps::IsSecure(brokers.front().scheme))
        {
            link.tls = _options->link.tls;
        }
        return link;
    }

    /// The ready line names the broker of the connection that was the last to be made.
    void CountConnected(std::size_t index, std::size_t brokerIndex)
    {
        _connected.insert(index);
        if (!_bReady && _connected.size() == _members.size() + (_control.has_value() ? 1 : 0))
        {
            _bReady = true;
            Apps::PrintReadyLine({{"broker", _options->brokers.at(brokerIndex).peer}});
        }
    }

    /// Returns the answer to a message on the control topic.
    [[nodiscard]] std::string Command(std::string_view text)
    {
        return Apps::AnswerCommands<Fault>(
            GetFaultGrammar(),
            text,
            _logger,
            [this](const FaultCommand& command) { return CheckTarget(command); },
            [this](const FaultCommand& command) { return Apply(command); });
    }

    /// Empty, or why the command fits no vehicle.
    [[nodiscard]] std::string CheckTarget(const FaultCommand& command) const
    {
        const bool bFits = std::ranges::any_of(_members, [&command](const Member& member) {
            return Apps::IsTarget(command.targets, member.name);
        });
        return bFits ? std::string()
                     : fmt::format("no vehicle {}; one of the vehicles is {}", command.targets, _members.front().name);
    }

    /// Returns one line with the result.
    [[nodiscard]] std::string Apply(const FaultCommand& command)
    {
        std::size_t vehicles = 0;
        std::size_t count = 0;
        for (const Member& member : _members)
        {
            if (Apps::IsTarget(command.targets, member.name))
            {
                ++vehicles;
                count += ApplyTo(*member.runner, command);
            }
        }
        if (command.verb != EFaultVerb::Begin)
        {
            const std::string_view done = command.verb == EFaultVerb::Trigger ? "triggered" : "ended";
            return fmt::format("ok: vehicles={} {}={}", vehicles, done, count);
        }
        if (count < vehicles)
        {
            return fmt::format(
                "error: {} of {} vehicles already have {} faults",
                vehicles - count,
                vehicles,
                FaultBoard::MAX_FAULTS);
        }
        const std::string& nodeID = command.fault.place;
        if (!nodeID.empty() && _site->FindNodeOrNull(nodeID) == nullptr)
        {
            return fmt::format(
                "warning: vehicles={} {}; the site has no node {}: the fault begins only if an order contains that node",
                vehicles,
                command.fault.text,
                nodeID);
        }
        return fmt::format("ok: vehicles={} {}", vehicles, command.fault.text);
    }

    /// Returns the number of faults begun or ended, or of actions triggered.
    [[nodiscard]] static std::size_t ApplyTo(VehicleRunner& runner, const FaultCommand& command)
    {
        switch (command.verb)
        {
            case EFaultVerb::End:
                return runner.EndFaults(command.kindToEnd);
            case EFaultVerb::Trigger:
                return runner.Trigger();
            case EFaultVerb::Begin:
            default:
                return runner.TryInject(command.fault) ? 1 : 0;
        }
    }

    void Stop()
    {
        _worldTimer.CancelAll();
        const auto left = std::make_shared<std::size_t>(_members.size() + (_control.has_value() ? 1 : 0));
        const auto countOut = [this, left]() {
            --*left;
            if (*left == 0)
            {
                _context.stop();
            }
        };
        for (const Member& member : _members)
        {
            member.runner->StopAsync(countOut);
        }
        if (_control.has_value())
        {
            _control->StopAsync(countOut);
        }
    }
};

int Refuse(const std::string& error)
{
    Apps::PrintError("vda-sim", error);
    return Apps::EXIT_BAD_COMMAND_LINE;
}

} // namespace

int RunVdaSim(const VdaSimOptions& options)
{
    std::vector<std::string> siteWarnings;
    const tl::expected<Planning::SiteMap, std::string> site = LoadSite(options.sitePath, siteWarnings);
    if (!site.has_value())
    {
        return Refuse(site.error());
    }
    const tl::expected<std::unique_ptr<Sim::IWorld>, std::string> world = Sim::OpenWorldOption(options.worldPath);
    if (!world.has_value())
    {
        return Refuse(world.error());
    }
    Apps::RaiseFileLimit(); // Each vehicle has two descriptors.
    Fleet fleet(options, *site, world->get());
    if (const tl::expected<void, std::string> prepared = fleet.Prepare(); !prepared.has_value())
    {
        return Refuse(prepared.error());
    }
    fleet.Run(siteWarnings);
    return 0;
}

} // namespace ACS::VdaSim
