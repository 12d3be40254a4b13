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
// An order is "taken" once it stands in the journal: from then on it is carried out, whatever becomes of this program.
// One that was not yet taken when the program died is given again; an id that is in the journal is not taken twice.
// After the last command the program ends when all orders have ended. What waits for the vehicle is the MasterSession's
// business: nothing here sends a message a second time. The journal only grows: delete it when no order is open.

#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <fcntl.h>
#include <fstream>
#include <iostream>
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

constexpr std::size_t NODES_AHEAD = 2; ///< So many nodes are released before the vehicle.

Core::Now ReadClock()
{
    return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

/// Lines that are on the disk when Append returns. The last one may be torn by a kill: it counts as never written.
class Journal
{
    int _file = -1;

public:
    Journal() = default;
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    ~Journal()
    {
        ::close(_file);
    }

    /// The lines that were there; nothing where the file cannot be used.
    [[nodiscard]] std::optional<std::vector<std::string>> OpenOrNull(const std::string& path)
    {
        std::vector<std::string> lines;
        off_t wholeBytes = 0;
        std::ifstream old(path);
        for (std::string line; std::getline(old, line) && !old.eof();)
        {
            wholeBytes += static_cast<off_t>(line.size() + 1);
            lines.push_back(std::move(line));
        }
        _file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, S_IRUSR | S_IWUSR);
        const bool bUsable = _file >= 0 && ::ftruncate(_file, wholeBytes) == 0;
        return bUsable ? std::optional(std::move(lines)) : std::nullopt;
    }

    /// False where the disk takes no more: then nothing may be sent either.
    [[nodiscard]] bool TryAppend(std::string line) const
    {
        line += '\n';
        return ::write(_file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) && ::fdatasync(_file) == 0;
    }
};

/// One order of the journal.
struct Job
{
    OrderBuilder route;
    OrderRecord record;      ///< What was sent of it, and accepted.
    std::size_t reached = 0; ///< Nodes.
    bool bGiven = false;     ///< The session has it.
    bool bCancelAsked = false;
};

struct Vehicle
{
    std::deque<Job> jobs;             ///< The first one is the one that runs.
    std::set<std::string> orderIDs;   ///< Of all orders that were ever taken.
    std::vector<std::string> actions; ///< Instant actions that wait for the vehicle to be ready.
};

class FleetMaster final : public IMqttLinkListener
{
    boost::asio::io_context& _io;
    Journal _journal;
    MasterFleet _fleet;
    Vda5050Codec _codec;
    std::map<std::size_t, Vehicle> _vehicles; ///< By the fleet's number.
    std::map<std::pair<std::size_t, EMasterTimer>, boost::asio::steady_timer> _timers;
    bool _bInputEnded = false;
    bool _bStopping = false;

public:
    std::unique_ptr<MosquittoLink> link;

    explicit FleetMaster(boost::asio::io_context& io)
        : _io(io),
          _fleet(FleetOptions{})
    {
    }

    /// False where the journal cannot be read and written.
    [[nodiscard]] bool TryStart(const std::string& journal)
    {
        const std::optional<std::vector<std::string>> lines = _journal.OpenOrNull(journal);
        if (!lines.has_value())
        {
            return false;
        }
        for (const std::string& line : *lines)
        {
            Replay(line);
        }
        link->Subscribe(_fleet.GetSubscriptions());
        link->Start();
        return true;
    }

    void OnCommand(const std::string& line)
    {
        const auto [verb, name, text] = Split(line);
        const std::optional<std::size_t> number = FindVehicleOrNull(name);
        if (!number.has_value())
        {
            fmt::print("refused: '{}' names no vehicle as MANUFACTURER/SERIALNUMBER\n", line);
            return;
        }
        if (verb == "order")
        {
            TakeOrder(*number, name, text);
        }
        else if (verb == "cancel" && !_vehicles[*number].jobs.empty())
        {
            _vehicles[*number].jobs.front().bCancelAsked = TryWrite("cancel", name, {});
        }
        else if (verb == "do" && !text.empty())
        {
            _vehicles[*number].actions.push_back(text);
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
    // ---- commands and the journal: the same lines, and one reader for both

    struct Words
    {
        std::string verb;
        std::string name;
        std::string text;
    };

    [[nodiscard]] static Words Split(const std::string& line)
    {
        const std::size_t first = std::min(line.find(' '), line.size());
        const std::size_t second = std::min(line.find(' ', first + 1), line.size());
        const auto cut = [&line](std::size_t begin, std::size_t end) {
            return begin < end ? line.substr(begin, end - begin) : std::string();
        };
        return {line.substr(0, first), cut(first + 1, second), cut(second + 1, line.size())};
    }

    [[nodiscard]] std::optional<std::size_t> FindVehicleOrNull(const std::string& name)
    {
        const std::size_t slash = std::min(name.find('/'), name.size());
        VehicleAddress address;
        address.manufacturer = name.substr(0, slash);
        address.serialNumber = name.substr(std::min(slash + 1, name.size()));
        FleetActions out; // Empty: a vehicle that has not been heard asks for nothing.
        const Core::Result<std::size_t> number = _fleet.Add(address, ReadClock(), out);
        return number ? std::optional(*number) : std::nullopt;
    }

    [[nodiscard]] std::string GetName(std::size_t number) const
    {
        const VehicleAddress& address = _fleet.GetSession(number).GetOptions().address;
        return address.manufacturer + "/" + address.serialNumber;
    }

    /// Ends the program where the disk takes no more: an order that it does not remember must not be sent.
    [[nodiscard]] bool TryWrite(std::string_view verb, const std::string& name, const std::string& text)
    {
        if (_journal.TryAppend(fmt::format("{} {} {}", verb, name, text)))
        {
            return true;
        }
        fmt::print("cannot write the journal: {}\n", std::generic_category().message(errno));
        Stop();
        return false;
    }

    [[nodiscard]] Core::Result<Job> MakeJob(const std::string& text)
    {
        return _codec.Decode<OrderMessage>(text).and_then([](OrderMessage order) {
            return OrderBuilder::Create(order.orderID, std::move(order.nodes), std::move(order.edges))
                .map([](OrderBuilder route) {
                    return Job{std::move(route), {}, 0, false, false};
                });
        });
    }

    void TakeOrder(std::size_t number, const std::string& name, const std::string& text)
    {
        Core::Result<Job> job = MakeJob(text);
        if (!job)
        {
            fmt::print("refused: an order for {}: {}\n", name, Core::Describe(job.error()));
            return;
        }
        const std::string orderID = job->route.GetOrderID();
        if (_vehicles[number].orderIDs.contains(orderID))
        {
            fmt::print("known: {} for {}\n", orderID, name);
        }
        else if (TryWrite("order", name, text))
        {
            _vehicles[number].orderIDs.insert(orderID);
            _vehicles[number].jobs.push_back(std::move(*job));
            fmt::print("taken: {} for {}\n", orderID, name);
        }
    }

    void Replay(const std::string& line)
    {
        const auto [verb, name, text] = Split(line);
        const std::optional<std::size_t> number = FindVehicleOrNull(name);
        if (!number.has_value())
        {
            return;
        }
        Vehicle& vehicle = _vehicles[*number];
        std::size_t count = 0;
        std::from_chars(text.data(), text.data() + text.size(), count);
        if (verb == "order")
        {
            if (Core::Result<Job> job = MakeJob(text))
            {
                vehicle.orderIDs.insert(job->route.GetOrderID());
                vehicle.jobs.push_back(std::move(*job));
            }
        }
        else if (vehicle.jobs.empty())
        {
            return;
        }
        else if (verb == "release")
        {
            std::ignore = TryRelease(vehicle.jobs.front(), count);
        }
        else if (verb == "accepted")
        {
            vehicle.jobs.front().record.acceptedUpdateID = static_cast<std::uint32_t>(count);
        }
        else if (verb == "cancel")
        {
            vehicle.jobs.front().bCancelAsked = true;
        }
        else if (verb == "ended")
        {
            vehicle.jobs.pop_front();
        }
    }

    /// The builder makes the same messages from the same numbers, so the numbers are all that the journal needs.
    [[nodiscard]] static bool TryRelease(Job& job, std::size_t nodes)
    {
        Core::Result<OrderMessage> message =
            job.record.messages.empty() ? job.route.MakeOrder(nodes) : job.route.MakeUpdate(nodes);
        if (message)
        {
            job.record.messages.push_back(std::move(*message));
        }
        return message.has_value();
    }

    // ---- what is to be done for a vehicle, after each thing that happened

    void Advance(std::size_t number, FleetActions& out)
    {
        MasterSession& session = _fleet.GetSession(number);
        Vehicle& vehicle = _vehicles[number];
        MasterActions actions;
        if (session.IsReady() && !_bStopping)
        {
            for (const std::string& type : std::exchange(vehicle.actions, {}))
            {
                Action action;
                action.actionType = type;
                const Core::Result<std::string> sent = session.SendInstantAction(action, ReadClock(), actions);
                fmt::print("{}: {} {}\n", GetName(number), type, sent ? "is " + *sent : Core::Describe(sent.error()));
            }
            if (!vehicle.jobs.empty())
            {
                AdvanceJob(number, session, vehicle.jobs.front(), actions);
            }
        }
        for (MasterAction& action : actions)
        {
            out.push_back(FleetAction{number, std::move(action)});
        }
    }

    void AdvanceJob(std::size_t number, MasterSession& session, Job& job, MasterActions& out)
    {
        const EOrderPhase phase = session.GetOrderPhase();
        const bool bRuns = phase == EOrderPhase::Sent || phase == EOrderPhase::Active;
        Core::Result<void> done;
        const bool bShown = session.GetStateOrNull()->orderID == job.route.GetOrderID();
        const bool bUnknown = !bShown && !job.record.acceptedUpdateID.has_value();
        if (!job.bGiven && bUnknown && job.bCancelAsked)
        {
            out.emplace_back(OrderCancelled{job.route.GetOrderID()}); // The vehicle never had it.
        }
        else if (!job.bGiven && !job.record.messages.empty())
        {
            done = session.ResumeOrder(job.record, ReadClock(), out);
            job.bGiven = done.has_value();
        }
        else if (!job.bGiven && session.CanTakeOrder())
        {
            done = Begin(number, session, job, out);
        }
        else if (job.bGiven && bRuns && job.bCancelAsked)
        {
            done = session.Cancel(ReadClock(), out);
        }
        else if (job.bGiven && phase == EOrderPhase::Active)
        {
            done = Extend(number, session, job, out);
        }
        if (done || done.error().code == EVda5050Error::VehicleNotReady)
        {
            return;
        }
        fmt::print("{}: {}\n", GetName(number), Core::Describe(done.error()));
        if (bRuns)
        {
            job.bCancelAsked = TryWrite("cancel", GetName(number), {}); // An update that the vehicle cannot be sent.
        }
        else
        {
            out.emplace_back(OrderLost{job.route.GetOrderID(), "it cannot be sent"});
        }
    }

    [[nodiscard]] Core::Result<void> Begin(std::size_t number, MasterSession& session, Job& job, MasterActions& out)
    {
        const std::size_t nodes = std::min(NODES_AHEAD, job.route.GetNodes().size());
        if (!TryWrite("release", GetName(number), std::to_string(nodes)) || !TryRelease(job, nodes))
        {
            return {};
        }
        job.bGiven = true;
        return session.SendOrder(job.record.messages.back(), ReadClock(), out);
    }

    /// Only behind what the vehicle has shown: so never more than one message waits for an answer.
    [[nodiscard]] Core::Result<void> Extend(std::size_t number, MasterSession& session, Job& job, MasterActions& out)
    {
        const std::size_t nodes = std::min(job.reached + NODES_AHEAD, job.route.GetNodes().size());
        const bool bShown = job.record.acceptedUpdateID >= job.record.messages.back().orderUpdateID;
        if (!bShown || nodes <= job.route.GetReleasedNodes()
            || !TryWrite("release", GetName(number), std::to_string(nodes)) || !TryRelease(job, nodes))
        {
            return {};
        }
        return session.SendOrderUpdate(job.record.messages.back(), ReadClock(), out);
    }

    // ---- what the sessions want and tell

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
        const bool bIdle = std::ranges::all_of(_vehicles, [](const auto& vehicle) {
            return vehicle.second.jobs.empty() && vehicle.second.actions.empty();
        });
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

    void EndJob(std::size_t number, const std::string& orderID, std::string_view how)
    {
        std::deque<Job>& jobs = _vehicles[number].jobs;
        if (!jobs.empty() && jobs.front().route.GetOrderID() == orderID && TryWrite("ended", GetName(number), orderID))
        {
            fmt::print("{}: {} {}\n", GetName(number), orderID, how);
            jobs.pop_front();
        }
    }

    void OnAccepted(std::size_t number, const OrderAccepted& accepted)
    {
        std::deque<Job>& jobs = _vehicles[number].jobs;
        const std::string update = std::to_string(accepted.orderUpdateID);
        if (!jobs.empty() && TryWrite("accepted", GetName(number), update))
        {
            jobs.front().record.acceptedUpdateID = accepted.orderUpdateID;
            fmt::print("{}: {} update {} accepted\n", GetName(number), accepted.orderID, update);
        }
    }

    void OnRejected(std::size_t number, const OrderRejected& rejected)
    {
        fmt::print(
            "{}: {} update {} rejected: {} {}\n",
            GetName(number),
            rejected.orderID,
            rejected.orderUpdateID,
            rejected.errorType,
            rejected.reason);
        std::deque<Job>& jobs = _vehicles[number].jobs;
        if (rejected.orderUpdateID == 0)
        {
            EndJob(number, rejected.orderID, "rejected");
        }
        else if (!jobs.empty())
        {
            jobs.front().bCancelAsked =
                TryWrite("cancel", GetName(number), {}); // Its route cannot be driven to the end.
        }
    }

    void OnCancelFailed(std::size_t number, const CancelFailed& failed)
    {
        fmt::print("{}: {} is not cancelled: {}\n", GetName(number), failed.orderID, failed.reason);
        std::deque<Job>& jobs = _vehicles[number].jobs;
        if (!jobs.empty())
        {
            jobs.front().bCancelAsked = false;
        }
    }

    void OnReached(std::size_t number, const NodeReached& node)
    {
        std::deque<Job>& jobs = _vehicles[number].jobs;
        if (!jobs.empty())
        {
            ++jobs.front().reached;
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
                [&](const OrderFinished& order) { EndJob(number, order.orderID, "finished"); },
                [&](const OrderCancelled& order) { EndJob(number, order.orderID, "cancelled"); },
                [&](const OrderLost& order) {
                    // A master that was killed in the middle of a cancel finds the order cleared.
                    const std::deque<Job>& jobs = _vehicles[number].jobs;
                    const bool bCancelled = !jobs.empty() && jobs.front().bCancelAsked;
                    EndJob(number, order.orderID, bCancelled ? "cancelled" : "lost: " + order.reason);
                },
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

/// Reads the standard input line by line: a keyboard, a pipe or a file.
class Commands
{
    boost::asio::posix::stream_descriptor _input;
    std::array<char, 4096> _chunk{};
    std::string _line;
    FleetMaster& _master;

public:
    Commands(boost::asio::io_context& io, FleetMaster& master)
        : _input(io, ::dup(STDIN_FILENO)),
          _master(master)
    {
        ReadAsync();
    }

private:
    void ReadAsync()
    {
        _input.async_read_some(
            boost::asio::buffer(_chunk),
            [this](const boost::system::error_code& error, std::size_t count) {
                if (error)
                {
                    OnEnd(error);
                    return;
                }
                OnRead({_chunk.data(), count});
                ReadAsync();
            });
    }

    void OnRead(std::string_view text)
    {
        for (const char letter : text)
        {
            if (letter == '\n')
            {
                _master.OnCommand(std::exchange(_line, {}));
            }
            else
            {
                _line += letter;
            }
        }
    }

    void OnEnd(const boost::system::error_code& error)
    {
        if (error == boost::asio::error::operation_not_supported) // A file is not to be waited for: it is all there.
        {
            for (std::string line; std::getline(std::cin, line);)
            {
                _master.OnCommand(line);
            }
        }
        _master.OnInputEnded();
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    MosquittoOptions options;
    std::size_t port = 0;
    if (argc == 4)
    {
        const std::string_view text(arguments[2]);
        std::from_chars(text.data(), text.data() + text.size(), port);
    }
    if (port == 0 || port > UINT16_MAX)
    {
        fmt::print("Usage: e10_fleet_master HOST PORT JOURNAL < COMMANDS\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    options.host = arguments[1];
    options.port = static_cast<std::uint16_t>(port);
    options.clientID = fmt::format("fleet-master-{}", ::getpid());
    boost::asio::io_context io;
    ExampleRandom random;
    FleetMaster master(io);
    master.link = std::make_unique<MosquittoLink>(io.get_executor(), random, Core::Logger(), options, master);
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
    Commands commands(io, master);
    io.run();
    return 0;
}
