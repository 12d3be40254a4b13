#include "controller/ControllerFleet.hpp"

#include "common/faults/FaultAnswers.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view CONTROL_PATH = "/faults";
constexpr unsigned GOOD = 200;
constexpr unsigned BAD_REQUEST = 400;
constexpr unsigned NOT_FOUND = 404;
constexpr unsigned BAD_METHOD = 405;

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
    FleetOptions options)
    : _logger(logger.MakeFor("control")),
      _options(std::move(options)),
      _controlServer(
          executor,
          [this](const Apps::HttpRequest& request) { return Handle(request); },
          _logger,
          {},
          Apps::HttpGuard({{}, true}))
{
    assert(_options.controllers > 0 && _options.controllers <= FleetOptions::MAX_CONTROLLERS);
    for (std::size_t i = 0; i < _options.controllers; ++i)
    {
        HostOptions host = _options.first;
        host.stream = MakeEndpoint(host.stream, i);
        host.http = MakeEndpoint(host.http, i);
        host.number = i + 1;
        host.label = _options.controllers > 1 ? std::to_string(i + 1) : std::string();
        if (const auto robot = _options.robots.find(i + 1); robot != _options.robots.end())
        {
            host.controller.robotID = robot->second;
        }
        _hosts.push_back(std::make_unique<ControllerHost>(executor, clock, logger, std::move(host)));
    }
}

Core::Result<void> ControllerFleet::Start()
{
    if (_options.control.has_value())
    {
        Core::Result<Apps::Endpoint> listening = _controlServer.Listen(*_options.control);
        if (!listening.has_value())
        {
            return tl::unexpected(listening.error());
        }
        _options.control = *listening;
    }
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        Core::Result<void> started = host->Start();
        if (!started.has_value())
        {
            Stop();
            return started;
        }
    }
    for (const FaultCommand& command : _options.faults)
    {
        const std::string answer = Apply(command);
        if (!answer.starts_with(Apps::COMMAND_DONE))
        {
            _logger.Warning("fault rejected", {{"fault", command.fault.text}, {"reason", answer}});
        }
    }
    return {};
}

void ControllerFleet::Stop()
{
    _controlServer.Stop();
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        host->Stop();
    }
}

std::vector<Apps::ReadyAddress> ControllerFleet::GetAddresses() const
{
    std::vector<Apps::ReadyAddress> addresses;
    std::string number; // None for the first controller: its names do not depend on the number of controllers.
    for (const std::unique_ptr<ControllerHost>& host : _hosts)
    {
        addresses.push_back({"stream" + number, host->GetStreamEndpoint()});
        addresses.push_back({"http" + number, host->GetHttpEndpoint()});
        number = std::to_string(addresses.size() / 2 + 1);
    }
    if (_options.control.has_value())
    {
        addresses.push_back({"control", *_options.control});
    }
    return addresses;
}

Apps::HttpResponse ControllerFleet::Handle(const Apps::HttpRequest& request)
{
    Trace(true, MakeTraceText(request));
    Apps::HttpResponse response = Answer(request);
    Trace(false, MakeTraceText(response));
    return response;
}

void ControllerFleet::Trace(bool bIn, std::string_view text) const
{
    if (_options.first.traceOrNull != nullptr)
    {
        Apps::TraceLine line;
        line.link = "control";
        line.bIn = bIn;
        line.text = text;
        _options.first.traceOrNull->Write(line);
    }
}

Apps::HttpResponse ControllerFleet::Answer(const Apps::HttpRequest& request)
{
    Apps::HttpResponse response;
    if (request.path != CONTROL_PATH)
    {
        response.status = NOT_FOUND;
        response.body = fmt::format("error: no such path; POST the commands to {}\n", CONTROL_PATH);
    }
    else if (request.method != "POST")
    {
        response.status = BAD_METHOD;
        response.body = fmt::format("error: POST the commands to {}\n", CONTROL_PATH);
    }
    else
    {
        response.body = Command(request.body) + "\n";
        response.status = response.body.find(Apps::COMMAND_WRONG) == std::string::npos ? GOOD : BAD_REQUEST;
    }
    return response;
}

std::string ControllerFleet::Command(std::string_view text)
{
    return Apps::AnswerCommands<Fault>(
        GetFaultGrammar(),
        text,
        _logger,
        [this](const FaultCommand& command) { return CheckTarget(command); },
        [this](const FaultCommand& command) { return Apply(command); });
}

std::string ControllerFleet::CheckTarget(const FaultCommand& command) const
{
    for (std::size_t i = 0; i < _hosts.size(); ++i)
    {
        if (Apps::IsTarget(command.targets, std::to_string(i + 1)))
        {
            return {};
        }
    }
    return fmt::format("no controller {}; give one from 1 to {}, or * for all", command.targets, _hosts.size());
}

std::string ControllerFleet::Apply(const FaultCommand& command)
{
    std::size_t controllers = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < _hosts.size(); ++i)
    {
        if (Apps::IsTarget(command.targets, std::to_string(i + 1)))
        {
            ++controllers;
            count += ApplyTo(*_hosts[i], command);
        }
    }
    if (command.verb != Apps::EFaultVerb::Begin)
    {
        return fmt::format("{}controllers={} ended={}", Apps::COMMAND_DONE, controllers, count);
    }
    if (count < controllers)
    {
        return fmt::format(
            "{}{} of {} controllers already have {} faults",
            Apps::COMMAND_WRONG,
            controllers - count,
            controllers,
            FaultBoard::MAX_FAULTS);
    }
    return fmt::format("{}controllers={} {}", Apps::COMMAND_DONE, controllers, command.fault.text);
}

std::size_t ControllerFleet::ApplyTo(ControllerHost& host, const FaultCommand& command)
{
    if (command.verb == Apps::EFaultVerb::End)
    {
        return host.EndFaults(command.kindToEnd);
    }
    return host.TryAddFault(command.fault) ? 1 : 0;
}

} // namespace ACS::OpenStreamSim
