#include "operator/HttpAddresses.hpp"

#include "operator/HealthRoutes.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

HttpAddresses::HttpAddresses(
    const boost::asio::any_io_executor& executor,
    const Core::Logger& logger,
    const HttpConfig& config)
    : _logger(logger.MakeFor("operator")),
      _monitoring(executor, {}, logger.MakeFor("http"), {}, MakeHttpGuard(config.monitoring)),
      _operator(executor, {}, _logger, {}, MakeHttpGuard(config.control.http))
{
}

Core::Result<void> HttpAddresses::Listen(const HttpConfig& config)
{
    return ListenOn(_monitoring, "http", config.monitoring)
        .and_then([&] { return UseTLS(config.control.tls); })
        .and_then([&] { return ListenOn(_operator, "operator", config.control.http); });
}

void HttpAddresses::SetHandlers(Handlers handlers)
{
    _monitoring.SetHandler(std::move(handlers.monitoring));
    _operator.SetHandler(std::move(handlers.control));
}

void HttpAddresses::ReloadTLS(const Apps::HttpTlsFiles& files)
{
    if (const Core::Result<void> used = UseTLS(files); !used)
    {
        _logger.Error(
            "TLS files not read again: the former ones stay in use",
            {{"reason", Core::Describe(used.error())}});
    }
}

void HttpAddresses::Stop()
{
    _monitoring.Stop();
    _operator.Stop();
}

const std::vector<Apps::ReadyAddress>& HttpAddresses::GetAddresses() const noexcept
{
    return _addresses;
}

Core::Result<void> HttpAddresses::UseTLS(const Apps::HttpTlsFiles& files)
{
    if (files.certificate.empty())
    {
        return {};
    }
    return Apps::MakeHttpTlsContext(files).map([this](auto context) { _operator.UseTLS(std::move(context)); });
}

Core::Result<void> HttpAddresses::ListenOn(
    Apps::HttpServer& server,
    const std::string& name,
    const HttpListenConfig& config)
{
    return server.Listen(config.listen)
        .map([&](const Apps::Endpoint& endpoint) {
            _addresses.push_back({name, endpoint});
        })
        .map_error([&name](Core::Error error) {
            error.path = fmt::format("{}.listen: {}", name, error.path);
            return error;
        });
}

} // namespace ACS::Acsd
