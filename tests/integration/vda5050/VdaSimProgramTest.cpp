#include "Catch.hpp"
#include "ChildProcess.hpp"
#include "LinkFixture.hpp"
#include "MosquittoBroker.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <chrono>
#include <csignal>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EVda5050Version;

constexpr std::chrono::seconds PATIENCE{20};
const std::string_view STATE_TOPIC = "uagv/v2/ACS/LR01/state";
const std::string_view CONNECTION_TOPIC = "uagv/v2/ACS/LR01/connection";

std::vector<std::string> MakeCommand(const std::string& broker, const std::string& site, const std::string& vehicle)
{
    return {ACS_VDA_SIM, "--broker", broker, "--site", site, "--vehicle", vehicle, "--time-scale", "10"};
}

/// From LR01's charger down the lane; the last node's pick shows that actions run.
VDA5050::OrderMessage MakeOrder(std::size_t releasedNodes)
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

class ProgramTest
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    VDA5050::Vda5050Codec _codec;
    std::unique_ptr<TestLink> _master;

    ProgramTest()
    {
        _master = std::make_unique<TestLink>(_context, MakeOptions(_broker.GetPort(), "master"));
        _master->link.Subscribe({{"uagv/#", 1}});
        _master->link.Start();
        REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.ups == 1; }));
    }

    void Send(const VDA5050::OrderMessage& order)
    {
        const std::string payload = _codec.Encode(order, EVda5050Version::Version200);
        REQUIRE(_master->link.Publish({"uagv/v2/ACS/LR01/order", payload, 2, false}).has_value());
    }

    [[nodiscard]] VDA5050::StateMessage GetLastState()
    {
        VDA5050::StateMessage last;
        for (const VDA5050::MqttMessage& message : _master->listener.messages)
        {
            if (message.topic == STATE_TOPIC)
            {
                auto state = _codec.Decode<VDA5050::StateMessage>(message.payload);
                REQUIRE(state.has_value());
                last = std::move(*state);
            }
        }
        return last;
    }
};

} // namespace

TEST_CASE_METHOD(ProgramTest, "vda-sim: online, an order with an update and an action to its end, offline")
{
    ChildProcess program(MakeCommand(_broker.GetUrl(), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("ready: broker=127.0.0.1:" + std::to_string(_broker.GetPort()) + "\n", PATIENCE));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "ONLINE"); }));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.CountTopic(STATE_TOPIC) > 0; }));
    CHECK(GetLastState().lastNodeID == "D-CHG01");
    CHECK(GetLastState().agvPosition->x == Approx(1.8));

    Send(MakeOrder(2));
    REQUIRE(TryRunUntil(_context, [this]() { return GetLastState().lastNodeID == "N045"; }));
    REQUIRE(TryRunUntil(_context, [this]() { return !GetLastState().bDriving; }));
    CHECK(GetLastState().nodeStates.size() == 2);
    Send(MakeOrder(4));
    REQUIRE(TryRunUntil(_context, [this]() {
        const VDA5050::StateMessage state = GetLastState();
        return state.nodeStates.empty() && !state.actionStates.empty()
            && state.actionStates[0].actionStatus == VDA5050::EActionStatus::Finished;
    }));
    CHECK(GetLastState().orderUpdateID == 1);
    CHECK(GetLastState().agvPosition->y == Approx(10.0));
    CHECK(GetLastState().loads->size() == 1);
    CHECK(_master->listener.CountTopic("uagv/v2/ACS/LR01/visualization") > 0);

    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "OFFLINE"); }));
    TestLink late(_context, MakeOptions(_broker.GetPort(), "late"));
    late.link.Subscribe({{std::string(CONNECTION_TOPIC), 1}});
    late.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return !late.listener.messages.empty(); }));
    CHECK(late.listener.messages.front().bRetained);
    CHECK_THAT(late.listener.messages.front().payload, Catch::Contains("OFFLINE"));
}

TEST_CASE_METHOD(ProgramTest, "vda-sim: one that is killed is reported as broken by the broker")
{
    ChildProcess program(MakeCommand(_broker.GetUrl(), ACS_SITE_FILE, "LR01"));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "ONLINE"); }));
    program.Signal(SIGKILL);
    REQUIRE(
        TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "CONNECTIONBROKEN"); }));
}

TEST_CASE_METHOD(ProgramTest, "vda-sim: waits for its broker and says so, and comes online when it is there")
{
    _broker.Kill();
    ChildProcess program(MakeCommand(_broker.GetUrl(), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("cannot reach the MQTT broker at 127.0.0.1:", PATIENCE));
    CHECK(program.GetText().find("ready:") == std::string::npos);
    _broker.Restart();
    CHECK(program.TryWaitForText("ready: broker=", PATIENCE));
    program.Signal(SIGINT);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE("vda-sim: ends with 0 also while its broker is not there")
{
    ChildProcess program(MakeCommand("mqtt://127.0.0.1:" + std::to_string(FindFreePort()), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("cannot reach the MQTT broker", PATIENCE));
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE("vda-sim: what it cannot use is one line with the thing's name, and exit code 2")
{
    const std::string broker = "mqtt://127.0.0.1:1883";
    std::vector<std::string> unknownOption = MakeCommand(broker, ACS_SITE_FILE, "LR01");
    unknownOption.insert(unknownOption.end(), {"--colour", "red"});
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
        {MakeCommand(broker, ACS_SITE_FILE, "LR01,node=NOWHERE"), "NOWHERE"},
        {MakeCommand(broker, ACS_SITE_FILE, "LR01,type=XX"), "XX"},
        {MakeCommand(broker, "/etc/hostname", "LR01"), "/etc/hostname"},
        {MakeCommand(broker, "/nonexistent", "LR01"), "/nonexistent"},
        {MakeCommand("http://127.0.0.1", ACS_SITE_FILE, "LR01"), "http://127.0.0.1"},
        {unknownOption, "--colour"}};
    for (const auto& [command, name] : mistakes)
    {
        CAPTURE(name);
        ChildProcess program(command);
        CHECK(program.WaitForExitOrNull(PATIENCE) == 2);
        CHECK_THAT(program.GetText(), Catch::Contains(name));
        CHECK(std::ranges::count(program.GetText(), '\n') == 1);
    }
}

} // namespace ACS::Testing
