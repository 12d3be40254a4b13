#include "mcs/McsLink.hpp"

#include "mcs/McsGateway.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/core/ShownURL.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

ProtocolBeast::ClientOptions MakeOptions(const AcsdConfig& config)
{
    ProtocolBeast::ClientOptions options;
    options.url = Apps::MakeText(config.mcs.url);
    options.host = config.mcs.host;
    options.tls = config.mcs.tls;
    options.headers = config.mcs.headers;
    options.link.pingInterval = config.mcs.pingInterval;
    options.link.maximumRead = config.mcs.session.codec.maximumBytes;
    options.session = config.mcs.session;
    return options;
}

/// Maximum length of a message in the log.
constexpr std::size_t LOGGED_TEXT = 120;

} // namespace

McsLink::McsLink(const Core::IClock& clock, Core::Logger logger, EventHandler handler)
    : _clock(clock),
      _logger(std::move(logger)),
      _log(_logger),
      _notes(_logger),
      _handler(std::move(handler))
{
}

McsLink::~McsLink() = default;

Core::Result<void> McsLink::Open(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    const AcsdConfig& config,
    MessageTrace* traceOrNull)
{
    _traceOrNull = traceOrNull;
    SetLimits(config.mcs);
    ProtocolBeast::ClientOptions options = MakeOptions(config);
    options.onWire = [this](ProtocolBeast::EWireDirection direction, std::string_view text) {
        WatchWire(direction, text);
    };
    auto client = ProtocolBeast::AcsClient::Create(executor, _clock, random, _logger, options, *this);
    if (!client)
    {
        return tl::unexpected<Core::Error>(client.error());
    }
    _client = std::move(*client);
    _url = Core::MakeShownURL(Apps::MakeText(config.mcs.url));
    return {};
}

void McsLink::Start()
{
    _client->Start();
}

void McsLink::SetLimits(const McsConfig& config)
{
    _warnBytes = config.warnBytes;
}

void McsLink::ReloadTLS()
{
    if (const Core::Result<void> reloaded = _client->ReloadTLS(); !reloaded)
    {
        _logger.Error(
            "TLS files not read again: the former ones stay in use",
            {{"reason", Core::Describe(reloaded.error())}});
    }
}

/// A message longer than the MCS's buffer is lost without an Ack (profile nexus). Each new length is logged once.
void McsLink::WatchWire(ProtocolBeast::EWireDirection direction, std::string_view text)
{
    if (_traceOrNull != nullptr)
    {
        _traceOrNull->Write({"mcs", direction, {}, {}, text});
    }
    if (direction == ProtocolBeast::EWireDirection::In)
    {
        _notes.Flush(_clock.GetNow().steady);
    }
    if (direction == ProtocolBeast::EWireDirection::In || text.size() <= _metrics.longestSent)
    {
        return;
    }
    _metrics.longestSent = text.size();
    if (_warnBytes > 0 && text.size() > _warnBytes)
    {
        _logger.Warning(
            "a message to the MCS is longer than mcs.tx_warn_bytes: an MCS with a small buffer loses it",
            {{"bytes", fmt::format_int(text.size()).str()}, {"begins", text.substr(0, LOGGED_TEXT)}});
    }
}

void McsLink::StopAsync(StopHandler handler)
{
    _stopHandler = std::move(handler);
    _client->SendStatus(Protocol::AcsCommStateUpdate{false});
    _client->Stop();
}

bool McsLink::IsRegistered() const
{
    return _client->IsRegistered();
}

bool McsLink::TrySendDurable(const Protocol::AcsRequest& request)
{
    return _client->TrySendDurable(request);
}

void McsLink::ReplayDone()
{
    _client->ReplayDone();
}

void McsLink::SendStatus(const Protocol::AcsPayload& status)
{
    _client->SendStatus(status);
}

void McsLink::SendPosition(const Protocol::RobotPositionUpdate& positions)
{
    _client->SendPosition(positions);
}

void McsLink::Answer(
    Protocol::EAcsCommand command,
    std::string_view transactionID,
    Protocol::EAckResult result,
    std::string_view message,
    const Protocol::AckPayload& payload)
{
    _client->Answer(command, transactionID, result, message, payload);
}

void McsLink::SetSiteOffset(std::chrono::minutes offset)
{
    _client->SetSiteOffset(offset);
}

McsLink::Metrics McsLink::GetMetrics() const
{
    Metrics metrics = _metrics;
    metrics.bConnected = GetStatistics().connects > _connectsBefore;
    return metrics;
}

LinkStatus McsLink::GetLink() const
{
    const bool bUp = IsRegistered();
    return {"mcs", bUp, bUp ? std::string() : _watch.GetObstacle(GetMetrics().bConnected)};
}

const Protocol::SessionStatistics& McsLink::GetStatistics() const
{
    return _client->GetStatistics();
}

void McsLink::OnSessionEvent(const Protocol::SessionEvent& event)
{
    LogEvent(event);
    _watch.OnSessionEvent(event);
    if (std::holds_alternative<Protocol::LinkLost>(event))
    {
        _connectsBefore = GetStatistics().connects;
    }
    _handler(event);
    if (std::holds_alternative<Protocol::Stopped>(event) && _stopHandler)
    {
        std::exchange(_stopHandler, nullptr)();
    }
}

void McsLink::LogEvent(const Protocol::SessionEvent& event)
{
    if (!std::holds_alternative<Protocol::RequestRefused>(event))
    {
        _notes.Flush(_clock.GetNow().steady);
    }
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) {
                _logger.Info("registered with the MCS");
                _loggedOutage.clear();
            },
            [&](const Protocol::RegistrationRefused& refused) {
                Warn(
                    "registration",
                    "the MCS refuses the registration, retrying",
                    {{"reason", Core::ShortenText(refused.message)}});
            },
            [&](const Protocol::RequestUnanswered& unanswered) {
                ++_metrics.unanswered;
                Warn(
                    "unanswered",
                    "the MCS does not acknowledge",
                    {{"command", GetText(unanswered.command)},
                     {"transactionId", unanswered.transactionID},
                     {"count", fmt::format_int(_metrics.unanswered).str()}});
            },
            [&](const Protocol::LinkLost& lost) { LogOutage(lost); },
            [&](const Protocol::ProtocolNoted& noted) {
                _notes.OnNoted(noted, GetStatistics().CountOf(noted.what), _clock.GetNow().steady);
            },
            [&](const Protocol::RequestRefused& refused) {
                _notes.Drop();
                Warn(
                    "refused " + CutReason(refused.reason),
                    "command refused",
                    {{"command", refused.commandName},
                     {"planId", refused.planID},
                     {"transactionId", refused.transactionID},
                     {"reason", refused.reason},
                     {"field", refused.path}});
            },
            [](const auto&) { /* not worth a line */ }},
        event);
}

void McsLink::Warn(std::string_view kind, std::string_view message, std::initializer_list<Core::LogField> fields)
{
    _log.Write(_clock.GetNow().steady, Core::ELogLevel::Warning, kind, message, fields);
}

void McsLink::LogOutage(const Protocol::LinkLost& lost)
{
    // Logged once per reason: further attempts mostly fail for the same one. What the MCS answered in its own words may differ.
    const std::string_view reason = std::string_view(lost.reason).substr(0, lost.reason.find(": \""));
    if (_stopHandler || reason == _loggedOutage)
    {
        return;
    }
    _loggedOutage = reason;
    const std::string_view unregistered = _watch.IsRefused()
        ? "connection to the MCS ended without a registration, retrying"
        : "cannot reach the MCS: start it or correct mcs.url; retrying until it answers";
    _logger.Warning(
        lost.bWasRegistered ? "connection to the MCS lost, retrying until it answers" : unregistered,
        {{"url", _url}, {"reason", lost.reason}});
}

} // namespace ACS::Acsd
