#include "McsLink.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
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
    options.tls = config.mcs.tls;
    options.headers = config.mcs.headers;
    options.link.pingInterval = config.mcs.pingInterval;
    options.session.ackTimeout = config.mcs.ackTimeout;
    options.session.ackRetries = config.mcs.ackRetries;
    options.session.positionInterval = config.positionInterval;
    return options;
}

/// Habits that cost nothing.
bool IsHarmless(Protocol::EProtocolNote what)
{
    switch (what)
    {
        case Protocol::EProtocolNote::UnknownMember:
        case Protocol::EProtocolNote::NullOptional:
        case Protocol::EProtocolNote::LenientWord:
        case Protocol::EProtocolNote::LenientNumber:
        case Protocol::EProtocolNote::BadTimestamp:
        case Protocol::EProtocolNote::DuplicateRequest:
            return true;
        case Protocol::EProtocolNote::Undecodable:
        case Protocol::EProtocolNote::UnknownCommand:
        case Protocol::EProtocolNote::AckMismatched:
        case Protocol::EProtocolNote::AckUnexpected:
        case Protocol::EProtocolNote::AckFailed:
        case Protocol::EProtocolNote::BeforeRegistered:
        case Protocol::EProtocolNote::RegistrationUnanswered:
        default:
            return false;
    }
}

std::size_t CountDigits(std::uint64_t number)
{
    return fmt::format_int(number).size();
}

} // namespace

McsLink::McsLink(
    const Core::IClock& clock,
    Core::Logger logger,
    const Apps::LocalOffset& localOffset,
    const Planning::PlanEngine& engine,
    CommandHandler handler)
    : _clock(clock),
      _logger(logger),
      _dialog(clock, std::move(logger), localOffset, engine, *this, std::move(handler))
{
}

McsLink::~McsLink() = default;

Core::Result<void> McsLink::Open(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    const AcsdConfig& config,
    MessageTrace* traceOrNull)
{
    ProtocolBeast::ClientOptions options = MakeOptions(config);
    if (traceOrNull != nullptr)
    {
        options.onWire = [traceOrNull](ProtocolBeast::EWireDirection direction, std::string_view text) {
            traceOrNull->Write({"mcs", direction, {}, {}, text});
        };
    }
    auto client = ProtocolBeast::AcsClient::Create(executor, _clock, random, _logger, options, *this);
    if (!client)
    {
        return tl::unexpected<Core::Error>(client.error());
    }
    _client = std::move(*client);
    _url = Apps::MakeText(config.mcs.url);
    return {};
}

void McsLink::Restore(std::uint64_t lastSequence)
{
    _dialog.Restore(lastSequence);
}

void McsLink::Start()
{
    _dialog.Begin();
    _client->Start();
}

void McsLink::StopAsync(StopHandler handler)
{
    _stopHandler = std::move(handler);
    _client->SendStatus(Protocol::AcsCommStateUpdate{false});
    _client->Stop();
}

void McsLink::Reply(const Planning::ReplyCommand& reply)
{
    _dialog.Reply(reply);
}

void McsLink::Report(const Planning::OutboxEntry& entry)
{
    _dialog.Report(entry);
}

void McsLink::TellStatus(const Planning::RobotStatus& status)
{
    _dialog.TellStatus(status);
}

void McsLink::TellWorking(bool bWorking)
{
    _dialog.TellWorking(bWorking);
}

void McsLink::TellTsc(Planning::ETscState state)
{
    _dialog.TellTsc(state);
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

const Protocol::SessionStatistics& McsLink::GetStatistics() const
{
    return _client->GetStatistics();
}

void McsLink::OnSessionEvent(const Protocol::SessionEvent& event)
{
    LogEvent(event);
    _dialog.OnSessionEvent(event);
    if (std::holds_alternative<Protocol::Stopped>(event) && _stopHandler)
    {
        std::exchange(_stopHandler, nullptr)();
    }
}

void McsLink::LogEvent(const Protocol::SessionEvent& event)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) {
                _logger.Info("registered with the MCS");
                _loggedOutage.clear();
            },
            [&](const Protocol::RegistrationRefused& refused) {
                _logger.Warning("the MCS refuses the registration, trying again", {{"reason", refused.message}});
            },
            [&](const Protocol::RequestUnanswered& unanswered) {
                _logger.Warning(
                    "the MCS does not acknowledge",
                    {{"command", GetText(unanswered.command)}, {"transactionId", unanswered.transactionID}});
            },
            [&](const Protocol::LinkLost& lost) { LogOutage(lost); },
            [&](const Protocol::ProtocolNoted& noted) { LogNote(noted); },
            [](const auto&) { /* not worth a line */ }},
        event);
}

void McsLink::LogNote(const Protocol::ProtocolNoted& noted)
{
    // The first, the tenth, the hundredth: an MCS that repeats its mistake does not fill the log.
    const std::uint64_t total = GetStatistics().CountOf(noted.what);
    const std::uint64_t before = total - std::min<std::uint64_t>(noted.count, total);
    if (before > 0 && CountDigits(before) == CountDigits(total))
    {
        return;
    }
    _logger.Write(
        IsHarmless(noted.what) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
        "the MCS departs from the protocol",
        {{"what", GetText(noted.what)}, {"detail", noted.detail}, {"count", fmt::format_int(total).str()}});
}

void McsLink::LogOutage(const Protocol::LinkLost& lost)
{
    // Once per reason: every further try fails for the same one, or tells something new.
    if (_stopHandler || lost.reason == _loggedOutage)
    {
        return;
    }
    _loggedOutage = lost.reason;
    _logger.Warning(
        lost.bWasRegistered ? "lost the MCS, trying again until it answers"
                            : "cannot reach the MCS: start it or correct mcs.url; trying again until it answers",
        {{"url", _url}, {"reason", lost.reason}});
}

} // namespace ACS::Acsd
