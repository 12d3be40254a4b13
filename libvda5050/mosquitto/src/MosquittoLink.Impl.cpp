#include "MosquittoLink.Impl.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace ACS::VDA5050
{

MosquittoLink::Impl::Impl(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    Core::Logger logger,
    MosquittoOptions options,
    IMqttLinkListener& listener)
    : _executor(executor),
      _options(std::move(options)),
      _rotation(_options.furtherBrokers.size() + 1),
      _connectors(executor, _options.furtherBrokers.size() + 1),
      _log(std::move(logger), _options, _rotation),
      _early({_options.maxEarly, _options.maxEarlyBytes}),
      _rivals(_options.clientID.empty()),
      _listenerOrNull(&listener),
      _random(random),
      _backoff(_options.backoff),
      _timer(executor)
{
}

bool MosquittoLink::Impl::IsStopping() const noexcept
{
    return _state == EState::Stopping || _state == EState::Stopped;
}

void MosquittoLink::Impl::Start()
{
    boost::asio::post(_executor, [weak = weak_from_this()]() {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !self->IsStopping() && self->_connectionOrNull == nullptr)
        {
            self->Connect();
        }
    });
}

void MosquittoLink::Impl::Abandon()
{
    _state = EState::Stopping;
    _listenerOrNull = nullptr;
    _stopHandlers.clear();
    _timer.cancel();
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Abandon();
        _connectionOrNull.reset();
    }
    _connectors.Abandon();
}

Core::Result<void> MosquittoLink::Impl::Publish(const MqttMessage& message)
{
    if (!IsConnected())
    {
        return Core::Fail(std::make_error_code(std::errc::not_connected));
    }
    const Core::Result<int> messageID = _connectionOrNull->Publish(message);
    if (!messageID.has_value())
    {
        return tl::make_unexpected(messageID.error());
    }
    return {};
}

void MosquittoLink::Impl::Subscribe(const std::vector<MqttSubscription>& subscriptions)
{
    const bool bConnected = _connectionOrNull != nullptr && _connectionOrNull->IsUp();
    for (const MqttSubscription& subscription : subscriptions)
    {
        _subscriptions.Add(subscription, bConnected);
    }
    if (bConnected)
    {
        SendSubscriptions();
    }
}

void MosquittoLink::Impl::SendSubscriptions()
{
    while (const std::optional<LinkSubscriptions::Request> next = _subscriptions.TakeNextOrNull())
    {
        const std::string& filter = next->subscription.topicFilter;
        if (const std::optional<int> messageID = _connectionOrNull->SubscribeOrNull(next->subscription))
        {
            _subscriptions.OnSent(*next, *messageID);
        }
        else if (!next->bLater)
        {
            RefuseSession(filter);
        }
        else if (_connectionOrNull->IsUp())
        {
            _log.OnUnsent(filter);
        }
    }
}

void MosquittoLink::Impl::Unsubscribe(const std::string& topicFilter)
{
    _subscriptions.Remove(topicFilter);
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Unsubscribe(topicFilter);
    }
}

void MosquittoLink::Impl::SetWill(const MqttWill& will)
{
    _options.will = will;
}

bool MosquittoLink::Impl::IsConnected() const
{
    return _state == EState::Up && _connectionOrNull != nullptr && _connectionOrNull->IsUp();
}

std::size_t MosquittoLink::Impl::GetBrokerIndex() const noexcept
{
    return _rotation.GetCurrent();
}

/// The exchanges of a persistent session are in the client that the thread has; without it they would be lost.
bool MosquittoLink::Impl::IsConnectorBusy() const
{
    return _options.bCleanSession ? _connectors.Get(_rotation.GetCurrent()).IsBusy() : _connectors.IsAnyBusy();
}

void MosquittoLink::Impl::Connect()
{
    if (IsConnectorBusy())
    {
        TryNext(); // the attempt that has timed out still hangs, for example in a name server
        return;
    }
    if (!_options.bCleanSession && !_clientOrNull.has_value())
    {
        _clientOrNull = _connectors.TakeLateOrNull();
    }
    _subscriptions.OnAttempt();
    _log.OnAttempt();
    // Of a persistent session the broker has its acknowledgement for them, and will not send them again.
    _early.OnAttempt(!_options.bCleanSession);
    _connectionOrNull = std::make_shared<MosquittoConnection>(_executor, *this);
    const std::size_t index = _rotation.GetCurrent();
    MosquittoOptions options = _options;
    const MosquittoBroker broker = GetBroker(_options, index);
    options.host = broker.host;
    options.port = broker.port;
    const std::error_code refused =
        _connectionOrNull->Open(options, std::exchange(_clientOrNull, std::nullopt), _connectors.Get(index));
    if (refused)
    {
        _connectionOrNull->Abandon();
        _connectionOrNull.reset();
        _log.OnOutage(false, refused);
        TryNext();
    }
}

/// Within a round only the first delay of the backoff passes: each broker may be the one that still runs.
void MosquittoLink::Impl::TryNext()
{
    _rotation.MoveOn();
    Retry(
        _rotation.IsRoundOver() ? _backoff.GetNextDelay(_random)
                                : Core::Backoff(_options.backoff).GetNextDelay(_random));
}

void MosquittoLink::Impl::Retry(std::chrono::milliseconds pause)
{
    _timer.expires_after(pause);
    _timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !error && !self->IsStopping())
        {
            self->Connect();
        }
    });
}

/// When another client would have been back by now, the next one is logged again.
bool MosquittoLink::Impl::HasRival(const std::error_code& reason)
{
    const RivalDetector::End end = _rivals.OnEnd(std::chrono::steady_clock::now(), reason);
    if (end.upTime > 2 * _options.backoff.maximum + RivalDetector::STABLE_AFTER)
    {
        _log.ForgetRival();
    }
    return end.bRival;
}

void MosquittoLink::Impl::LogEnd(bool bWasUp, bool bRenewal, bool bRival, const std::error_code& reason)
{
    if (const std::string& filter = _subscriptions.GetRefused(); !filter.empty())
    {
        _log.OnRefused(filter);
    }
    else if (bRival)
    {
        _log.OnRival(reason);
    }
    else if (bRenewal)
    {
        _log.OnRenewal();
    }
    else
    {
        _log.OnOutage(bWasUp, reason);
    }
}

void MosquittoLink::Impl::OnConnectionUp()
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    _subscriptions.OnConnected();
    SendSubscriptions();
    AnnounceWhenConfirmed();
}

void MosquittoLink::Impl::OnSubscribed(int messageID, bool bGranted)
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    const std::optional<LinkSubscriptions::Answered> answered = _subscriptions.OnAnsweredOrNull(messageID);
    if (!answered.has_value())
    {
        return;
    }
    if (!bGranted && !answered->bLater)
    {
        RefuseSession(answered->filter);
        return;
    }
    if (!bGranted)
    {
        _log.OnLaterRefused(answered->filter);
    }
    else if (!answered->bLater)
    {
        _connectionOrNull->ProlongConnect();
    }
    SendSubscriptions();
    AnnounceWhenConfirmed();
}

/// Without its subscriptions a session would wait for messages in vain. Disconnects, so that no will is sent.
void MosquittoLink::Impl::RefuseSession(const std::string& filter)
{
    if (_subscriptions.GetRefused().empty() && !IsStopping())
    {
        _subscriptions.Refuse(filter);
        _connectionOrNull->Disconnect();
    }
}

void MosquittoLink::Impl::AnnounceWhenConfirmed()
{
    if (!_subscriptions.IsConfirmed() || _state != EState::Down)
    {
        return;
    }
    _state = EState::Up;
    _connectionOrNull->Confirm();
    _rivals.OnUp(std::chrono::steady_clock::now());
    _log.OnUp(_early.GetDropped());
    _timer.expires_after(RivalDetector::STABLE_AFTER);
    _timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !error)
        {
            self->_backoff.Reset();
            self->_rotation.BeginRound();
        }
    });
    _listenerOrNull->OnLinkUp();
    for (const MqttMessage& message : _early.TakeAll())
    {
        OnConnectionMessage(message);
    }
}

void MosquittoLink::Impl::OnConnectionMessage(const MqttMessage& message)
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    if (_state == EState::Down)
    {
        _early.Add(message);
    }
    else if (_state == EState::Up)
    {
        _listenerOrNull->OnMqttMessage(message);
    }
}

void MosquittoLink::Impl::OnTooLong(const std::string& topic, std::size_t bytes)
{
    _log.OnTooLong(topic, bytes);
}

void MosquittoLink::Impl::OnConnectionClosed(std::error_code reason)
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    const bool bRenewal = _connectionOrNull->IsRenewal();
    _clientOrNull = _connectionOrNull->TakeClientOrNull();
    _connectionOrNull.reset();
    if (IsStopping())
    {
        FinishStop();
        return;
    }
    const bool bWasUp = std::exchange(_state, EState::Down) == EState::Up;
    if (!reason)
    {
        reason = std::make_error_code(std::errc::connection_aborted);
    }
    const bool bRival = HasRival(reason);
    LogEnd(bWasUp, bRenewal, bRival, reason);
    if (bRival)
    {
        _rotation.MoveOn();
        Retry(_options.backoff.maximum);
    }
    else if (bRenewal)
    {
        Retry(_backoff.GetNextDelay(_random)); // it was in order
    }
    else
    {
        TryNext();
    }
    if (bWasUp)
    {
        _listenerOrNull->OnLinkDown(reason);
    }
}

void MosquittoLink::Impl::OnSent(int /*messageID*/)
{
    if (IsStopping() && _connectionOrNull != nullptr && !_connectionOrNull->HasUnsent())
    {
        _connectionOrNull->Disconnect();
    }
}

void MosquittoLink::Impl::StopAsync(
    const std::optional<MqttMessage>& lastMessageOrNull,
    std::chrono::milliseconds timeout,
    StopHandler handler)
{
    _stopHandlers.push_back(std::move(handler));
    if (IsStopping())
    {
        if (_state == EState::Stopped)
        {
            boost::asio::post(_executor, [weak = weak_from_this()]() {
                const std::shared_ptr<Impl> self = weak.lock();
                if (self != nullptr)
                {
                    self->FinishStop();
                }
            });
        }
        return;
    }
    const bool bWasConnected = IsConnected();
    _state = EState::Stopping;
    _timer.cancel();
    if (bWasConnected && lastMessageOrNull.has_value())
    {
        std::ignore = _connectionOrNull->Publish(*lastMessageOrNull);
    }
    // libmosquitto closes the socket with its DISCONNECT. A broker that cannot hand over an acknowledgement any more takes
    // the connection for broken before it has read so far, and publishes the will.
    if (_connectionOrNull != nullptr && (!bWasConnected || !_connectionOrNull->HasUnsent()))
    {
        _connectionOrNull->Disconnect();
    }
    _timer.expires_after(_connectionOrNull != nullptr ? timeout : std::chrono::milliseconds::zero());
    _timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !error)
        {
            self->FinishStop();
        }
    });
}

void MosquittoLink::Impl::FinishStop()
{
    const std::shared_ptr<Impl> self = shared_from_this(); // a handler may destroy the link
    _state = EState::Stopped;
    _timer.cancel();
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Abandon();
        _connectionOrNull.reset();
    }
    _connectors.Abandon();
    // One by one: a handler may destroy the link, and none is called after that.
    while (!_stopHandlers.empty())
    {
        const StopHandler handler = std::move(_stopHandlers.front());
        _stopHandlers.erase(_stopHandlers.begin());
        if (handler)
        {
            handler();
        }
    }
}

} // namespace ACS::VDA5050
