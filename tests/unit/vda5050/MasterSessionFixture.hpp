#pragma once

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

[[nodiscard]] inline MasterOptions MakeMasterOptions()
{
    MasterOptions options;
    options.address = MakeAddress();
    return options;
}

/// A master session; the test writes the messages of the vehicle.
class MasterSessionFixture
{
    Testing::ManualClock _clock;
    MasterActions _out;
    std::uint32_t _headerID = 0;

public:
    MasterSession session;
    StateMessage state;

    explicit MasterSessionFixture(MasterOptions options = MakeMasterOptions())
        : session(std::move(options))
    {
        state.lastNodeID = "N0";
        session.OnLinkUp(_clock.GetNow(), _out);
    }

    MasterSessionFixture(const MasterSessionFixture&) = delete;
    MasterSessionFixture& operator=(const MasterSessionFixture&) = delete;
    MasterSessionFixture(MasterSessionFixture&&) = delete;
    MasterSessionFixture& operator=(MasterSessionFixture&&) = delete;

    ~MasterSessionFixture() // as Clear: what was published is checked against the schemas
    {
        CheckPublished(_out);
    }

    [[nodiscard]] const MasterActions& GetOutput() const
    {
        return _out;
    }

    MasterActions& Clear()
    {
        CheckPublished(_out);
        _out.clear();
        return _out;
    }

    [[nodiscard]] Core::Now GetNow() const
    {
        return _clock.GetNow();
    }

    void Connect(EConnectionState connection)
    {
        ConnectionMessage message;
        message.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
        message.connectionState = connection;
        Deliver(ETopic::Connection, Vda5050Codec().Encode(message, EVda5050Version::Version200));
    }

    void Deliver(ETopic topic, std::string_view payload)
    {
        session.OnMessage(BuildTopic(MakeAddress(), topic), payload, _clock.GetNow(), _out);
    }

    void SendState()
    {
        state.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
        Deliver(ETopic::State, Vda5050Codec().Encode(state, EVda5050Version::Version200));
    }

    void BeReady()
    {
        Connect(EConnectionState::Online);
        SendState();
        Clear();
    }

    void Wait(std::chrono::milliseconds span, EMasterTimer timer)
    {
        _clock.Advance(span);
        session.OnTimer(timer, _clock.GetNow(), _out);
    }

    /// Sets the state to that of a vehicle that has accepted the order.
    void Hold(const OrderMessage& order, std::size_t nodesLeft)
    {
        state.orderID = order.orderID;
        state.orderUpdateID = order.orderUpdateID;
        state.nodeStates.clear();
        state.edgeStates.clear();
        for (std::size_t index = order.nodes.size() - nodesLeft; index < order.nodes.size(); ++index)
        {
            const OrderNode& node = order.nodes[index];
            state.nodeStates.push_back(NodeState{node.nodeID, node.sequenceID, {}, node.bReleased, {}});
        }
        const OrderNode& last = order.nodes[order.nodes.size() - nodesLeft - 1];
        state.lastNodeID = last.nodeID;
        state.lastNodeSequenceID = last.sequenceID;
    }

    void Refuse(std::string_view errorType, const std::vector<ErrorReference>& references)
    {
        VehicleError error;
        error.errorType = errorType;
        error.errorReferences = references;
        error.errorDescription = "because";
        state.errors = {error};
        SendState();
    }

    [[nodiscard]] std::vector<MqttMessage> GetSent(ETopic topic) const
    {
        std::vector<MqttMessage> sent;
        for (const PublishMessage& publish : Pick<PublishMessage>(_out))
        {
            if (publish.message.topic == BuildTopic(MakeAddress(), topic))
            {
                sent.push_back(publish.message);
            }
        }
        return sent;
    }

    [[nodiscard]] OrderMessage GetSentOrder() const
    {
        const std::vector<MqttMessage> sent = GetSent(ETopic::Order);
        REQUIRE_FALSE(sent.empty());
        const Core::Result<OrderMessage> order = Vda5050Codec().Decode<OrderMessage>(sent.back().payload);
        REQUIRE(order.has_value());
        return *order;
    }
};

[[nodiscard]] inline std::vector<std::string> ListReached(const MasterActions& actions)
{
    std::vector<std::string> ids;
    for (const NodeReached& node : Pick<NodeReached>(actions))
    {
        ids.push_back(node.nodeID);
    }
    return ids;
}

} // namespace ACS::VDA5050::Test
