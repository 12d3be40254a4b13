#include "TextNetwork.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

std::size_t GetIndex(ETextEnd end)
{
    return static_cast<std::size_t>(end);
}

ETextEnd GetOther(ETextEnd end)
{
    return end == ETextEnd::Client ? ETextEnd::Server : ETextEnd::Client;
}

} // namespace

TextNetwork::TextNetwork(Timeline& timeline, Trace& trace, const ChanceSeed& seed, std::optional<TextNames> namesOrNull)
    : _timeline(timeline),
      _trace(trace),
      _chance(seed),
      _namesOrNull(std::move(namesOrNull))
{
}

void TextNetwork::Listen(ITextPeer& server)
{
    _serverOrNull = &server;
}

Core::Duration TextNetwork::GetLatency()
{
    if (_bSlow && _chance.IsHit(100))
    {
        return _chance.GetBetween(1s, 8s);
    }
    return _chance.GetBetween(0ms, _chance.IsHit(200) ? 60ms : 4ms);
}

Protocol::ConnectionID TextNetwork::Connect(ITextPeer& client)
{
    const Protocol::ConnectionID id = ++_lastConnection;
    Connection& connection = _connections[id];
    connection.ways[GetIndex(ETextEnd::Client)].peerOrNull = &client;
    connection.ways[GetIndex(ETextEnd::Server)].peerOrNull = _serverOrNull;
    if (!_bReachable)
    {
        connection.ways[GetIndex(ETextEnd::Server)].peerOrNull = nullptr;
        connection.bBroken = true;
        NotifyClosed(id, ETextEnd::Client, _chance.GetBetween(1ms, 3s), "cannot connect");
        return id;
    }
    for (const ETextEnd end : {ETextEnd::Server, ETextEnd::Client})
    {
        Way& way = connection.ways[GetIndex(end)];
        way.lastArrival = _timeline.GetNow().steady + _chance.GetBetween(1ms, 20ms);
        way.underWay.push_back(_timeline.Post(way.lastArrival - _timeline.GetNow().steady, [this, id, end] {
            const auto found = _connections.find(id);
            if (found == _connections.end())
            {
                return;
            }
            Way& opening = found->second.ways[GetIndex(end)];
            opening.underWay.pop_front();
            if (opening.peerOrNull != nullptr)
            {
                opening.peerOrNull->OnOpened(id);
            }
        }));
    }
    return id;
}

void TextNetwork::Send(Protocol::ConnectionID id, ETextEnd from, const std::string& text)
{
    const auto found = _connections.find(id);
    if (found == _connections.end() || found->second.bBroken)
    {
        return;
    }
    const ETextEnd end = GetOther(from);
    Way& way = found->second.ways[GetIndex(end)];
    way.lastArrival = std::max(way.lastArrival, _timeline.GetNow().steady + GetLatency());
    way.underWay.push_back(_timeline.Post(way.lastArrival - _timeline.GetNow().steady, [this, id, end, text] {
        const auto place = _connections.find(id);
        if (place == _connections.end())
        {
            return;
        }
        Way& arriving = place->second.ways[GetIndex(end)];
        arriving.underWay.pop_front();
        if (arriving.peerOrNull != nullptr)
        {
            if (_namesOrNull.has_value())
            {
                const bool bToServer = end == ETextEnd::Server;
                const std::string& sender = bToServer ? _namesOrNull->client : _namesOrNull->server;
                _trace.Add("{} -> {} {}", sender, bToServer ? _namesOrNull->server : _namesOrNull->client, text);
            }
            arriving.peerOrNull->OnText(id, text);
        }
    }));
}

void TextNetwork::Close(Protocol::ConnectionID id, ETextEnd from, const std::string& reason)
{
    const auto found = _connections.find(id);
    if (found == _connections.end())
    {
        return;
    }
    const ETextEnd other = GetOther(from);
    const Core::Duration wait = found->second.ways[GetIndex(other)].lastArrival - _timeline.GetNow().steady;
    if (!found->second.bBroken)
    {
        NotifyClosed(id, other, std::max(wait, Core::Duration::zero()) + _chance.GetBetween(0ms, 5ms), reason);
    }
    found->second.bBroken = true;
    NotifyClosed(id, from, std::max(wait, Core::Duration::zero()) + _chance.GetBetween(1ms, 50ms), reason);
}

void TextNetwork::Abandon(Protocol::ConnectionID id, ETextEnd end)
{
    const auto found = _connections.find(id);
    if (found == _connections.end())
    {
        return;
    }
    found->second.ways[GetIndex(end)].peerOrNull = nullptr;
    if (!std::exchange(found->second.bBroken, true))
    {
        Lose(found->second.ways[GetIndex(GetOther(end))]);
        NotifyClosed(
            id,
            GetOther(end),
            _chance.GetBetween(1ms, _chance.IsHit(200) ? 20s : 100ms),
            "the other end is gone");
    }
}

void TextNetwork::Cut()
{
    for (auto& [id, connection] : _connections)
    {
        if (std::exchange(connection.bBroken, true))
        {
            continue;
        }
        _trace.Add("connection {} is cut", id);
        for (const ETextEnd end : {ETextEnd::Client, ETextEnd::Server})
        {
            Lose(connection.ways[GetIndex(end)]);
            NotifyClosed(id, end, _chance.GetBetween(1ms, _chance.IsHit(300) ? 20s : 200ms), "the connection was lost");
        }
    }
}

/// Drops the texts from a random one on.
void TextNetwork::Lose(Way& way)
{
    std::size_t lost = _chance.GetBetween(0, way.underWay.size());
    for (; lost > 0; --lost)
    {
        _timeline.Withdraw(way.underWay.back());
        way.underWay.pop_back();
    }
}

void TextNetwork::NotifyClosed(Protocol::ConnectionID id, ETextEnd end, Core::Duration delay, const std::string& reason)
{
    // After the texts that still arrive.
    const Way& way = _connections.at(id).ways[GetIndex(end)];
    const Core::Duration rest = way.lastArrival - _timeline.GetNow().steady;
    _timeline.Post(std::max(delay, way.underWay.empty() ? delay : rest), [this, id, end, reason] {
        const auto found = _connections.find(id);
        if (found == _connections.end())
        {
            return;
        }
        ITextPeer* const peerOrNull = std::exchange(found->second.ways[GetIndex(end)].peerOrNull, nullptr);
        Forget(id);
        if (peerOrNull != nullptr)
        {
            peerOrNull->OnClosed(id, reason);
        }
    });
}

/// Removes it once both ends have left it.
void TextNetwork::Forget(Protocol::ConnectionID id)
{
    const auto found = _connections.find(id);
    const bool bUsed =
        std::ranges::any_of(found->second.ways, [](const Way& way) { return way.peerOrNull != nullptr; });
    if (!bUsed)
    {
        _connections.erase(found);
    }
}

void TextNetwork::SetReachable(bool bReachable)
{
    _bReachable = bReachable;
}

void TextNetwork::SetSlow(bool bSlow)
{
    _bSlow = bSlow;
}

} // namespace ACS::Simulation
