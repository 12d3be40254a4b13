#include "Catch.hpp"
#include "StateSequenceChecker.hpp"
#include "VehicleDriver.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EActionStatus;
using VDA5050::EBlockingType;
using VDA5050::StateMessage;

constexpr auto STATE_INTERVAL = 50ms;

VDA5050::Action MakeOrderAction(std::string actionID, EBlockingType blockingType, std::string_view actionType)
{
    VDA5050::Action action;
    action.actionType = std::string(actionType);
    action.actionID = std::move(actionID);
    action.blockingType = blockingType;
    return action;
}

/// An order along N0, N1 and N2: a detectObject and a finePositioning that end with the first edge, and a HARD action at N1.
VDA5050::OrderMessage MakeActionOrder(VehicleDriver& driver)
{
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2"});
    VDA5050::OrderMessage order = VehicleDriver::Take(route.MakeOrder(3));
    order.edges[0].actions = {
        MakeOrderAction("detect", EBlockingType::None, VDA5050::ActionTypes::DETECT_OBJECT),
        MakeOrderAction("position", EBlockingType::None, VDA5050::ActionTypes::FINE_POSITIONING)};
    order.nodes[1].actions.push_back(MakeOrderAction("work", EBlockingType::Hard, VDA5050::ActionTypes::DETECT_OBJECT));
    return order;
}

VdaSim::VirtualVehicleOptions MakeEventOptions(double timeScale)
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0", timeScale);
    options.actionSeconds[std::string(VDA5050::ActionTypes::DETECT_OBJECT)] = 100.0;
    options.actionSeconds[std::string(VDA5050::ActionTypes::FINE_POSITIONING)] = 100.0;
    return options;
}

std::vector<StateMessage> ListStates(const VehicleDriver& driver)
{
    std::vector<StateMessage> states;
    VDA5050::Vda5050Codec codec;
    for (const auto& [time, message] : driver.GetPublished())
    {
        if (message.topic.ends_with("/state"))
        {
            states.push_back(VehicleDriver::Take(codec.Decode<StateMessage>(message.payload)));
        }
    }
    return states;
}

EActionStatus GetStatusInState(const StateMessage& state, std::string_view actionID)
{
    const auto found = std::ranges::find(state.actionStates, actionID, &VDA5050::ActionState::actionID);
    REQUIRE(found != state.actionStates.end());
    return found->actionStatus;
}

/// A driver, and a master that acts at random. All states are checked.
class RandomMaster
{
    SeededRandom _random;
    VehicleDriver _driver;
    StateSequenceChecker _checker{STATE_INTERVAL};
    std::optional<VDA5050::OrderBuilder> _order;
    VDA5050::Vda5050Codec _codec;
    std::size_t _seen = 0; ///< Messages that are checked.
    std::uint32_t _nextID = 0;

public:
    explicit RandomMaster(std::uint64_t seed)
        : _random(seed),
          _driver(MakeRandomOptions(), seed)
    {
        Check();
    }

    void Step()
    {
        _driver.Pass(std::chrono::milliseconds(Choose(100)));
        Check();
        switch (Choose(16))
        {
            case 0:
                SendInstantAction(VDA5050::ActionTypes::CANCEL_ORDER);
                break;
            case 1:
                SendInstantAction(VDA5050::ActionTypes::START_PAUSE);
                break;
            case 2:
            case 3:
                SendInstantAction(VDA5050::ActionTypes::STOP_PAUSE);
                break;
            case 4:
                SendInstantAction(VDA5050::ActionTypes::STATE_REQUEST);
                break;
            case 5:
                _driver.Inject(Choose(2) == 0 ? "drop for=20ms" : "blocked for=100ms");
                break;
            default:
                SendOrder();
                break;
        }
        Check();
    }

    void Finish()
    {
        SendInstantAction(VDA5050::ActionTypes::STOP_PAUSE);
        _driver.Pass(20s);
        Check();
        SendInstantAction(VDA5050::ActionTypes::CANCEL_ORDER); // a base may have ended before its horizon
        _driver.Pass(20s);
        Check();
        _checker.CheckComplete(_driver.GetState());
        _checker.CheckEnded();
    }

    [[nodiscard]] const StateSequenceChecker& GetChecker() const
    {
        return _checker;
    }

private:
    [[nodiscard]] static VdaSim::VirtualVehicleOptions MakeRandomOptions()
    {
        VdaSim::VirtualVehicleOptions options = MakeEventOptions(10.0);
        options.actionSeconds[std::string(VDA5050::ActionTypes::DETECT_OBJECT)] = 0.7;
        options.actionSeconds[std::string(VDA5050::ActionTypes::FINE_POSITIONING)] = 4.0;
        return options;
    }

    [[nodiscard]] std::uint32_t Choose(std::uint32_t count)
    {
        return static_cast<std::uint32_t>(_random.GetNext() % count);
    }

    void Check()
    {
        for (; _seen < _driver.GetPublished().size(); ++_seen)
        {
            const auto& [time, message] = _driver.GetPublished()[_seen];
            if (message.topic.ends_with("/state"))
            {
                _checker.Check(VehicleDriver::Take(_codec.Decode<StateMessage>(message.payload)), time);
            }
        }
    }

    void AddActions(std::vector<VDA5050::Action>& actions)
    {
        const std::uint32_t count = Choose(3);
        for (std::uint32_t index = 0; index < count; ++index)
        {
            const std::string_view actionType =
                Choose(2) == 0 ? VDA5050::ActionTypes::DETECT_OBJECT : VDA5050::ActionTypes::FINE_POSITIONING;
            const auto blockingType = static_cast<EBlockingType>(Choose(3));
            actions.push_back(MakeOrderAction("a" + std::to_string(_nextID++), blockingType, actionType));
        }
    }

    void SendOrder()
    {
        const StateMessage state = _driver.GetState();
        const bool bOpen = std::ranges::any_of(state.actionStates, [](const VDA5050::ActionState& action) {
            return !VDA5050::IsTerminal(action.actionStatus);
        });
        if (!state.nodeStates.empty() && _order.has_value() && !_order->IsWholeRouteReleased())
        {
            const auto left = static_cast<std::uint32_t>(_order->GetNodes().size() - _order->GetReleasedNodes());
            Send(VehicleDriver::Take(_order->MakeUpdate(_order->GetReleasedNodes() + 1 + Choose(left))));
        }
        else if (state.nodeStates.empty() && !bOpen)
        {
            SendNewOrder(state.lastNodeID);
        }
    }

    void SendNewOrder(std::string nodeID)
    {
        constexpr std::uint32_t MAXIMUM_LEGS = 5;
        std::vector<std::string> route{std::move(nodeID)};
        const std::uint32_t legs = Choose(MAXIMUM_LEGS + 1);
        for (std::uint32_t leg = 0; leg < legs; ++leg)
        {
            const std::string& last = route.back();
            const bool bToN2 = last == "N1" || last == "DOCK";
            route.emplace_back(last == "N0" ? "N1" : bToN2 ? "N2" : "DOCK");
        }
        std::string orderID = "order-" + std::to_string(_nextID++);
        const VDA5050::OrderMessage plain =
            VehicleDriver::Take(_driver.MakeRoute(orderID, route).MakeOrder(route.size()));
        std::vector<VDA5050::OrderNode> nodes = plain.nodes;
        std::vector<VDA5050::OrderEdge> edges = plain.edges;
        std::ranges::for_each(nodes, [this](VDA5050::OrderNode& node) { AddActions(node.actions); });
        std::ranges::for_each(edges, [this](VDA5050::OrderEdge& edge) { AddActions(edge.actions); });
        _order =
            VehicleDriver::Take(VDA5050::OrderBuilder::Create(std::move(orderID), std::move(nodes), std::move(edges)));
        Send(VehicleDriver::Take(_order->MakeOrder(1 + Choose(legs + 1))));
    }

    /// Up to the present time, so that the next message is the only cause of the states that follow.
    void CatchUp()
    {
        _driver.NoteWorldChanged();
        Check();
    }

    void Send(const VDA5050::OrderMessage& order)
    {
        CatchUp();
        _driver.Send(order);
        const StateMessage state = _driver.GetState();
        if (state.orderID == order.orderID && state.orderUpdateID == order.orderUpdateID)
        {
            _checker.AddOrder(order);
        }
    }

    void SendInstantAction(std::string_view actionType)
    {
        const std::string actionID = "i" + std::to_string(_nextID++);
        CatchUp();
        _checker.AddInstantAction(actionID);
        if (actionType == VDA5050::ActionTypes::CANCEL_ORDER && !_driver.GetState().nodeStates.empty())
        {
            _checker.AddCancel(actionID);
        }
        _driver.SendInstantly(actionType, actionID);
        Check();
    }
};

} // namespace

TEST_CASE("6.10.2 Arrival for a HARD action, standstill and the end of the edge's actions are one state")
{
    VehicleDriver driver(MakeEventOptions(1.0));
    driver.Send(MakeActionOrder(driver));
    REQUIRE(driver.TryPassUntil([&driver]() { return driver.GetStatus("work") == EActionStatus::Running; }, 60s));
    driver.Pass(1s);
    const std::vector<StateMessage> states = ListStates(driver);
    const auto arrival = std::ranges::find(states, "N1", &StateMessage::lastNodeID);
    REQUIRE(arrival != states.end());
    CHECK_FALSE(arrival->bDriving);
    CHECK(arrival->edgeStates.size() == 1);
    CHECK(GetStatusInState(*arrival, "detect") == EActionStatus::Finished);
    CHECK(GetStatusInState(*arrival, "position") == EActionStatus::Failed);
    CHECK(driver.GetStatus("work") == EActionStatus::Running);
}

TEST_CASE("6.6.3 The first state without nodes after a cancel shows cancelOrder FINISHED and a stationary vehicle")
{
    VehicleDriver driver(MakeEventOptions(1.0));
    driver.Send(MakeActionOrder(driver));
    driver.Pass(4s);
    driver.SendInstantly(VDA5050::ActionTypes::CANCEL_ORDER, "cancel");
    driver.Pass(30s);
    bool bEnded = false;
    for (const StateMessage& state : ListStates(driver))
    {
        if (!state.orderID.empty() && state.nodeStates.empty())
        {
            CHECK(GetStatusInState(state, "cancel") == EActionStatus::Finished);
            CHECK_FALSE(state.bDriving);
            CHECK(state.lastNodeID == "N1");
            bEnded = true;
        }
    }
    CHECK(bEnded);
}

TEST_CASE("6.10 States keep their minimum interval when a vehicle reconnects at once")
{
    VehicleDriver driver("N0");
    driver.Pass(10s);
    driver.SendInstantly(VDA5050::ActionTypes::STATE_REQUEST, "request");
    driver.Inject("drop for=10ms");
    driver.Pass(1s);
    CHECK(driver.IsConnected());
    const std::vector<Core::SteadyTime> times = driver.GetTimes(VDA5050::ETopic::State);
    REQUIRE(times.size() == 3);
    CHECK(times[2] - times[1] >= STATE_INTERVAL);
}

TEST_CASE("6.10 In 10000 states of random orders and cancels each event is in one state and nothing is lost")
{
    constexpr std::size_t STATES = 10'000;
    constexpr int STEPS = 400;
    std::size_t count = 0;
    std::size_t stops = 0;
    std::size_t cancels = 0;
    for (std::uint64_t seed = 1; count < STATES; ++seed)
    {
        CAPTURE(seed);
        RandomMaster master(seed);
        for (int step = 0; step < STEPS; ++step)
        {
            master.Step();
        }
        master.Finish();
        REQUIRE(master.GetChecker().GetFaults() == std::vector<std::string>{});
        count += master.GetChecker().GetCount();
        stops += master.GetChecker().CountStops();
        cancels += master.GetChecker().CountCancels();
    }
    INFO(stops << " stops, " << cancels << " cancels");
    CHECK(stops > STATES / 50);
    CHECK(cancels > STATES / 50);
}

} // namespace ACS::Testing
