#include "ControllerHost.hpp"

#include "HttpBridge.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

OpenStreamAsio::OpenStreamServerOptions MakeServerOptions(const Apps::Endpoint& endpoint)
{
    OpenStreamAsio::OpenStreamServerOptions options;
    options.host = endpoint.host;
    options.port = endpoint.port;
    return options;
}

Core::Logger MakeLogger(const Core::Logger& logger, const char* part, const HostOptions& options)
{
    return logger.MakeFor(options.label.empty() ? std::string(part) : fmt::format("{} {}", part, options.label));
}

} // namespace

ControllerHost::ControllerHost(
    const boost::asio::any_io_executor& executor,
    Core::IClock& clock,
    const Core::Logger& logger,
    HostOptions options)
    : _clock(clock),
      _options(std::move(options)),
      _controller(_options.controller, clock.GetNow(), MakeLogger(logger, "controller", _options)),
      _streamServer(
          executor,
          clock,
          MakeLogger(logger, "stream", _options),
          MakeServerOptions(_options.stream),
          _controller),
      _httpServer(
          executor,
          [this](const Apps::HttpRequest& request) { return Handle(request); },
          MakeLogger(logger, "http", _options))
{
}

Apps::HttpResponse ControllerHost::Handle(const Apps::HttpRequest& request)
{
    return AnswerHttp(request, _controller, _clock.GetNow());
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
