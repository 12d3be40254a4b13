#include "drivers/OpenStreamService.hpp"

#include "trace/ArmTrace.hpp"

#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

using OpenStreamAsio::OpenStreamClient;
using OpenStreamAsio::OpenStreamClientOptions;

/// The client owns the trace by these functions.
void AddTrace(
    const std::shared_ptr<ArmTrace>& trace,
    OpenStreamClientOptions& options,
    OpenStreamClient::EventHandler& handler)
{
    options.onReceived = [trace, next = std::move(options.onReceived)](std::string_view bytes) {
        trace->OnReceived(bytes);
        if (next)
        {
            next(bytes);
        }
    };
    options.onSent = [trace, next = std::move(options.onSent)](std::string_view bytes) {
        trace->OnSent(bytes);
        if (next)
        {
            next(bytes);
        }
    };
    handler = [trace, next = std::move(handler)](const OpenStream::ClientEvent& event, Core::Now now) {
        if (std::holds_alternative<OpenStream::ClientLost>(event))
        {
            trace->OnLost();
        }
        next(event, now);
    };
}

} // namespace

OpenStreamService::OpenStreamService(Dependencies dependencies, std::string robotID)
    : _dependencies(std::move(dependencies)),
      _robotID(std::move(robotID))
{
}

std::unique_ptr<OpenStreamClient> OpenStreamService::MakeClient(
    OpenStreamClientOptions options,
    OpenStreamClient::EventHandler handler)
{
    options.maySend = _dependencies.mayCommand;
    if (_dependencies.traceOrNull != nullptr)
    {
        AddTrace(std::make_shared<ArmTrace>(*_dependencies.traceOrNull, _robotID), options, handler);
    }
    return std::make_unique<OpenStreamClient>(
        _dependencies.executor,
        _dependencies.clock,
        _dependencies.random,
        _dependencies.logger.MakeFor("arm." + _robotID),
        std::move(options),
        std::move(handler));
}

} // namespace ACS::Acsd
