#include "Catch.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAckResult;
using Tcp = boost::asio::ip::tcp;

namespace
{

constexpr std::chrono::seconds PATIENCE{10};

class SystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

/// Keeps the events and does what a test wants on each.
class Recorder final : public ProtocolBeast::ISessionHandler
{
public:
    std::vector<Protocol::SessionEvent> events;
    std::function<void(const Protocol::SessionEvent&)> onEvent;

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        events.push_back(event);
        if (onEvent)
        {
            onEvent(event);
        }
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<TEvent> GetAll() const
    {
        std::vector<TEvent> found;
        for (const Protocol::SessionEvent& event : events)
        {
            if (const TEvent* eventOrNull = std::get_if<TEvent>(&event))
            {
                found.push_back(*eventOrNull);
            }
        }
        return found;
    }
};

/// A server, a client and the loop that runs them.
class Rig
{
public:
    boost::asio::io_context io;
    SystemClock clock;
    Testing::SeededRandom random;
    Testing::RecordingLogSink sink;
    Core::Logger logger{sink, "test"};
    Recorder mcsEvents;
    Recorder acsEvents;
    ProtocolBeast::ServerOptions serverOptions;
    ProtocolBeast::ClientOptions clientOptions;
    std::unique_ptr<ProtocolBeast::McsServer> server;
    std::unique_ptr<ProtocolBeast::AcsClient> client;

    Rig()
    {
        clientOptions.session.reconnect.initial = 20ms;
        clientOptions.session.reconnect.maximum = 50ms;
        clientOptions.session.positionInterval = 0ms;
    }

    void Listen()
    {
        auto created =
            ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, serverOptions, mcsEvents);
        REQUIRE(created.has_value());
        server = std::move(*created);
        serverOptions.port = server->GetPort();
    }

    [[nodiscard]] std::string GetUrl(const std::string& path = "/acs/") const
    {
        return "ws://127.0.0.1:" + std::to_string(serverOptions.port) + path;
    }

    void Connect(const std::string& path = "/acs/")
    {
        clientOptions.url = GetUrl(path);
        client = MakeClient(acsEvents);
        client->Start();
    }

    [[nodiscard]] std::unique_ptr<ProtocolBeast::AcsClient> MakeClient(Recorder& events)
    {
        auto created =
            ProtocolBeast::AcsClient::Create(io.get_executor(), clock, random, logger, clientOptions, events);
        REQUIRE(created.has_value());
        return std::move(*created);
    }

    /// Runs the loop until the condition holds; false where it never does.
    [[nodiscard]] bool WasReached(const std::function<bool()>& condition)
    {
        const auto deadline = std::chrono::steady_clock::now() + PATIENCE;
        io.restart();
        while (!condition() && std::chrono::steady_clock::now() < deadline)
        {
            static_cast<void>(io.run_one_for(100ms));
            io.restart();
        }
        return condition();
    }

    void RegisterBoth()
    {
        Listen();
        Connect();
        REQUIRE(WasReached([this] { return !acsEvents.GetAll<Protocol::Registered>().empty(); }));
        client->ReplayDone();
    }

    /// What a client gets that speaks no WebSocket.
    [[nodiscard]] std::string TalkRaw(const std::string& text)
    {
        Tcp::socket socket(io);
        socket.connect({boost::asio::ip::make_address("127.0.0.1"), serverOptions.port});
        boost::asio::write(socket, boost::asio::buffer(text));
        std::string answer;
        bool bEnded = false;
        boost::asio::async_read(
            socket,
            boost::asio::dynamic_buffer(answer),
            [&bEnded](const boost::system::error_code& /*error*/, std::size_t /*count*/) { bEnded = true; });
        CHECK(WasReached([&bEnded] { return bEnded; }));
        return answer;
    }
};

Protocol::AcsRequest MakeReport(const std::string& transactionID)
{
    return {transactionID, {}, Protocol::PlanReport{"P", Protocol::EPlanStatus::InProgress, "fine"}};
}

Protocol::ExecutionPlan MakePlan(std::size_t jobCount)
{
    Protocol::ExecutionPlan plan{"P", "L", 10, {{1, "MemoryPickAndPlace", "A01.SET01", {}, {}}}};
    for (std::size_t index = 0; index < jobCount; ++index)
    {
        plan.steps[0].jobs.push_back(
            {"cd3a109a-8f19-4f19-86ea-" + std::to_string(552'200'000'000 + index), "AMR.TP01.MP01", "A01.SET01.MP01"});
    }
    return plan;
}

} // namespace

TEST_CASE("6 Over a real socket: register, plan, Ack, reports, goodbye")
{
    Rig rig;
    rig.RegisterBoth();
    CHECK(rig.server->IsRegistered());

    // 75 jobs: more than one TCP segment, one frame.
    const Protocol::AcsRequest plan = rig.server->MakeRequest(MakePlan(75));
    rig.acsEvents.onEvent = [&rig](const Protocol::SessionEvent& event) {
        if (const auto* receivedOrNull = std::get_if<Protocol::RequestReceived>(&event))
        {
            rig.client->Answer(
                GetCommand(receivedOrNull->request),
                receivedOrNull->request.transactionID,
                EAckResult::Success,
                "registered",
                Protocol::PlanAck{"P"});
            CHECK(rig.client->TrySendDurable(MakeReport("rep-1")));
        }
    };
    REQUIRE(rig.server->TrySend(plan));
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::RequestReceived>().at(0).request == plan);
    CHECK(rig.acsEvents.GetAll<Protocol::Acked>().at(0).transactionID == "rep-1");
    CHECK(rig.mcsEvents.GetAll<Protocol::AckReceived>().at(0).ack.transactionID == plan.transactionID);
    CHECK(rig.mcsEvents.GetAll<Protocol::RequestReceived>().at(0).request == MakeReport("rep-1"));

    rig.client->Stop();
    REQUIRE(rig.WasReached([&rig] {
        return !rig.acsEvents.GetAll<Protocol::Stopped>().empty()
            && !rig.mcsEvents.GetAll<Protocol::LinkLost>().empty();
    }));
    CHECK(rig.mcsEvents.GetAll<Protocol::LinkLost>()[0].reason.find("1000") != std::string::npos);
    const auto reports = rig.mcsEvents.GetAll<Protocol::RequestReceived>();
    CHECK(reports.back().request.payload == Protocol::AcsPayload(Protocol::AcsCommStateUpdate{false}));
}

TEST_CASE("1 After a cut the client registers again and what was not acknowledged is fed again")
{
    Rig rig;
    rig.RegisterBoth();
    REQUIRE(rig.client->TrySendDurable(MakeReport("a")));
    rig.server->Cut();
    rig.acsEvents.onEvent = [&rig](const Protocol::SessionEvent& event) {
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            CHECK(rig.client->TrySendDurable(MakeReport("a")));
            rig.client->ReplayDone();
        }
    };
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().at(0).bWasRegistered);
    CHECK(rig.acsEvents.GetAll<Protocol::Registered>().size() == 2);
    CHECK(rig.server->GetStatistics().registrations == 2);
}

TEST_CASE("1 A server that goes and comes back on its port is found again")
{
    Rig rig;
    rig.RegisterBoth();
    rig.server.reset();
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::LinkLost>().size() >= 3; }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().at(2).reason.find("cannot connect to 127.0.0.1") == 0);
    rig.Listen();
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::Registered>().size() == 2; }));
}

TEST_CASE("12.3 A close with 1008 is followed by another attempt")
{
    Rig rig;
    rig.RegisterBoth();
    rig.server->Drop(1008, "not today");
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::Registered>().size() == 2; }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().at(0).reason.find("1008: not today") != std::string::npos);
}

TEST_CASE("12.3 A second client is refused with 403 where the option says so, and goes on trying")
{
    Rig rig;
    rig.serverOptions.session.bSecondRefused = true;
    rig.RegisterBoth();
    Recorder others;
    const auto other = rig.MakeClient(others);
    other->Start();
    REQUIRE(rig.WasReached([&others] { return others.GetAll<Protocol::LinkLost>().size() >= 2; }));
    CHECK(others.GetAll<Protocol::LinkLost>()[0].reason.find("HTTP 403") != std::string::npos);
    CHECK(rig.client->IsRegistered());
    rig.client.reset();
    REQUIRE(rig.WasReached([&other] { return other->IsRegistered(); }));
}

TEST_CASE("1 A wrong path is answered with 404, plain HTTP politely, garbage without harm")
{
    Rig rig;
    rig.Listen();
    CHECK(rig.TalkRaw("GET /other HTTP/1.1\r\nHost: x\r\n\r\n").find("HTTP/1.1 404") == 0);
    const std::string plain = rig.TalkRaw("GET /acs/ HTTP/1.1\r\nHost: x\r\n\r\n");
    CHECK(plain.find("HTTP/1.1 426") == 0);
    CHECK(plain.find("connect with a WebSocket") != std::string::npos);
    CHECK(rig.TalkRaw("\x16\x03\x01 this is no HTTP\r\n\r\n").find("HTTP/1.1 400") == 0);
    CHECK(rig.TalkRaw(std::string(100'000, 'x')).find("HTTP/1.1 200") == std::string::npos);

    rig.Connect("/wrong");
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::LinkLost>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>()[0].reason.find("HTTP 404") != std::string::npos);
    rig.Connect("/acs");
    REQUIRE(rig.WasReached([&rig] { return rig.client->IsRegistered(); }));
}

TEST_CASE("1 Garbage inside a WebSocket is counted and the connection goes on")
{
    Rig rig;
    rig.RegisterBoth();
    // A plan with a name that no JSON text can hold is written with a replacement, so that the peer can read it.
    REQUIRE(rig.client->TrySendDurable(MakeReport("bad \xFF utf-8")));
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.client->IsRegistered());
    CHECK(rig.server->IsRegistered());
}

TEST_CASE("A port in use and a bad address are refused with a sentence that names them")
{
    Rig rig;
    rig.Listen();
    const auto second = ProtocolBeast::McsServer::Create(
        rig.io.get_executor(),
        rig.clock,
        rig.random,
        rig.logger,
        rig.serverOptions,
        rig.mcsEvents);
    REQUIRE_FALSE(second.has_value());
    const std::string sentence = Core::Describe(second.error());
    CHECK(sentence.find("127.0.0.1:" + std::to_string(rig.serverOptions.port)) != std::string::npos);
    CHECK(sentence.find("choose another") != std::string::npos);
    CHECK(sentence.find("Address already in use") != std::string::npos);
}

TEST_CASE("An MCS listens on a name, too")
{
    Rig rig;
    rig.serverOptions.address = "localhost";
    rig.Listen();
    CHECK(rig.server->GetPort() != 0);
}

TEST_CASE("A URL that is none is refused with a sentence")
{
    Rig rig;
    for (const std::string url :
         {"",
          "http://x/",
          "ws://",
          "ws://:80/",
          "ws://x:0/",
          "ws://x:99999/",
          "ws://u@x/",
          "ws://x/\r\nEvil: 1",
          "wss://x/"})
    {
        INFO(url);
        rig.clientOptions.url = url;
        CHECK_FALSE(ProtocolBeast::AcsClient::Create(
                        rig.io.get_executor(),
                        rig.clock,
                        rig.random,
                        rig.logger,
                        rig.clientOptions,
                        rig.acsEvents)
                        .has_value());
    }
}

TEST_CASE("After destruction no handler is called and nothing is left to run")
{
    Rig rig;
    rig.RegisterBoth();
    REQUIRE(rig.client->TrySendDurable(MakeReport("a")));
    REQUIRE(rig.server->TrySend(rig.server->MakeRequest(Protocol::RequestAcsPlans{})));
    const std::size_t acsCount = rig.acsEvents.events.size();
    const std::size_t mcsCount = rig.mcsEvents.events.size();
    rig.client.reset();
    rig.server.reset();
    rig.io.restart();
    const auto before = std::chrono::steady_clock::now();
    rig.io.run_for(PATIENCE);
    CHECK(std::chrono::steady_clock::now() - before < PATIENCE);
    CHECK(rig.acsEvents.events.size() == acsCount);
    CHECK(rig.mcsEvents.events.size() == mcsCount);
}

TEST_CASE("An observer sees every text of both directions before the session judges it")
{
    Rig rig;
    std::vector<std::string> seen;
    rig.serverOptions.onWire =
        [&seen](ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text) {
            const std::string arrow = direction == ProtocolBeast::EWireDirection::In ? "in " : "out ";
            const std::size_t start = text.find("\"command\":\"") + 11;
            seen.push_back(
                arrow + std::to_string(connection) + " "
                + std::string(text.substr(start, text.find('"', start) - start)));
        };
    rig.RegisterBoth();
    CHECK(seen == std::vector<std::string>{"in 1 Registration", "out 1 RegistrationAck"});
}
