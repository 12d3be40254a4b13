#include "MqttBroker.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

/// Subscriptions have no wildcards.
const VDA5050::MqttSubscription* FindSubscriptionOrNull(
    const std::vector<VDA5050::MqttSubscription>& subscriptions,
    const std::string& topic)
{
    const auto found = std::ranges::find(subscriptions, topic, &VDA5050::MqttSubscription::topicFilter);
    return found == subscriptions.end() ? nullptr : &*found;
}

} // namespace

MqttBroker::MqttBroker(Timeline& timeline, Trace& trace, const ChanceSeed& seed, bool bFaulty)
    : _timeline(timeline),
      _trace(trace),
      _chance(seed),
      _bFaulty(bFaulty)
{
}

MqttBroker::ClientID MqttBroker::Open(
    VDA5050::IMqttLinkListener& listener,
    std::vector<VDA5050::MqttSubscription> subscriptions,
    std::optional<VDA5050::MqttWill> willOrNull)
{
    const ClientID id = ++_lastClient;
    Client& client = _clients[id];
    client.listener = &listener;
    client.subscriptions = std::move(subscriptions);
    client.nextWill = std::move(willOrNull);
    ConnectSoon(id);
    return id;
}

void MqttBroker::SetWill(ClientID id, const VDA5050::MqttWill& will)
{
    _clients.at(id).nextWill = will;
}

Core::Duration MqttBroker::GetLatency()
{
    return _chance.GetBetween(0ms, _bFaulty && _chance.IsHit(30) ? 1s : 8ms);
}

void MqttBroker::Post(Way& way, Timeline::Task task)
{
    const Core::SteadyTime now = _timeline.GetNow().steady;
    way.lastArrival = std::max(way.lastArrival, now + GetLatency());
    way.underWay.push_back(_timeline.Post(way.lastArrival - now, [&way, task = std::move(task)] {
        way.underWay.pop_front();
        task();
    }));
}

/// Drops the messages from a random one on.
void MqttBroker::Lose(Way& way)
{
    for (std::size_t lost = _chance.GetBetween(0, way.underWay.size()); lost > 0; --lost)
    {
        _timeline.Withdraw(way.underWay.back());
        way.underWay.pop_back();
    }
}

void MqttBroker::ConnectSoon(ClientID id)
{
    Client& client = _clients.at(id);
    _timeline.Post(_chance.GetBetween(1ms, _chance.IsHit(200) ? 5s : 300ms), [this, id, epoch = ++client.epoch] {
        const auto found = _clients.find(id);
        if (found != _clients.end() && found->second.epoch == epoch)
        {
            Connect(id);
        }
    });
}

void MqttBroker::Connect(ClientID id)
{
    Client& client = _clients.at(id);
    if (client.bUp || !client.bReachable || client.listener == nullptr)
    {
        return;
    }
    PublishWill(id); // the new connection ends one that the broker did not know to be broken
    client.bUp = true;
    client.will = client.nextWill;
    Post(client.toClient, [this, id] {
        Client& up = _clients.at(id);
        if (up.listener != nullptr && up.bUp)
        {
            up.bKnownUp = true;
            up.listener->OnLinkUp();
        }
    });
    for (const auto& [topic, message] : _retained)
    {
        if (FindSubscriptionOrNull(client.subscriptions, topic) != nullptr)
        {
            Deliver(id, message);
        }
    }
}

void MqttBroker::Publish(ClientID id, const VDA5050::MqttMessage& message)
{
    Client& client = _clients.at(id);
    if (!client.bUp)
    {
        return;
    }
    const bool bLost = _bFaulty && message.qos == 0 && _chance.IsHit(10);
    const bool bTwice = _bFaulty && message.qos == 1 && _chance.IsHit(10);
    for (int copies = bLost ? 0 : (bTwice ? 2 : 1); copies > 0; --copies)
    {
        Post(client.toBroker, [this, message] { Distribute(message); });
    }
}

void MqttBroker::Distribute(const VDA5050::MqttMessage& message)
{
    if (message.bRetained)
    {
        _retained[message.topic] = message;
    }
    for (const auto& [id, client] : _clients)
    {
        const VDA5050::MqttSubscription* const wishOrNull =
            client.bUp ? FindSubscriptionOrNull(client.subscriptions, message.topic) : nullptr;
        if (wishOrNull == nullptr)
        {
            continue;
        }
        VDA5050::MqttMessage copy = message;
        copy.qos = std::min(copy.qos, wishOrNull->qos);
        copy.bRetained = false; // not set on messages to existing subscriptions
        const bool bTwice = _bFaulty && copy.qos == 1 && _chance.IsHit(10);
        if (bTwice)
        {
            Deliver(id, copy);
        }
        if (!_bFaulty || copy.qos > 0 || !_chance.IsHit(10))
        {
            Deliver(id, std::move(copy));
        }
    }
}

void MqttBroker::Deliver(ClientID id, VDA5050::MqttMessage message)
{
    Post(_clients.at(id).toClient, [this, id, message = std::move(message)] {
        Client& client = _clients.at(id);
        if (client.listener != nullptr && client.bKnownUp)
        {
            client.listener->OnMqttMessage(message);
        }
    });
}

void MqttBroker::PublishWill(ClientID id)
{
    const std::optional<VDA5050::MqttWill> will = std::exchange(_clients.at(id).will, std::nullopt);
    if (will.has_value())
    {
        Distribute(will->message);
    }
}

/// Each end detects it at its own time.
void MqttBroker::Break(ClientID id)
{
    Client& client = _clients.at(id);
    if (!std::exchange(client.bUp, false))
    {
        return;
    }
    Lose(client.toBroker);
    Lose(client.toClient);
    if (!client.bKnownUp)
    {
        for (const Timeline::Ticket& ticket : std::exchange(client.toClient.underWay, {}))
        {
            _timeline.Withdraw(ticket);
        }
    }
    const Epoch epoch = ++client.epoch;
    _timeline.Post(_chance.GetBetween(1ms, 20s), [this, id, epoch] {
        const auto found = _clients.find(id);
        if (found != _clients.end() && !found->second.bUp && found->second.epoch >= epoch)
        {
            PublishWill(id);
        }
    });
    if (client.listener == nullptr)
    {
        return;
    }
    _timeline.Post(_chance.GetBetween(1ms, _chance.IsHit(200) ? 10s : 500ms), [this, id, epoch] {
        Client& down = _clients.at(id);
        if (down.epoch != epoch || down.listener == nullptr)
        {
            return;
        }
        for (const Timeline::Ticket& ticket : std::exchange(down.toClient.underWay, {}))
        {
            _timeline.Withdraw(ticket);
        }
        if (std::exchange(down.bKnownUp, false))
        {
            down.listener->OnLinkDown(std::make_error_code(std::errc::connection_reset));
        }
        if (down.listener != nullptr)
        {
            ConnectSoon(id);
        }
    });
}

void MqttBroker::Abandon(ClientID id)
{
    Client& client = _clients.at(id);
    client.listener = nullptr;
    client.bKnownUp = false;
    Break(id);
}

void MqttBroker::SetReachable(ClientID id, bool bReachable)
{
    Client& client = _clients.at(id);
    if (std::exchange(client.bReachable, bReachable) == bReachable)
    {
        return;
    }
    if (!bReachable)
    {
        Break(id);
    }
    else if (!client.bUp && !client.bKnownUp)
    {
        ConnectSoon(id); // otherwise when it has detected the end of the old connection
    }
}

bool MqttBroker::IsReachable(ClientID id) const
{
    return _clients.at(id).bReachable;
}

void MqttBroker::Cut(ClientID id)
{
    Break(id);
}

void MqttBroker::Restart()
{
    _trace.Add("the broker is restarted");
    if (_chance.IsHit(500))
    {
        _retained.clear();
    }
    for (auto& [id, client] : _clients)
    {
        Break(id);
        client.will.reset(); // the client ended before its connections
    }
}

void MqttBroker::Calm()
{
    _bFaulty = false;
}

} // namespace ACS::Simulation
