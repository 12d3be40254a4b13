#include "BrokerRotation.hpp"
#include "LinkLog.hpp"
#include "MosquittoConnection.hpp"
#include "MosquittoError.hpp"
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <map>
#include <utility>

namespace ACS::VDA5050
{

/// Shared, so that a timer or a posted call that comes late finds either the whole of it or nothing.
class MosquittoLink::Impl final : public IMosquittoConnectionOwner, public std::enable_shared_from_this<Impl>
{
    struct WaitingSubscription
    {
        MqttSubscription subscription;
        bool bLater = false; ///< OnLinkUp does not wait for it.
    };

    boost::asio::any_io_executor _executor;
    MosquittoOptions _options;
    BrokerRotation _rotation;
    LinkLog _log;
    IMqttLinkListener* _listenerOrNull;
    Core::IRandom* _random;
    Core::Backoff _backoff;
    boost::asio::steady_timer
        _timer; ///< Until the next attempt, until the backoff is forgotten, or until Stop is over.
    std::vector<std::unique_ptr<MosquittoConnector>>
        _connectors; ///< One per broker: a name server that hangs delays no other.
    std::shared_ptr<MosquittoConnection> _connectionOrNull;
    std::optional<MosquittoClient> _clientOrNull; ///< Of a persistent session, between two connections.
    std::vector<MqttSubscription> _subscriptions;
    std::deque<WaitingSubscription> _waiting; ///< Not sent yet, those that OnLinkUp waits for first.
    std::map<int, std::string> _unconfirmed;  ///< The filters that OnLinkUp waits for, by the id of their message.
    std::map<int, std::string> _later;        ///< Those that came after them.
    std::string _refusedFilter;               ///< The reason why the connection is closed.
    std::vector<MqttMessage> _early;
    std::size_t _earlyBytes = 0;
    std::size_t _earlyDropped = 0;
    std::vector<StopHandler> _stopHandlers;
    std::chrono::steady_clock::time_point _upSince;
    std::size_t _shortLives = 0; ///< Consecutive connections that ended right after they were established.
    bool _bUp = false;
    bool _bStopping = false;
    bool _bStopped = false;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        Core::Logger logger,
        MosquittoOptions options,
        IMqttLinkListener& listener);

    void Start();
    void Abandon();
    [[nodiscard]] Core::Result<void> Publish(const MqttMessage& message);
    void Subscribe(const std::vector<MqttSubscription>& subscriptions);
    void Unsubscribe(const std::string& topicFilter);
    void SetWill(const MqttWill& will);
    [[nodiscard]] bool IsConnected() const;
    [[nodiscard]] std::size_t GetBrokerIndex() const noexcept;
    void StopAsync(
        const std::optional<MqttMessage>& lastMessageOrNull,
        std::chrono::milliseconds timeout,
        StopHandler handler);

    void OnConnectionUp() override;
    void OnConnectionMessage(const MqttMessage& message) override;
    void OnTooLong(const std::string& topic, std::size_t bytes) override;
    void OnSent(int messageID) override;
    void OnSubscribed(int messageID, bool bGranted) override;
    void OnConnectionClosed(std::error_code reason) override;

private:
    void Connect();
    [[nodiscard]] bool IsConnectorBusy() const;
    [[nodiscard]] std::optional<MosquittoClient> TakeLateClientOrNull();
    void Forget(const std::string& topicFilter);
    void SendSubscriptions();
    void TryNext();
    void Retry(std::chrono::milliseconds pause);
    [[nodiscard]] bool HasRival(bool bWasUp, const std::error_code& reason);
    void LogEnd(bool bWasUp, bool bRenewal, bool bRival, const std::error_code& reason);
    void GiveUp(const std::string& filter);
    void AnnounceWhenConfirmed();
    void FinishStop();
    void AbandonConnectors() noexcept;
};

namespace
{

/// After a connection of this duration the next outage starts with the initial backoff again.
constexpr std::chrono::seconds STABLE_AFTER{5};
constexpr std::size_t SUSPICIOUS_LIVES = 3;
/// Subscriptions at a time. A broker that stores each of them in a cluster may need more than a second for one, during which it
/// answers nothing else; all at once would take longer than the keep-alive permits.
constexpr std::size_t MAX_UNCONFIRMED = 4;

} // namespace

MosquittoLink::Impl::Impl(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    Core::Logger logger,
    MosquittoOptions options,
    IMqttLinkListener& listener)
    : _executor(executor),
      _options(std::move(options)),
      _rotation(_options.furtherBrokers.size() + 1),
      _log(std::move(logger), _options, _rotation),
      _listenerOrNull(&listener),
      _random(&random),
      _backoff(_options.backoff),
      _timer(executor)
{
    for (std::size_t index = 0; index <= _options.furtherBrokers.size(); ++index)
    {
        _connectors.push_back(std::make_unique<MosquittoConnector>(executor));
    }
}

void MosquittoLink::Impl::Start()
{
    boost::asio::post(_executor, [weak = weak_from_this()]() {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !self->_bStopping && self->_connectionOrNull == nullptr)
        {
            self->Connect();
        }
    });
}

void MosquittoLink::Impl::Abandon()
{
    _bStopping = true;
    _listenerOrNull = nullptr;
    _stopHandlers.clear();
    _timer.cancel();
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Abandon();
        _connectionOrNull.reset();
    }
    AbandonConnectors();
}

void MosquittoLink::Impl::AbandonConnectors() noexcept
{
    for (const std::unique_ptr<MosquittoConnector>& connector : _connectors)
    {
        connector->Abandon();
    }
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
    for (const MqttSubscription& subscription : subscriptions)
    {
        Forget(subscription.topicFilter);
        _subscriptions.push_back(subscription);
        if (_connectionOrNull != nullptr && _connectionOrNull->IsUp())
        {
            _waiting.push_back({subscription, true});
        }
    }
    SendSubscriptions();
}

void MosquittoLink::Impl::SendSubscriptions()
{
    while (!_waiting.empty() && _refusedFilter.empty() && _unconfirmed.size() + _later.size() < MAX_UNCONFIRMED)
    {
        const WaitingSubscription next = std::move(_waiting.front());
        _waiting.pop_front();
        const std::string& filter = next.subscription.topicFilter;
        const std::optional<int> messageID = _connectionOrNull->SubscribeOrNull(next.subscription);
        if (messageID.has_value())
        {
            (next.bLater ? _later : _unconfirmed)[*messageID] = filter;
        }
        else if (!next.bLater)
        {
            GiveUp(filter);
        }
        else if (_connectionOrNull->IsUp())
        {
            _log.OnUnsent(filter);
        }
    }
}

void MosquittoLink::Impl::Unsubscribe(const std::string& topicFilter)
{
    Forget(topicFilter);
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Unsubscribe(topicFilter);
    }
}

void MosquittoLink::Impl::Forget(const std::string& topicFilter)
{
    std::erase_if(_subscriptions, [&topicFilter](const MqttSubscription& known) {
        return known.topicFilter == topicFilter;
    });
    std::erase_if(_waiting, [&topicFilter](const WaitingSubscription& waiting) {
        return waiting.subscription.topicFilter == topicFilter;
    });
}

void MosquittoLink::Impl::SetWill(const MqttWill& will)
{
    _options.will = will;
}

bool MosquittoLink::Impl::IsConnected() const
{
    return _bUp && !_bStopping && _connectionOrNull != nullptr && _connectionOrNull->IsUp();
}

std::size_t MosquittoLink::Impl::GetBrokerIndex() const noexcept
{
    return _rotation.GetCurrent();
}

/// The exchanges of a persistent session are in the client that the thread has; without it they would be lost.
bool MosquittoLink::Impl::IsConnectorBusy() const
{
    return _options.bCleanSession ? _connectors.at(_rotation.GetCurrent())->IsBusy()
                                  : std::ranges::any_of(_connectors, &MosquittoConnector::IsBusy);
}

std::optional<MosquittoClient> MosquittoLink::Impl::TakeLateClientOrNull()
{
    for (const std::unique_ptr<MosquittoConnector>& connector : _connectors)
    {
        if (std::optional<MosquittoClient> lateOrNull = connector->TakeLateOrNull(); lateOrNull.has_value())
        {
            return lateOrNull;
        }
    }
    return std::nullopt;
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
        _clientOrNull = TakeLateClientOrNull();
    }
    _waiting.clear();
    _unconfirmed.clear();
    _later.clear();
    _refusedFilter.clear();
    _log.OnAttempt();
    if (_options.bCleanSession)
    {
        _earlyBytes = 0;
        _early.clear(); // else the broker has its acknowledgement for it, and will not send it again
    }
    _earlyDropped = 0;
    _connectionOrNull = std::make_shared<MosquittoConnection>(_executor, *this);
    const std::size_t index = _rotation.GetCurrent();
    MosquittoOptions options = _options;
    const MosquittoBroker broker = GetBroker(_options, index);
    options.host = broker.host;
    options.port = broker.port;
    const std::error_code refused =
        _connectionOrNull->Open(options, std::exchange(_clientOrNull, std::nullopt), *_connectors.at(index));
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
        _rotation.IsRoundOver() ? _backoff.GetNextDelay(*_random)
                                : Core::Backoff(_options.backoff).GetNextDelay(*_random));
}

void MosquittoLink::Impl::Retry(std::chrono::milliseconds pause)
{
    _timer.expires_after(pause);
    _timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !error && !self->_bStopping)
        {
            self->Connect();
        }
    });
}

/// MQTT 5 reports it. 3.1.1 only closes the connection, which is detected by repeated short connections.
bool MosquittoLink::Impl::HasRival(bool bWasUp, const std::error_code& reason)
{
    const auto life =
        bWasUp ? std::chrono::steady_clock::now() - _upSince : std::chrono::steady_clock::duration::zero();
    if (life > 2 * _options.backoff.maximum + STABLE_AFTER)
    {
        _log.ForgetRival();
    }
    if (IsSessionTakenOver(reason))
    {
        return true;
    }
    if (_options.clientID.empty())
    {
        return false; // A generated one is unique.
    }
    _shortLives = life >= STABLE_AFTER ? 0 : _shortLives + (bWasUp ? 1 : 0);
    return bWasUp && _shortLives >= SUSPICIOUS_LIVES;
}

void MosquittoLink::Impl::LogEnd(bool bWasUp, bool bRenewal, bool bRival, const std::error_code& reason)
{
    if (!_refusedFilter.empty())
    {
        _log.OnRefused(_refusedFilter);
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
    _waiting.clear();
    for (const MqttSubscription& subscription : _subscriptions)
    {
        _waiting.push_back({subscription, false});
    }
    SendSubscriptions();
    AnnounceWhenConfirmed();
}

void MosquittoLink::Impl::OnSubscribed(int messageID, bool bGranted)
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    const auto later = _later.find(messageID);
    if (later != _later.end())
    {
        if (!bGranted)
        {
            _log.OnLaterRefused(later->second);
        }
        _later.erase(later);
        SendSubscriptions();
        AnnounceWhenConfirmed();
        return;
    }
    const auto found = _unconfirmed.find(messageID);
    if (found == _unconfirmed.end())
    {
        return;
    }
    if (!bGranted)
    {
        GiveUp(found->second);
        return;
    }
    _unconfirmed.erase(found);
    _connectionOrNull->ProlongConnect();
    SendSubscriptions();
    AnnounceWhenConfirmed();
}

/// Without its subscriptions a session would wait for messages in vain. Disconnects, so that no will is sent.
void MosquittoLink::Impl::GiveUp(const std::string& filter)
{
    if (!_refusedFilter.empty() || _bStopping)
    {
        return;
    }
    _refusedFilter = filter;
    _connectionOrNull->TakeLeave();
}

void MosquittoLink::Impl::AnnounceWhenConfirmed()
{
    const bool bWaiting = !_waiting.empty() && !_waiting.front().bLater;
    if (bWaiting || !_unconfirmed.empty() || !_refusedFilter.empty() || _bUp || _bStopping)
    {
        return;
    }
    _bUp = true;
    _connectionOrNull->Confirm();
    _upSince = std::chrono::steady_clock::now();
    _log.OnUp(_earlyDropped);
    _timer.expires_after(STABLE_AFTER);
    _timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const std::shared_ptr<Impl> self = weak.lock();
        if (self != nullptr && !error)
        {
            self->_backoff.Reset();
            self->_rotation.BeginRound();
        }
    });
    _earlyBytes = 0;
    _listenerOrNull->OnLinkUp();
    for (const MqttMessage& message : std::exchange(_early, {}))
    {
        OnConnectionMessage(message);
    }
}

void MosquittoLink::Impl::OnConnectionMessage(const MqttMessage& message)
{
    const std::shared_ptr<Impl> self = shared_from_this(); // the listener may destroy the link
    if (_bStopping)
    {
        return;
    }
    if (!_bUp)
    {
        const std::size_t bytes = message.topic.size() + message.payload.size();
        if (_early.size() < _options.maxEarly && bytes <= _options.maxEarlyBytes - _earlyBytes)
        {
            _early.push_back(message);
            _earlyBytes += bytes;
        }
        else
        {
            ++_earlyDropped;
        }
        return;
    }
    _listenerOrNull->OnMqttMessage(message);
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
    const bool bWasUp = std::exchange(_bUp, false);
    if (_bStopping)
    {
        FinishStop();
        return;
    }
    if (!reason)
    {
        reason = std::make_error_code(std::errc::connection_aborted);
    }
    const bool bRival = HasRival(bWasUp, reason);
    LogEnd(bWasUp, bRenewal, bRival, reason);
    if (bRival)
    {
        _rotation.MoveOn();
        Retry(_options.backoff.maximum);
    }
    else if (bRenewal)
    {
        Retry(_backoff.GetNextDelay(*_random)); // it was in order
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
    if (_bStopping && _connectionOrNull != nullptr && !_connectionOrNull->HasUnsent())
    {
        _connectionOrNull->TakeLeave();
    }
}

void MosquittoLink::Impl::StopAsync(
    const std::optional<MqttMessage>& lastMessageOrNull,
    std::chrono::milliseconds timeout,
    StopHandler handler)
{
    _stopHandlers.push_back(std::move(handler));
    if (_bStopping)
    {
        if (_bStopped)
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
    _bStopping = true;
    _timer.cancel();
    if (bWasConnected && lastMessageOrNull.has_value())
    {
        std::ignore = _connectionOrNull->Publish(*lastMessageOrNull);
    }
    // libmosquitto closes the socket with its DISCONNECT. A broker that cannot hand over an acknowledgement any more takes
    // the connection for broken before it has read so far, and publishes the will.
    if (_connectionOrNull != nullptr && (!bWasConnected || !_connectionOrNull->HasUnsent()))
    {
        _connectionOrNull->TakeLeave();
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
    _bStopped = true;
    _timer.cancel();
    if (_connectionOrNull != nullptr)
    {
        _connectionOrNull->Abandon();
        _connectionOrNull.reset();
    }
    AbandonConnectors();
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

MosquittoLink::MosquittoLink(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    Core::Logger logger,
    MosquittoOptions options,
    IMqttLinkListener& listener)
    : _impl(std::make_shared<Impl>(executor, random, std::move(logger), std::move(options), listener))
{
}

MosquittoLink::~MosquittoLink()
{
    try
    {
        _impl->Abandon();
    }
    catch (const std::exception&)
    {
        // Asio's timers may throw; the connection goes with the last reference in any case.
    }
}

void MosquittoLink::Start()
{
    _impl->Start();
}

Core::Result<void> MosquittoLink::Publish(const MqttMessage& message)
{
    return _impl->Publish(message);
}

void MosquittoLink::Subscribe(const std::vector<MqttSubscription>& subscriptions)
{
    _impl->Subscribe(subscriptions);
}

void MosquittoLink::Unsubscribe(const std::string& topicFilter)
{
    _impl->Unsubscribe(topicFilter);
}

void MosquittoLink::SetWill(const MqttWill& will)
{
    _impl->SetWill(will);
}

bool MosquittoLink::IsConnected() const
{
    return _impl->IsConnected();
}

std::size_t MosquittoLink::GetBrokerIndex() const
{
    return _impl->GetBrokerIndex();
}

void MosquittoLink::StopAsync(
    const std::optional<MqttMessage>& lastMessageOrNull,
    std::chrono::milliseconds timeout,
    StopHandler handler)
{
    _impl->StopAsync(lastMessageOrNull, timeout, std::move(handler));
}

} // namespace ACS::VDA5050
