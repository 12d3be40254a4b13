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

/// A broker and the network around it, as sessions see them: retained messages, wills, subscriptions by topic; within a
/// connection the order is kept. A connection that breaks loses what is under way from some message on, in each direction;
/// the client hears of it in its own time and connects again, the broker publishes the will in its own. At quality 0
/// messages get lost now and then, at quality 1 they come twice.
class MqttBroker final
{
public:
    using ClientID = std::uint64_t;

private:
    using Epoch = std::uint64_t;

    struct Way ///< To one end.
    {
        Core::SteadyTime lastArrival{};
        std::deque<Timeline::Ticket> underWay;
    };

    struct Client
    {
        VDA5050::IMqttLinkListener* listener = nullptr;
        std::vector<VDA5050::MqttSubscription> subscriptions;
        std::optional<VDA5050::MqttWill> will;     ///< Of the connection that it has, or that the broker believes in.
        std::optional<VDA5050::MqttWill> nextWill; ///< Of the next one.
        Way toBroker;
        Way toClient;
        Epoch epoch = 0; ///< Of its connections.
        bool bUp = false;
        bool bTold = false; ///< That it is up.
        bool bReachable = true;
    };

    Timeline& _timeline;
    Trace& _trace;
    ChanceModel _dice;
    std::map<ClientID, Client> _clients;
    std::map<std::string, VDA5050::MqttMessage> _retained;
    ClientID _lastClient = 0;
    bool _bFaulty;

public:
    MqttBroker(Timeline& timeline, Trace& trace, const ChanceSeed& seed, bool bFaulty);

    /// Connects, and again whenever it can, until Abandon. The listener outlives that.
    [[nodiscard]] ClientID Open(
        VDA5050::IMqttLinkListener& listener,
        std::vector<VDA5050::MqttSubscription> subscriptions,
        std::optional<VDA5050::MqttWill> willOrNull);
    void SetWill(ClientID id, const VDA5050::MqttWill& will);
    /// Lost where there is no connection.
    void Publish(ClientID id, const VDA5050::MqttMessage& message);
    /// The client has died; the broker finds out.
    void Abandon(ClientID id);

    void SetReachable(ClientID id, bool bReachable);
    [[nodiscard]] bool IsReachable(ClientID id) const;
    /// The connection breaks, and is made again.
    void Cut(ClientID id);
    /// The broker ends and begins, with its retained messages or without.
    void Restart();
    /// Nothing gets lost or comes twice from now on.
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
