#pragma once

#include "ChanceModel.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include <acs/protocol/SessionAction.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// One end of connections that carry texts.
class ITextPeer
{
public:
    ITextPeer() = default;
    ITextPeer(const ITextPeer&) = delete;
    ITextPeer& operator=(const ITextPeer&) = delete;
    virtual ~ITextPeer() = default;

    virtual void OnOpened(Protocol::ConnectionID connection) = 0;
    virtual void OnText(Protocol::ConnectionID connection, const std::string& text) = 0;
    virtual void OnClosed(Protocol::ConnectionID connection, const std::string& reason) = 0;
};

/// Which end of a connection.
enum class ETextEnd : std::uint8_t
{
    Client,
    Server,
};

/// The names of the two ends in the trace.
struct TextNames
{
    std::string client;
    std::string server;
};

/// Connections (WebSockets, TCP) between one server and several clients. A connection keeps the order and loses nothing
/// until it breaks. Then it loses in each direction the texts in transit from some text on, and each end detects that
/// at its own time.
class TextNetwork final
{
    struct Way ///< One direction.
    {
        ITextPeer* peerOrNull = nullptr; ///< Null after it was notified of the end, or has crashed.
        Core::SteadyTime lastArrival{};
        std::deque<Timeline::Ticket> underWay;
    };

    struct Connection
    {
        std::array<Way, 2> ways;
        bool bBroken = false;
    };

    Timeline& _timeline;
    Trace& _trace;
    ChanceModel _chance;
    std::optional<TextNames> _namesOrNull;
    ITextPeer* _serverOrNull = nullptr;
    std::map<Protocol::ConnectionID, Connection> _connections;
    Protocol::ConnectionID _lastConnection = 0;
    bool _bReachable = true;
    bool _bSlow = false;

public:
    /// Without names the texts are not traced.
    TextNetwork(Timeline& timeline, Trace& trace, const ChanceSeed& seed, std::optional<TextNames> namesOrNull);

    /// Called before any client connects.
    void Listen(ITextPeer& server);

    /// OnOpened or OnClosed follows.
    Protocol::ConnectionID Connect(ITextPeer& client);
    void Send(Protocol::ConnectionID id, ETextEnd from, const std::string& text);
    /// Closes after what was sent before.
    void Close(Protocol::ConnectionID id, ETextEnd from, const std::string& reason);
    /// The end has crashed: it is not called any more, and the other one is notified.
    void Abandon(Protocol::ConnectionID id, ETextEnd end);

    /// Breaks every connection.
    void Cut();
    /// Whether connecting is possible.
    void SetReachable(bool bReachable);
    /// Texts take seconds sometimes.
    void SetSlow(bool bSlow);

private:
    [[nodiscard]] Core::Duration GetLatency();
    void Lose(Way& way);
    void NotifyClosed(Protocol::ConnectionID id, ETextEnd end, Core::Duration delay, const std::string& reason);
    void Forget(Protocol::ConnectionID id);
};

} // namespace ACS::Simulation
