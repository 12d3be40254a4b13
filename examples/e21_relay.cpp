// Lesson 21: a relay between an MCS and an ACS that cannot reach each other. It is an MCS for the ACS and an ACS for the MCS,
// and decides nothing: a request is passed on with its transactionId, and the answer of the other side is passed back. So a
// report has its Ack only when the MCS has it, and the relay needs no store: the ACS sends again what has no Ack.
//
// Only a plan waits for the next ACS, because the last one may have executed it already: a Fail would be wrong. Any other
// request that no ACS can answer gets a Fail of the relay, so that no control is delivered hours later.
//
//     e21_relay 9002 ws://127.0.0.1:9001/acs/      (the ACS connects to port 9002, port 0: a free one)
//
// An ACS is registered at the relay only while the relay is registered at the MCS. The lesson is longer than 150 lines because
// it has both sides.

#include "ExampleClock.hpp"
#include "ExampleNumber.hpp"
#include "ExampleRandom.hpp"
#include "McsJournal.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;           // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

namespace
{

/// Passes the events of one link to a function.
class EventCall final : public ProtocolBeast::ISessionHandler
{
    std::function<void(const SessionEvent&)> _onEvent;

public:
    explicit EventCall(std::function<void(const SessionEvent&)> onEvent)
        : _onEvent(std::move(onEvent))
    {
    }

    void OnSessionEvent(const SessionEvent& event) override
    {
        _onEvent(event);
    }
};

/// The events of one side call the other side.
class Relay
{
    static constexpr std::size_t MAXIMUM_REQUESTS = 1'000;

    std::vector<AcsRequest> _requests;     ///< Of the MCS, without an answer of the ACS, oldest first.
    std::vector<RequestReceived> _reports; ///< Of the ACS, without an answer of the MCS, oldest first.
    ConnectionID _connection = 0;          ///< Of the ACS that has asked for its registration last.
    AnswerToken _registration = NO_ANSWER; ///< Of the ACS; it waits for the MCS.

public:
    EventCall acsHandler{[this](const SessionEvent& event) {
        OnAcsEvent(event);
    }};
    EventCall mcsHandler{[this](const SessionEvent& event) {
        OnMcsEvent(event);
    }};
    std::unique_ptr<ProtocolBeast::McsServer> server; ///< For the ACS.
    std::unique_ptr<ProtocolBeast::AcsClient> client; ///< Of the MCS.

    void Start() const
    {
        client->SendStatus(TscStateUpdate{ETscState::Paused});
        client->SendStatus(AcsCommStateUpdate{false}); // No ACS yet: no plans.
        client->Start();
    }

private:
    void OnAcsEvent(const SessionEvent& event)
    {
        std::visit(
            Core::Overloaded{
                [this](const Registered& /*event*/) {
                    fmt::print("the ACS is registered\n");
                    SendRequests();
                },
                [this](const LinkLost& lost) {
                    fmt::print("the ACS is lost: {}\n", lost.reason);
                    client->SendStatus(AcsCommStateUpdate{false});
                    RefuseRequests();
                },
                [this](const RequestReceived& received) { OnAcsRequest(received); },
                [this](const RequestGivenUp& given) { Forget(given.token); },
                [this](const AckReceived& received) { OnAck(received.ack); },
                [](const auto& /*other*/) { /* A request without an Ack stays until the ACS is lost. */ }},
            event);
    }

    void OnAcsRequest(const RequestReceived& received)
    {
        const AcsPayload& payload = received.request.payload;
        if (std::holds_alternative<Registration>(payload))
        {
            _connection = received.connection;
            _registration = received.token;
            AnswerRegistration();
        }
        else if (received.token != NO_ANSWER)
        {
            _reports.push_back(received);
            SendReports();
        }
        else if (const auto* const positionsOrNull = std::get_if<RobotPositionUpdate>(&payload))
        {
            client->SendPosition(*positionsOrNull);
        }
        else
        {
            client->SendStatus(payload);
        }
    }

    void OnMcsRequest(const AcsRequest& request)
    {
        if (HasRequest(request))
        {
            return; // The MCS has sent it again.
        }
        if (!server->IsRegistered() && !IsPlan(request))
        {
            Refuse(request, "no ACS is connected");
        }
        else if (_requests.size() >= MAXIMUM_REQUESTS)
        {
            Refuse(request, "too many requests wait for the ACS");
        }
        else
        {
            _requests.push_back(request);
            SendRequests();
        }
    }

    [[nodiscard]] bool HasRequest(const AcsRequest& repeated) const
    {
        return std::ranges::any_of(_requests, [&repeated](const AcsRequest& request) {
            return request.transactionID == repeated.transactionID && GetCommand(request) == GetCommand(repeated);
        });
    }

    [[nodiscard]] static bool IsPlan(const AcsRequest& request)
    {
        return std::holds_alternative<ExecutionPlan>(request.payload);
    }

    void Refuse(const AcsRequest& request, std::string_view reason) const
    {
        const AckPayload payload = std::visit(
            [](const auto& content) -> AckPayload {
                if constexpr (requires { PlanAck{content.planID}; })
                {
                    return PlanAck{content.planID};
                }
                return EmptyAck{};
            },
            request.payload);
        client->Answer(GetCommand(request), request.transactionID, EAckResult::Fail, reason, payload);
    }

    void RefuseRequests()
    {
        for (const AcsRequest& request : std::exchange(_requests, {}))
        {
            IsPlan(request) ? _requests.push_back(request) : Refuse(request, "the ACS was lost before it answered");
        }
    }

    /// Without an ACS they wait. The server ignores those that are on their way.
    void SendRequests()
    {
        for (const AcsRequest& request : _requests)
        {
            if (!server->TrySend(request))
            {
                return;
            }
        }
    }

    void OnAck(const AcsAck& ack)
    {
        std::erase_if(_requests, [&ack](const AcsRequest& request) {
            return request.transactionID == ack.transactionID && GetCommand(request) == ack.command;
        });
        client->Answer(ack.command, ack.transactionID, ack.result, ack.message, ack.payload);
    }

    void AnswerRegistration()
    {
        if (client->IsRegistered() && _registration != NO_ANSWER)
        {
            static_cast<void>(server->TryAnswer(std::exchange(_registration, NO_ANSWER), EAckResult::Success, ""));
        }
    }

    /// As far as the client has room. It ignores those that are on their way.
    void SendReports()
    {
        for (const RequestReceived& report : _reports)
        {
            if (!client->TrySendDurable(report.request))
            {
                return;
            }
        }
    }

    void Forget(AnswerToken token)
    {
        std::erase_if(_reports, [token](const RequestReceived& report) { return report.token == token; });
    }

    void OnMcsEvent(const SessionEvent& event)
    {
        std::visit(
            Core::Overloaded{
                [this](const Registered& /*event*/) {
                    fmt::print("registered at the MCS\n");
                    SendReports();
                    client->ReplayDone();
                    AnswerRegistration();
                },
                [this](const LinkLost& lost) { OnMcsLost(lost); },
                [this](const WindowOpened& /*event*/) { SendReports(); },
                [this](const Acked& acked) { OnAcked(acked); },
                [this](const RequestReceived& received) { OnMcsRequest(received.request); },
                [](const auto& /*other*/) { /* A report without an Ack stays for the next Registered. */ }},
            event);
    }

    /// The ACS sees what the relay sees.
    void OnMcsLost(const LinkLost& lost)
    {
        if (lost.bWasRegistered)
        {
            fmt::print("the MCS is lost: {}\n", lost.reason);
            server->Run([this](Core::Now /*now*/, SessionActions& out) {
                out.emplace_back(Close{_connection, CLOSE_NORMAL, "the relay has lost the MCS"});
            });
        }
    }

    void OnAcked(const Acked& acked)
    {
        const auto found = std::find_if(_reports.begin(), _reports.end(), [&acked](const RequestReceived& report) {
            return report.request.transactionID == acked.transactionID && GetCommand(report.request) == acked.command;
        });
        if (found != _reports.end())
        {
            const AnswerToken token = found->token;
            _reports.erase(found);
            static_cast<void>(server->TryAnswer(token, acked.result, acked.message));
        }
        SendReports();
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    ProtocolBeast::ServerOptions options;
    options.session.answeredByApplication = McsJournal::GetReportCommands();
    options.session.answeredByApplication.set(static_cast<std::size_t>(EAcsCommand::Registration));
    options.session.ackRetries = 3;
    options.session.bPlansWithheld = false;                        // That is the decision of the MCS.
    options.session.unansweredPolicy = EUnansweredPolicy::Silence; // The ACS sends the report again.
    if (argc != 3 || !TryRead(arguments[1], options.port))
    {
        fmt::print("Usage: e21_relay PORT URL   (URL of the MCS, for example ws://127.0.0.1:9001/acs/)\n");
        return 2;
    }
    boost::asio::io_context io;
    const ExampleClock clock;
    ExampleRandom random;
    const Core::Logger logger;
    Relay relay;
    ProtocolBeast::ClientOptions mcs;
    mcs.url = arguments[2];
    auto server = ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, options, relay.acsHandler);
    auto client = ProtocolBeast::AcsClient::Create(io.get_executor(), clock, random, logger, mcs, relay.mcsHandler);
    if (!server.has_value() || !client.has_value())
    {
        fmt::print("{}\n", Core::Describe(server.has_value() ? client.error() : server.error()));
        return 2;
    }
    relay.server = std::move(*server);
    relay.client = std::move(*client);
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    fmt::print("ready: ws=127.0.0.1:{}\n", relay.server->GetPort());
    relay.Start();
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&io](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            io.stop(); // Nothing is lost: what has no Ack is sent again.
        }
    });
    io.run();
    return 0;
}
