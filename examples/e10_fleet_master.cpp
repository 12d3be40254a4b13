// Lesson 10: master control for a whole fleet in one file, over a real MQTT broker, that survives kill -9. It discovers
// the vehicles by their connection messages, gives each its orders one after the other, releases the route as the
// vehicle drives, and follows every action to its end.
//
//     mosquitto -p 1883
//     vda-sim --broker mqtt://127.0.0.1:1883 --site examples/site/site.lif.json --vehicle LR01
//     e10_fleet_master 127.0.0.1 1883 fleet.journal < commands
//
// A command is one line: what, for whom, and for an order its JSON (an order message of VDA5050 with its whole route):
//
//     order ACS/LR01 {"headerId":0,"orderId":"order-1",...}
//     cancel ACS/LR01
//     do ACS/LR01 startPause
//
// An order is "taken" once it is in the journal: from then on it is carried out, whatever becomes of this program.
// One that was not yet taken when the program died is given again; an id that is in the journal is not taken twice.
// After the last command the program ends when all orders have ended. What waits for the vehicle is the MasterSession's
// business: nothing here sends a message a second time. The journal only grows: delete it when no order is open.

#include "ExampleBroker.hpp"
#include "ExampleLines.hpp"
#include "ExampleRandom.hpp"
#include "FleetOrders.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>
#include <vector>

using namespace ACS;          // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::size_t NODES_AHEAD = 2; ///< Number of released nodes ahead of the vehicle.

Core::Now ReadClock()
{
    return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

class FleetMaster final : public IMqttLinkListener
{
    boost::asio::io_context& _io;
    FleetOrders _orders;
    MasterFleet _fleet; ///< Numbers the vehicles; the orders know them by their names.
    std::map<std::size_t, std::vector<std::string>>
        _actions; ///< Instant actions that wait for the vehicle to be ready.
    std::map<std::pair<std::size_t, EMasterTimer>, boost::asio::steady_timer> _timers;
    bool _bInputEnded = false;
    bool _bStopping = false;

public:
    std::unique_ptr<MosquittoLink> link;
    int exitCode = 0; ///< Of the program.

    explicit FleetMaster(boost::asio::io_context& io)
        : _io(io),
          _fleet(FleetOptions{})
    {
        // An order that the journal does not remember must not be sent.
        _orders.onBroken = [this](const std::string& reason) {
            fmt::print("cannot write the journal: {}\n", reason);
            exitCode = 1;
            Stop();
        };
    }

    /// False where the journal cannot be read and written.
    [[nodiscard]] bool TryStart(const std::string& journal)
    {
        if (!_orders.TryOpen(journal))
        {
            return false;
        }
        for (const std::string& name : _orders.ListVehicles())
        {
            std::ignore = FindVehicleOrNull(name);
        }
        link->Subscribe(_fleet.GetSubscriptions());
        link->Start();
        return true;
    }

    void OnCommand(const std::string& line)
    {
        const FleetLine command = FleetLine::Split(line);
        const std::optional<std::size_t> number = FindVehicleOrNull(command.vehicle);
        if (!number.has_value())
        {
            fmt::print("refused: '{}' names no vehicle as MANUFACTURER/SERIALNUMBER\n", line);
            return;
        }
        if (command.verb == "order")
        {
            TakeOrder(command.vehicle, command.text);
        }
        else if (command.verb == "cancel" && _orders.GetFirstOrNull(command.vehicle) != nullptr)
        {
            std::ignore = _orders.TryAskCancel(command.vehicle);
        }
        else if (command.verb == "do" && !command.text.empty())
        {
            _actions[*number].push_back(command.text);
        }
        else
        {
            fmt::print("refused: '{}' is no command, or there is nothing to cancel\n", line);
        }
        FleetActions out;
        Advance(*number, out);
        Settle(std::move(out));
    }

    void OnInputEnded()
    {
        _bInputEnded = true;
        StopWhenDone();
    }

    void Stop()
    {
        if (!std::exchange(_bStopping, true))
        {
            link->StopAsync(std::nullopt, MosquittoLink::DEFAULT_STOP_TIMEOUT, [this]() { _io.stop(); });
        }
    }

    void OnLinkUp() override
    {
        FleetActions out;
        _fleet.OnLinkUp(ReadClock(), out);
        Settle(std::move(out));
        fmt::print("connected\n");
    }

    void OnLinkDown(std::error_code reason) override
    {
        FleetActions out;
        _fleet.OnLinkDown(ReadClock(), out);
        Settle(std::move(out));
        fmt::print("no broker: {}\n", reason.message());
    }

    void OnMqttMessage(const MqttMessage& message) override
    {
        FleetActions out;
        const std::uint64_t leftOut = _fleet.GetLeftOutCount();
        _fleet.OnMessage(message, ReadClock(), out);
        if (_fleet.GetLeftOutCount() != leftOut)
        {
            const LeftOutMessage& last = *_fleet.GetLastLeftOutOrNull();
            fmt::print("left out: {}: {}\n", last.topic, Core::Describe(last.reason));
        }
        Settle(std::move(out));
    }

private:
    // ---- commands

    [[nodiscard]] std::optional<std::size_t> FindVehicleOrNull(const std::string& name)
    {
        const std::size_t slash = std::min(name.find('/'), name.size());
        VehicleAddress address;
        address.manufacturer = name.substr(0, slash);
        address.serialNumber = name.substr(std::min(slash + 1, name.size()));
        FleetActions out; // Stays empty: there are no actions for a vehicle without messages.
        const Core::Result<std::size_t> number = _fleet.Add(address, ReadClock(), out);
        return number ? std::optional(*number) : std::nullopt;
    }

    [[nodiscard]] std::string GetName(std::size_t number) const
    {
        const VehicleAddress& address = _fleet.GetSession(number).GetOptions().address;
        return address.manufacturer + "/" + address.serialNumber;
    }

    void TakeOrder(const std::string& name, const std::string& text)
    {
        const Core::Result<FleetOrders::Taking> taking = _orders.Take(name, text);
        if (!taking)
        {
            fmt::print("refused: an order for {}: {}\n", name, Core::Describe(taking.error()));
        }
        else if (taking->result != FleetOrders::ETaking::Broken)
        {
            const bool bTaken = taking->result == FleetOrders::ETaking::Taken;
            fmt::print("{}: {} for {}\n", bTaken ? "taken" : "known", taking->orderID, name);
        }
    }

    // ---- what is to be done for a vehicle, after each thing that happened

    void Advance(std::size_t number, FleetActions& out)
    {
        MasterSession& session = _fleet.GetSession(number);
        MasterActions actions;
        if (session.IsReady() && !_bStopping)
        {
            for (const std::string& type : std::exchange(_actions[number], {}))
            {
                Action action;
                action.actionType = type;
                const Core::Result<std::string> sent = session.SendInstantAction(action, ReadClock(), actions);
                fmt::print("{}: {} {}\n", GetName(number), type, sent ? "is " + *sent : Core::Describe(sent.error()));
            }
            if (FleetOrder* const orderOrNull = _orders.GetFirstOrNull(GetName(number)))
            {
                AdvanceOrder(GetName(number), session, *orderOrNull, actions);
            }
        }
        AppendActions(number, actions, out);
    }

    void AdvanceOrder(const std::string& name, MasterSession& session, FleetOrder& order, MasterActions& out)
    {
        const EOrderPhase phase = session.GetOrderPhase();
        const bool bRuns = phase == EOrderPhase::Sent || phase == EOrderPhase::Active;
        Core::Result<void> done;
        const bool bShown = session.GetStateOrNull()->orderID == order.route.GetOrderID();
        const bool bUnknown = !bShown && !order.record.acceptedUpdateID.has_value();
        if (!order.bGiven && bUnknown && order.bCancelAsked)
        {
            out.emplace_back(OrderCancelled{order.route.GetOrderID()}); // The vehicle never had it.
        }
        else if (!order.bGiven && !order.record.messages.empty())
        {
            done = session.ResumeOrder(order.record, ReadClock(), out);
            order.bGiven = done.has_value();
        }
        else if (!order.bGiven && session.CanTakeOrder())
        {
            done = Begin(name, session, order, out);
        }
        else if (order.bGiven && bRuns && order.bCancelAsked)
        {
            done = session.Cancel(ReadClock(), out);
        }
        else if (order.bGiven && phase == EOrderPhase::Active)
        {
            done = Extend(name, session, order, out);
        }
        if (done || done.error().code == EVda5050Error::VehicleNotReady)
        {
            return;
        }
        fmt::print("{}: {}\n", name, Core::Describe(done.error()));
        if (bRuns)
        {
            std::ignore = _orders.TryAskCancel(name); // An update that the vehicle cannot be sent.
        }
        else
        {
            out.emplace_back(OrderLost{order.route.GetOrderID(), "it cannot be sent"});
        }
    }

    [[nodiscard]] Core::Result<void> Begin(
        const std::string& name,
        MasterSession& session,
        FleetOrder& order,
        MasterActions& out)
    {
        if (!_orders.TryRelease(name, std::min(NODES_AHEAD, order.route.GetNodes().size())))
        {
            return {};
        }
        order.bGiven = true;
        return session.SendOrder(order.record.messages.back(), ReadClock(), out);
    }

    /// Only behind what the vehicle has shown: so never more than one message waits for an answer.
    [[nodiscard]] Core::Result<void> Extend(
        const std::string& name,
        MasterSession& session,
        FleetOrder& order,
        MasterActions& out)
    {
        const std::size_t nodes = std::min(order.reached + NODES_AHEAD, order.route.GetNodes().size());
        const bool bShown = order.record.acceptedUpdateID >= order.record.messages.back().orderUpdateID;
        if (!bShown || nodes <= order.route.GetReleasedNodes() || !_orders.TryRelease(name, nodes))
        {
            return {};
        }
        return session.SendOrderUpdate(order.record.messages.back(), ReadClock(), out);
    }

    // ---- actions and events of the sessions

    /// What is done for one action may lead to others, of the same vehicle.
    void Settle(FleetActions actions)
    {
        while (!actions.empty())
        {
            std::set<std::size_t> touched;
            for (const FleetAction& action : actions)
            {
                Execute(action.vehicle, action.action);
                touched.insert(action.vehicle);
            }
            actions.clear();
            for (const std::size_t number : touched)
            {
                Advance(number, actions);
            }
        }
        StopWhenDone();
    }

    void StopWhenDone()
    {
        const bool bIdle = _orders.IsEmpty()
            && std::ranges::all_of(_actions, [](const auto& vehicle) { return vehicle.second.empty(); });
        if (_bInputEnded && bIdle && !_bStopping)
        {
            fmt::print("all orders have ended\n");
            Stop();
        }
    }

    void StartTimer(std::size_t number, const StartMasterTimer& start)
    {
        const EMasterTimer name = start.timer;
        boost::asio::steady_timer& timer = _timers.try_emplace({number, name}, _io).first->second;
        timer.expires_after(start.delay);
        timer.async_wait([this, number, name](const boost::system::error_code& error) {
            if (!error)
            {
                FleetActions out;
                _fleet.OnTimer(number, name, ReadClock(), out);
                Settle(std::move(out));
            }
        });
    }

    void EndOrder(std::size_t number, const std::string& orderID, std::string_view how)
    {
        const std::string name = GetName(number);
        const FleetOrder* const orderOrNull = _orders.GetFirstOrNull(name);
        if (orderOrNull != nullptr && orderOrNull->route.GetOrderID() == orderID && _orders.TryEnd(name))
        {
            fmt::print("{}: {} {}\n", name, orderID, how);
        }
    }

    void OnAccepted(std::size_t number, const OrderAccepted& accepted)
    {
        const std::string name = GetName(number);
        if (_orders.GetFirstOrNull(name) != nullptr && _orders.TryAccept(name, accepted.orderUpdateID))
        {
            fmt::print("{}: {} update {} accepted\n", name, accepted.orderID, accepted.orderUpdateID);
        }
    }

    void OnRejected(std::size_t number, const OrderRejected& rejected)
    {
        const std::string name = GetName(number);
        fmt::print(
            "{}: {} update {} rejected: {} {}\n",
            name,
            rejected.orderID,
            rejected.orderUpdateID,
            rejected.errorType,
            rejected.reason);
        if (rejected.orderUpdateID == 0)
        {
            EndOrder(number, rejected.orderID, "rejected");
        }
        else if (_orders.GetFirstOrNull(name) != nullptr && _orders.TryReject(name, rejected.orderUpdateID))
        {
            std::ignore = _orders.TryAskCancel(name); // Its route cannot be driven to the end.
        }
    }

    void OnLost(std::size_t number, const OrderLost& lost)
    {
        // A master that was killed in the middle of a cancel finds the order cleared.
        const FleetOrder* const orderOrNull = _orders.GetFirstOrNull(GetName(number));
        const bool bCancelled = orderOrNull != nullptr && orderOrNull->bCancelAsked;
        EndOrder(number, lost.orderID, bCancelled ? "cancelled" : "lost: " + lost.reason);
    }

    void OnCancelFailed(std::size_t number, const CancelFailed& failed)
    {
        fmt::print("{}: {} is not cancelled: {}\n", GetName(number), failed.orderID, failed.reason);
        const FleetOrder* const orderOrNull = _orders.GetFirstOrNull(GetName(number));
        if (orderOrNull != nullptr && orderOrNull->bCancelAsked)
        {
            std::ignore = _orders.TryForgetCancel(GetName(number));
        }
    }

    void OnReached(std::size_t number, const NodeReached& node)
    {
        if (FleetOrder* const orderOrNull = _orders.GetFirstOrNull(GetName(number)))
        {
            ++orderOrNull->reached;
        }
        fmt::print("{}: node {} reached\n", GetName(number), node.nodeID);
    }

    void Execute(std::size_t number, const MasterAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) {
                    std::ignore = link->Publish(publish.message); // The session sends again what gets lost.
                },
                [&](const StartMasterTimer& start) { StartTimer(number, start); },
                [&](const CancelMasterTimer& cancel) {
                    _timers.erase({number, cancel.timer});
                },
                [&](const OrderAccepted& accepted) { OnAccepted(number, accepted); },
                [&](const OrderRejected& rejected) { OnRejected(number, rejected); },
                [&](const OrderFinished& order) { EndOrder(number, order.orderID, "finished"); },
                [&](const OrderCancelled& order) { EndOrder(number, order.orderID, "cancelled"); },
                [&](const OrderLost& lost) { OnLost(number, lost); },
                [&](const CancelFailed& failed) { OnCancelFailed(number, failed); },
                [&](const NodeReached& node) { OnReached(number, node); },
                [&](const auto& other) {
                    Tell(number, other);
                }},
            action);
    }

    void Tell(std::size_t number, const ActionChanged& changed) const
    {
        const bool bEnded = changed.status == EActionStatus::Finished || changed.status == EActionStatus::Failed;
        if (bEnded)
        {
            const char* const how = changed.status == EActionStatus::Finished ? "finished" : "failed";
            fmt::print("{}: action {} {}\n", GetName(number), changed.actionID, how);
        }
    }

    void Tell(std::size_t number, const ActionLost& lost) const
    {
        fmt::print("{}: action {} lost: {}\n", GetName(number), lost.actionID, lost.reason);
    }

    void Tell(std::size_t number, const InstantActionRejected& rejected) const
    {
        fmt::print("{}: action {} rejected: {}\n", GetName(number), rejected.actionID, rejected.errorType);
    }

    void Tell(std::size_t number, const VehicleOnline& /*online*/) const
    {
        fmt::print("{}: online\n", GetName(number));
    }

    void Tell(std::size_t number, const VehicleOffline& /*offline*/) const
    {
        fmt::print("{}: offline\n", GetName(number));
    }

    void Tell(std::size_t number, const VehicleBroken& /*broken*/) const
    {
        fmt::print("{}: connection broken\n", GetName(number));
    }

    void Tell(std::size_t number, const VehicleSilent& silent) const
    {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(silent.age).count();
        fmt::print("{}: silent for {} s\n", GetName(number), seconds);
    }

    void Tell(std::size_t number, const VehicleErrorChanged& changed) const
    {
        const char* const what = changed.bActive ? "error" : "no more error";
        fmt::print("{}: {} {}\n", GetName(number), what, changed.error.errorType);
    }

    void Tell(std::size_t number, const MessageRefused& refused) const
    {
        fmt::print(
            "{}: unusable {}: {}\n",
            GetName(number),
            GetTopicName(refused.topic),
            Core::Describe(refused.error));
    }

    template <typename TOther>
    void Tell(std::size_t /*number*/, const TOther& /*other*/) const
    {
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    std::optional<MosquittoOptions> brokerOrNull =
        argc == 4 ? ReadBrokerOrNull(arguments[1], arguments[2]) : std::nullopt;
    if (!brokerOrNull.has_value())
    {
        fmt::print("Usage: e10_fleet_master HOST PORT JOURNAL < COMMANDS\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    brokerOrNull->clientID = fmt::format("fleet-master-{}", ::getpid());
    boost::asio::io_context io;
    ExampleRandom random;
    FleetMaster master(io);
    master.link = std::make_unique<MosquittoLink>(io.get_executor(), random, Core::Logger(), *brokerOrNull, master);
    if (!master.TryStart(arguments[3]))
    {
        fmt::print("cannot use {} as journal: {}\n", arguments[3], std::generic_category().message(errno));
        return 2;
    }
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&master](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            master.Stop();
        }
    });
    const ExampleLines commands(
        io,
        [&master](const std::string& line) { master.OnCommand(line); },
        [&master]() { master.OnInputEnded(); });
    io.run();
    return master.exitCode;
}
