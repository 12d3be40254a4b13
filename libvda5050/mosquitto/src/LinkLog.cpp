#include "LinkLog.hpp"

#include "MosquittoError.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::VDA5050
{

LinkLog::LinkLog(Core::Logger logger, const MosquittoOptions& options, const BrokerRotation& rotation)
    : _logger(std::move(logger)),
      _options(options),
      _rotation(rotation)
{
}

void LinkLog::OnAttempt() noexcept
{
    _bLaterRefusalLogged = false;
    _bTooLongLogged = false;
}

void LinkLog::OnUp(std::size_t earlyDropped)
{
    _outages.clear();
    _refusals.clear();
    _logger.Write(
        _bRivalLogged ? Core::ELogLevel::Debug : Core::ELogLevel::Info,
        "connected to the MQTT broker",
        {{"broker", GetAddress()}, {"client", _options.clientID}});
    if (earlyDropped > 0)
    {
        _logger.Error(
            "too many messages before the subscriptions were confirmed: the rest is dropped",
            {{"broker", GetAddress()}, {"dropped", std::to_string(earlyDropped)}});
    }
}

void LinkLog::ForgetRival() noexcept
{
    _bRivalLogged = false;
}

void LinkLog::OnRenewal() const
{
    _logger.Info("starts a new session on the MQTT broker", {{"broker", GetAddress()}});
}

void LinkLog::OnTooLong(const std::string& topic, std::size_t bytes)
{
    _logger.Write(
        std::exchange(_bTooLongLogged, true) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
        "a message that is too long is dropped",
        {{"topic", Core::QuoteForError(topic)}, {"bytes", std::to_string(bytes)}});
}

void LinkLog::OnLaterRefused(const std::string& filter)
{
    _logger.Write(
        std::exchange(_bLaterRefusalLogged, true) ? Core::ELogLevel::Debug : Core::ELogLevel::Error,
        "the MQTT broker refuses a subscription: check its access rules",
        {{"broker", GetAddress()}, {"filter", filter}});
}

void LinkLog::OnUnsent(const std::string& filter) const
{
    _logger.Error("cannot subscribe", {{"filter", filter}});
}

void LinkLog::OnOutage(bool bWasUp, const std::error_code& reason)
{
    if (!_outages.insert(_rotation.GetCurrent()).second)
    {
        _logger.Debug("still no MQTT broker", {{"broker", GetAddress()}, {"reason", reason.message()}});
        return;
    }
    const std::string_view event = bWasUp ? "lost the MQTT broker at" : "cannot reach the MQTT broker at";
    _logger.Warning(fmt::format(
        "{} {} ({}): {}; {}",
        event,
        GetAddress(),
        reason.message(),
        MakeConnectAdvice(reason),
        MakePlan("answers")));
}

void LinkLog::OnRefused(const std::string& filter)
{
    if (!_refusals.insert(_rotation.GetCurrent()).second)
    {
        _logger.Debug("the MQTT broker refuses a subscription still", {{"filter", filter}});
        return;
    }
    _logger.Warning(fmt::format(
        "the MQTT broker {} refuses the subscription {}: check its access rules; {}",
        GetAddress(),
        filter,
        MakePlan("accepts it")));
}

void LinkLog::OnRival(const std::error_code& reason)
{
    if (_bRivalLogged)
    {
        _logger.Debug("disconnected again: another client uses the same client id", {{"client", _options.clientID}});
        return;
    }
    _bRivalLogged = true;
    const std::string what = IsSessionTakenOver(reason)
        ? fmt::format(
            "another client took over the client id {} at the MQTT broker {}; give each client an id of its own",
            _options.clientID,
            GetAddress())
        : fmt::format(
            "the MQTT broker {} ends each connection at once: if another client uses the client id {}, give each client an id of "
            "its own; otherwise the broker may not support the QoS or a character of a topic, see its log",
            GetAddress(),
            _options.clientID);
    _logger.Error(fmt::format("{}. Trying again every {} ms", what, _options.backoff.maximum.count()));
}

std::string LinkLog::GetAddress(std::size_t index) const
{
    const MosquittoBroker broker = GetBroker(_options, index);
    const bool bAddressV6 = broker.host.find(':') != std::string::npos;
    return bAddressV6 ? fmt::format("[{}]:{}", broker.host, broker.port)
                      : fmt::format("{}:{}", broker.host, broker.port);
}

std::string LinkLog::GetAddress() const
{
    return GetAddress(_rotation.GetCurrent());
}

std::string LinkLog::MakePlan(std::string_view until) const
{
    return _options.furtherBrokers.empty() ? fmt::format("trying again until it {}", until)
                                           : fmt::format("trying {} next", GetAddress(_rotation.GetNext()));
}

MosquittoBroker GetBroker(const MosquittoOptions& options, std::size_t index)
{
    return index == 0 ? MosquittoBroker{options.host, options.port} : options.furtherBrokers.at(index - 1);
}

} // namespace ACS::VDA5050
