#include "controller/ControllerHost.hpp"

#include "api/HttpBridge.hpp"

#include <fmt/format.h>

#include <functional>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

OpenStreamAsio::OpenStreamServerOptions MakeServerOptions(const HostOptions& host, ControllerTrace* traceOrNull)
{
    OpenStreamAsio::OpenStreamServerOptions options;
    options.host = host.stream.host;
    options.port = host.stream.port;
    options.maximumSessions = host.sessions;
    options.session.handshakeTimeout = host.handshakeTimeout;
    if (traceOrNull != nullptr)
    {
        options.onReceived = std::bind_front(&ControllerTrace::OnReceived, traceOrNull);
        options.onSent = std::bind_front(&ControllerTrace::OnSent, traceOrNull);
        options.onClosed = std::bind_front(&ControllerTrace::OnClosed, traceOrNull);
    }
    return options;
}

Core::Logger MakeLogger(const Core::Logger& logger, const char* part, const HostOptions& options)
{
    return logger.MakeFor(options.label.empty() ? std::string(part) : fmt::format("{} {}", part, options.label));
}

std::unique_ptr<ControllerTrace> MakeTraceOrNull(const HostOptions& host)
{
    return host.traceOrNull == nullptr
        ? nullptr
        : std::make_unique<ControllerTrace>(*host.traceOrNull, host.number, host.controller.robotID);
}

} // namespace

ControllerHost::ControllerHost(
    const boost::asio::any_io_executor& executor,
    Core::IClock& clock,
    const Core::Logger& logger,
    HostOptions options)
    : _clock(clock),
      _options(std::move(options)),
      _traceOrNull(MakeTraceOrNull(_options)),
      _controller(_options.controller, clock.GetNow(), MakeLogger(logger, "controller", _options)),
      _timers(executor, [this](int /*key*/) { _faults.OnTimer(_clock.GetNow()); }),
      _faults(_controller, *this, MakeLogger(logger, "controller", _options), clock.GetNow()),
      _streamService(_controller, _faults, EFaultSide::Stream),
      _httpService(_controller, _faults, EFaultSide::Http),
      _streamServer(
          executor,
          clock,
          MakeLogger(logger, "stream", _options),
          MakeServerOptions(_options, _traceOrNull.get()),
          _streamService),
      _httpServer(
          executor,
          [this](const Apps::HttpRequest& request) { return Handle(request); },
          MakeLogger(logger, "http", _options))
{
}

Apps::HttpResponse ControllerHost::Handle(const Apps::HttpRequest& request)
{
    if (_traceOrNull != nullptr)
    {
        _traceOrNull->OnRequest(request);
    }
    Apps::HttpResponse response = AnswerHTTP(request, _httpService, _clock.GetNow());
    if (_traceOrNull != nullptr)
    {
        _traceOrNull->OnAnswer(response);
    }
    return response;
}

void ControllerHost::DropSessions()
{
    _streamServer.DropSessions();
}

void ControllerHost::WakeAt(std::optional<Core::SteadyTime> timeOrNull)
{
    _timers.CancelAll();
    if (timeOrNull.has_value())
    {
        _timers.Start(0, *timeOrNull - _clock.GetNow().steady);
    }
}

bool ControllerHost::TryAddFault(const Fault& fault)
{
    return _faults.TryAdd(fault, _clock.GetNow());
}

std::size_t ControllerHost::EndFaults(std::optional<EFaultKind> kindOrNull)
{
    return _faults.End(kindOrNull, _clock.GetNow());
}

Core::Result<void> ControllerHost::Start()
{
    Core::Result<void> streaming = _streamServer.Start();
    if (!streaming.has_value())
    {
        return streaming;
    }
    const Core::Result<Apps::Endpoint> listening = _httpServer.Listen(_options.http);
    if (!listening.has_value())
    {
        _streamServer.Stop();
        return tl::unexpected(listening.error());
    }
    _options.stream.port = _streamServer.GetPort();
    _options.http = *listening;
    return {};
}

void ControllerHost::Stop()
{
    _timers.CancelAll();
    _streamServer.Stop();
    _httpServer.Stop();
}

const Apps::Endpoint& ControllerHost::GetStreamEndpoint() const noexcept
{
    return _options.stream;
}

const Apps::Endpoint& ControllerHost::GetHttpEndpoint() const noexcept
{
    return _options.http;
}

} // namespace ACS::OpenStreamSim
