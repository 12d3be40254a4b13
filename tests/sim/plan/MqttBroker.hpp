#pragma once

#include "ChanceModel.hpp"
#include "Timeline.hpp"
#include "Trace.hpp"
#include <acs/vda5050/IMqttLink.hpp>

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Simulation
{

/// A broker and its network as sessions see them: retained messages, wills, subscriptions by topic. A connection keeps
/// the order until it breaks. Then it loses in each direction the messages in transit from some message on; the client
/// detects that at its own time and connects again, the broker publishes the will at its own time. At QoS 0 messages
/// are lost sometimes, at QoS 1 repeated.
class MqttBroker final
{
public:
    using ClientID = std::uint64_t;

private:
    using Epoch = std::uint64_t;

    struct Way ///< One direction.
    {
        Core::SteadyTime lastArrival{};
        std::deque<Timeline::Ticket> underWay;
    };

    struct Client
    {
        VDA5050::IMqttLinkListener* listener = nullptr;
        std::vector<VDA5050::MqttSubscription> subscriptions;
        std::optional<VDA5050::MqttWill> will;     ///< Of the connection that the broker knows.
        std::optional<VDA5050::MqttWill> nextWill; ///< Of the next connection.
        Way toBroker;
        Way toClient;
        Epoch epoch = 0; ///< Number of its connection.
        bool bUp = false;
        bool bKnownUp = false; ///< The client knows that it is connected.
        bool bReachable = true;
    };

    Timeline& _timeline;
    Trace& _trace;
    ChanceModel _chance;
    std::map<ClientID, Client> _clients;
    std::map<std::string, VDA5050::MqttMessage> _retained;
    ClientID _lastClient = 0;
    bool _bFaulty;

public:
    MqttBroker(Timeline& timeline, Trace& trace, const ChanceSeed& seed, bool bFaulty);

    /// Connects, and reconnects, until Abandon. The listener outlives that.
    [[nodiscard]] ClientID Open(
        VDA5050::IMqttLinkListener& listener,
        std::vector<VDA5050::MqttSubscription> subscriptions,
        std::optional<VDA5050::MqttWill> willOrNull);
    void SetWill(ClientID id, const VDA5050::MqttWill& will);
    /// Dropped without a connection.
    void Publish(ClientID id, const VDA5050::MqttMessage& message);
    /// The client has crashed; the broker detects it later.
    void Abandon(ClientID id);

    void SetReachable(ClientID id, bool bReachable);
    [[nodiscard]] bool IsReachable(ClientID id) const;
    /// Breaks the connection, which is then made again.
    void Cut(ClientID id);
    /// Restarts the broker, with or without its retained messages.
    void Restart();
    /// From now on nothing is lost or repeated.
    void Calm();

private:
    [[nodiscard]] Core::Duration GetLatency();
    void Post(Way& way, Timeline::Task task);
    void Lose(Way& way);
    void ConnectSoon(ClientID id);
    void Connect(ClientID id);
    void Break(ClientID id);
    void PublishWill(ClientID id);
    void Distribute(const VDA5050::MqttMessage& message);
    void Deliver(ClientID id, VDA5050::MqttMessage message);
};

} // namespace ACS::Simulation
