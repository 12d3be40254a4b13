#pragma once

#include "Catch.hpp"
#include "ChildProcess.hpp"
#include "LinkFixture.hpp"
#include "MosquittoBroker.hpp"
#include "SchemaCheck.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <chrono>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{

constexpr std::chrono::seconds PATIENCE{20};
const std::string_view STATE_TOPIC = "uagv/v2/ACS/LR01/state";
const std::string_view CONNECTION_TOPIC = "uagv/v2/ACS/LR01/connection";

/// vda-sim on this broker, ten times as fast as real time.
inline std::vector<std::string> MakeCommand(
    const std::string& broker,
    const std::string& site,
    const std::string& vehicle)
{
    return {ACS_VDA_SIM, "--broker", broker, "--site", site, "--vehicle", vehicle, "--time-scale", "10"};
}

/// From LR01's charger down the lane; the last node's pick shows that actions run.
inline VDA5050::OrderMessage MakeOrder(std::size_t releasedNodes)
{
    const std::vector<std::pair<double, double>> places{{1.8, 14.0}, {3.0, 14.0}, {3.0, 12.0}, {3.0, 10.0}};
    const std::vector<std::string> names{"D-CHG01", "N045", "N046", "N047"};
    std::vector<VDA5050::OrderNode> nodes(names.size());
    std::vector<VDA5050::OrderEdge> edges(names.size() - 1);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        nodes[i].nodeID = names[i];
        nodes[i].nodePosition = VDA5050::NodePosition{};
        nodes[i].nodePosition->x = places[i].first;
        nodes[i].nodePosition->y = places[i].second;
        nodes[i].nodePosition->mapID = "floor-1";
    }
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        edges[i].edgeID = names[i] + "-" + names[i + 1];
        edges[i].maxSpeed = i == 0 ? 0.4 : 1.2;
        edges[i].orientation = i == 0 ? std::numbers::pi : 0.0;
    }
    VDA5050::Action pick;
    pick.actionType = "pick";
    pick.actionID = "pick-1";
    pick.blockingType = VDA5050::EBlockingType::Hard;
    pick.actionParameters = {
        {"stationType", Core::JsonText::FromString("rack")},
        {"loadType", Core::JsonText::FromString("cassette")}};
    nodes.back().actions.push_back(pick);
    auto builder = VDA5050::OrderBuilder::Create("order-1", std::move(nodes), std::move(edges));
    REQUIRE(builder.has_value());
    auto order = builder->MakeOrder(2);
    if (releasedNodes > 2)
    {
        order = builder->MakeUpdate(releasedNodes);
    }
    REQUIRE(order.has_value());
    order->header.version = "2.0.0";
    order->header.manufacturer = "ACS";
    order->header.serialNumber = "LR01";
    return std::move(*order);
}

/// A broker, and a master that receives all that vehicles publish and checks it against the schemas at the end.
class VdaSimFixture
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    VDA5050::Vda5050Codec _codec;
    std::unique_ptr<TestLink> _master;

public:
    VdaSimFixture(const VdaSimFixture&) = delete;
    VdaSimFixture& operator=(const VdaSimFixture&) = delete;

protected:
    VdaSimFixture()
    {
        _master = std::make_unique<TestLink>(_context, MakeOptions(_broker.GetPort(), "master"));
        _master->link.Subscribe({{"uagv/#", 1}});
        _master->link.Start();
        REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.ups == 1; }));
    }

    ~VdaSimFixture()
    {
        for (const VDA5050::MqttMessage& message : _master->listener.messages)
        {
            if (message.topic.starts_with("uagv/") && !message.topic.ends_with("/order"))
            {
                CheckValid(message.topic, message.payload);
            }
        }
    }

    void Send(const VDA5050::OrderMessage& order)
    {
        const std::string payload = _codec.Encode(order, VDA5050::EVda5050Version::Version200);
        REQUIRE(_master->link.Publish({"uagv/v2/ACS/LR01/order", payload, 2, false}).has_value());
    }

    [[nodiscard]] VDA5050::StateMessage GetLastState()
    {
        const VDA5050::MqttMessage* const last = _master->listener.FindLastOrNull(STATE_TOPIC);
        if (last == nullptr)
        {
            return {};
        }
        auto state = _codec.Decode<VDA5050::StateMessage>(last->payload);
        REQUIRE(state.has_value());
        return std::move(*state);
    }
};

} // namespace ACS::Testing
