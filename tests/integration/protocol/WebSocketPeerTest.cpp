#include "ClientWireFixture.hpp"
#include "RawMCS.hpp"
#include "RawPeer.hpp"
#include "RawServer.hpp"
#include "WebSocketFixture.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <utility>
#include <variant>
#include <vector>

// Peers that no library provides: how client and server handle one that is faulty, slow or gone.

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAcsCommand;
using Testing::ClientWireFixture;
using Testing::EFrame;
using Testing::Encode;
using Testing::MakeFrame;
using Testing::MakeFrameHead;
using Testing::MakePlan;
using Testing::MakeReport;
using Testing::RawFrame;
using Testing::RawMCS;
using Testing::RawPeer;
using Testing::RawServer;
using Fixture = Testing::WebSocketFixture;

namespace
{

constexpr std::uint64_t HUGE_FRAME = 100'000'000;
constexpr std::string_view REGISTRATION =
    R"({"command":"Registration","transactionId":"t-1","timestamp":"2025-07-02T21:00:00.123+09:00","payload":{}})";

/// The server of the SDK against a raw client that has registered.
class ServerWireFixture : public Fixture
{
public:
    std::shared_ptr<RawPeer> peer;

    void RegisterRaw()
    {
        Listen();
        ConnectRaw();
        peer->Write(MakeFrame({EFrame::Text, std::string(REGISTRATION), true}, true));
        REQUIRE(WasReached([this] { return server->IsRegistered(); }));
        std::optional<RawFrame> answer;
        REQUIRE(WasReached([this, &answer] {
            answer = peer->TakeFrameOrNull();
            return answer.has_value();
        }));
        CHECK(answer->payload.find("RegistrationAck") != std::string::npos);
    }

    void ConnectRaw()
    {
        peer = RawPeer::Connect(io, serverOptions.port);
        peer->WriteUpgrade();
        peer->ReadAsync();
        std::string head;
        REQUIRE(WasReached([this, &head] {
            head = peer->TakeHead();
            return !head.empty();
        }));
        REQUIRE(head.find("HTTP/1.1 101") == 0);
    }

    [[nodiscard]] std::string GetFirstMcsLoss() const
    {
        return mcsEvents.GetFirstLoss();
    }

    /// The code of the received close frame; 0 without one.
    [[nodiscard]] unsigned WaitForCloseCode()
    {
        std::optional<RawFrame> frame;
        static_cast<void>(WasReached([this, &frame] {
            frame = peer->TakeFrameOrNull();
            return frame.has_value() && frame->kind == EFrame::Close;
        }));
        return frame.has_value() && frame->payload.size() >= 2
            ? static_cast<unsigned char>(frame->payload[0]) * 256U + static_cast<unsigned char>(frame->payload[1])
            : 0U;
    }
};

long GetPeakKilobytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

Protocol::RobotStatusUpdate MakeStatus()
{
    Protocol::RobotStatusUpdate status;
    status.robotID = "LR01";
    return status;
}

} // namespace

TEST_CASE("13.11 A plan of 75 jobs in three fragments, text or binary, is one request")
{
    ClientWireFixture rig;
    rig.RegisterWithRaw();
    const EFrame kind = GENERATE(EFrame::Text, EFrame::Binary);
    const Protocol::AcsRequest plan{"p-1", {}, MakePlan(75)};
    const std::string text = Encode(plan);
    const std::size_t third = text.size() / 3;
    REQUIRE(third > 2'000);

    RawMCS& mcs = *rig.connections.at(0);
    mcs.Send(text.substr(0, third), kind, false);
    mcs.GetPeer().Write(MakeFrame({EFrame::Ping, "between", true}, false)); // control frames may be between
    mcs.Send(text.substr(third, third), EFrame::Continuation, false);
    mcs.Send(text.substr(2 * third), EFrame::Continuation, true);
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::RequestReceived>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::RequestReceived>()[0].request == plan);

    rig.client->Answer(EAcsCommand::ExecutionPlan, "p-1", Protocol::EAckResult::Success, "", Protocol::PlanAck{"P"});
    REQUIRE(rig.WasReached([&mcs] { return !mcs.acks.empty(); }));
    CHECK(mcs.acks[0].transactionID == "p-1");
}

TEST_CASE("1 A server takes text and binary, whole and in fragments, and an unsolicited PONG")
{
    ServerWireFixture rig;
    rig.Listen();
    rig.ConnectRaw();
    rig.peer->Write(MakeFrame({EFrame::Pong, "unasked", true}, true));
    rig.peer->Write(MakeFrame({EFrame::Binary, std::string(REGISTRATION.substr(0, 30)), false}, true));
    rig.peer->Write(MakeFrame({EFrame::Continuation, std::string(REGISTRATION.substr(30)), true}, true));
    REQUIRE(rig.WasReached([&rig] { return rig.server->IsRegistered(); }));
    rig.peer->Write(MakeFrame({EFrame::Text, Encode(MakeReport("r-1")), true}, true));
    REQUIRE(rig.WasReached([&rig] { return !rig.mcsEvents.GetAll<Protocol::RequestReceived>().empty(); }));
    CHECK(rig.mcsEvents.GetAll<Protocol::RequestReceived>()[0].request == MakeReport("r-1"));
}

TEST_CASE("1 Garbage in frames is counted and the connection continues")
{
    ServerWireFixture rig;
    rig.RegisterRaw();
    for (const std::string garbage : {"", "no json", "[[[[[[", "{\"command\":", "null"})
    {
        rig.peer->Write(MakeFrame({EFrame::Binary, garbage, true}, true));
    }
    rig.peer->Write(MakeFrame({EFrame::Text, Encode(MakeReport("r-1")), true}, true));
    REQUIRE(rig.WasReached([&rig] { return !rig.mcsEvents.GetAll<Protocol::RequestReceived>().empty(); }));
    CHECK(rig.server->GetStatistics().CountOf(Protocol::EProtocolNote::Undecodable) == 5);
    CHECK(rig.server->IsRegistered());
}

TEST_CASE("1 Either side answers a frame that announces 100 MB with 1009 before its payload arrives")
{
    const long before = GetPeakKilobytes();
    SECTION("server")
    {
        ServerWireFixture rig;
        rig.RegisterRaw();
        rig.peer->Write(MakeFrameHead({EFrame::Text, {}, true}, HUGE_FRAME, true));
        CHECK(rig.WaitForCloseCode() == 1009);
        rig.peer->Close();
        CHECK(rig.WasReached([&rig] { return !rig.GetFirstMcsLoss().empty(); }));
    }
    SECTION("client")
    {
        ClientWireFixture rig;
        rig.RegisterWithRaw();
        RawMCS& mcs = *rig.connections.at(0);
        mcs.GetPeer().Write(MakeFrameHead({EFrame::Text, {}, true}, HUGE_FRAME, false));
        REQUIRE(rig.WasReached([&mcs] { return !mcs.closes.empty(); }));
        CHECK(mcs.closes[0].payload.substr(0, 2) == "\x03\xF1");
        CHECK(rig.WasRegistered(2));
        CHECK(rig.acsEvents.GetFirstLoss() == "a message is longer than 4194304 bytes, the most that is taken");
    }
    CHECK(GetPeakKilobytes() - before < 50'000);
}

TEST_CASE("1 Fragments that are too long together are answered with 1009")
{
    ServerWireFixture rig;
    rig.serverOptions.link.maximumRead = 1'000;
    rig.RegisterRaw();
    rig.peer->Write(MakeFrame({EFrame::Text, std::string(900, ' '), false}, true));
    rig.peer->Write(MakeFrame({EFrame::Continuation, std::string(101, ' '), true}, true));
    CHECK(rig.WaitForCloseCode() == 1009);
}

TEST_CASE("12.1 By option only the last frame of a fragmented message is read; a long frame is read whole")
{
    ServerWireFixture rig;
    rig.serverOptions.link.bLastFrameOnly = true;
    rig.RegisterRaw();
    const std::string lost = Encode(MakeReport("lost"));
    rig.peer->Write(MakeFrame({EFrame::Text, lost.substr(0, 20), false}, true));
    rig.peer->Write(MakeFrame({EFrame::Continuation, lost.substr(20, 20), false}, true));
    rig.peer->Write(MakeFrame({EFrame::Continuation, lost.substr(40), true}, true));
    rig.peer->Write(MakeFrame({EFrame::Text, "lost as well", false}, true));
    rig.peer->Write(MakeFrame({EFrame::Continuation, Encode(MakeReport("end")), true}, true));
    rig.peer->Write(MakeFrame({EFrame::Text, std::string(1'000'000, ' ') + Encode(MakeReport("long")), true}, true));
    const auto& events = rig.mcsEvents;
    REQUIRE(rig.WasReached([&events] { return events.GetAll<Protocol::RequestReceived>().size() == 2; }));
    CHECK(events.GetAll<Protocol::RequestReceived>()[0].request == MakeReport("end"));
    CHECK(events.GetAll<Protocol::RequestReceived>()[1].request == MakeReport("long"));
    CHECK(rig.server->GetStatistics().CountOf(Protocol::EProtocolNote::Undecodable) == 1);
}

TEST_CASE("1 Either side drops a half-open peer that answers no ping")
{
    SECTION("server")
    {
        ServerWireFixture rig;
        rig.serverOptions.link.pingInterval = 20ms;
        rig.RegisterRaw();
        REQUIRE(rig.WasReached([&rig] { return !rig.GetFirstMcsLoss().empty(); }));
        CHECK(rig.GetFirstMcsLoss() == "the other side has not answered any ping");
        CHECK(rig.peer->TakeFrameOrNull().value_or(RawFrame{}).kind == EFrame::Ping);
    }
    SECTION("client")
    {
        ClientWireFixture rig;
        rig.clientOptions.link.pingInterval = 20ms;
        rig.RegisterWithRaw();
        REQUIRE(rig.WasLost());
        CHECK(rig.acsEvents.GetFirstLoss() == "the other side has not answered any ping");
        CHECK(rig.WasRegistered(2));
    }
}

TEST_CASE("1 A silent peer keeps a connection no longer than the limit of the handshake")
{
    SECTION("server")
    {
        ServerWireFixture rig;
        rig.serverOptions.link.handshakeTimeout = 20ms;
        rig.serverOptions.maximumClients = 1;
        rig.Listen();
        rig.peer = RawPeer::Connect(rig.io, rig.serverOptions.port);
        rig.peer->ReadAsync();
        REQUIRE(rig.WasReached([&rig] { return rig.peer->HasEnded(); }));
        rig.Connect(); // there is room again
        CHECK(rig.WasRegistered());
    }
    SECTION("client")
    {
        Fixture rig;
        const RawServer silent(rig.io);
        rig.clientOptions.link.handshakeTimeout = 20ms;
        rig.ConnectTo(silent.GetURL());
        REQUIRE(rig.WasLost(2));
        CHECK(rig.acsEvents.GetFirstLoss() == "the WebSocket handshake failed: the other side did not answer in time");
    }
}

TEST_CASE("1 The upgrade has extra headers and the configured Host; a header that would break the request is rejected")
{
    ClientWireFixture rig;
    rig.clientOptions.host = "127.0.0.1:9001";
    rig.clientOptions.headers = {{"Authorization", "Bearer secret"}, {"X-Site", "A"}};
    rig.RegisterWithRaw();
    const std::string& request = rig.connections.at(0)->GetPeer().GetRequest();
    CHECK(request.find("GET /acs/ HTTP/1.1\r\n") == 0);
    CHECK(request.find("\r\nHost: 127.0.0.1:9001\r\n") != std::string::npos);
    CHECK(request.find("\r\nAuthorization: Bearer secret\r\n") != std::string::npos);
    CHECK(request.find("\r\nX-Site: A\r\n") != std::string::npos);
    CHECK(request.find("permessage-deflate") == std::string::npos);

    using Header = std::pair<std::string, std::string>;
    for (const Header& bad :
         {Header{"X-A", "secret\r\nEvil: 1"},
          Header{"X A", "1"},
          Header{"", "1"},
          Header{"X-A:", "1"},
          Header{"upgrade", "h2c"}})
    {
        rig.clientOptions.headers = {bad};
        const auto refused = rig.TryMakeClient(rig.acsEvents);
        REQUIRE_FALSE(refused.has_value());
        CHECK(Core::Describe(refused.error()).find("headers") == 0);
        CHECK(Core::Describe(refused.error()).find("secret") == std::string::npos);
    }
    rig.clientOptions.headers.clear();
    rig.clientOptions.host = "x\r\nEvil: 1";
    CHECK_FALSE(rig.TryMakeClient(rig.acsEvents).has_value());
}

TEST_CASE("13.10 After RST in mid frame, 403 and 1008 the client reconnects, registers, replays and reports its state")
{
    ClientWireFixture rig;
    // What a connection does at the first report: each kind of loss in turn, then none.
    rig.onConnection = [](std::size_t index, RawMCS& mcs) {
        if (index == 1)
        {
            mcs.GetPeer().onChange = [&mcs] {
                if (!mcs.GetPeer().TakeHead().empty())
                {
                    mcs.GetPeer().Write("HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n");
                }
            };
            return;
        }
        mcs.onRequest = [index, &mcs](const Protocol::AcsRequest& request) {
            const bool bReport = GetCommand(request) == EAcsCommand::PlanReport;
            if (bReport && index == 0)
            {
                mcs.GetPeer().Write(MakeFrameHead({EFrame::Text, {}, true}, 5'000, false) + R"({"command":"Exec)");
                mcs.GetPeer().Reset();
            }
            if (bReport && index == 2)
            {
                mcs.Send("\x03\xF0not today", EFrame::Close);
            }
            return !bReport || index == 3;
        };
    };
    rig.acsEvents.onEvent = [&rig](const Protocol::SessionEvent& event) {
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            CHECK(rig.client->TrySendDurable(MakeReport("a")));
            CHECK(rig.client->TrySendDurable(MakeReport("b")));
            rig.client->ReplayDone();
        }
    };
    rig.clientOptions.session.positionInterval = 10ms;
    rig.ConnectTo(rig.raw.GetURL());
    rig.client->SendStatus(Protocol::TscStateUpdate{});
    rig.client->SendStatus(Protocol::AcsCommStateUpdate{});
    rig.client->SendStatus(MakeStatus());
    REQUIRE(rig.WasReached([&rig] {
        return !rig.acsEvents.GetAll<Protocol::PositionDue>().empty() && rig.connections.size() == 4
            && rig.connections[3]->requests.size() >= 6;
    }));

    const auto losses = rig.acsEvents.GetAll<Protocol::LinkLost>();
    REQUIRE(losses.size() == 3);
    CHECK(losses[0].bWasRegistered);
    CHECK(losses[0].reason.find("the connection broke: ") == 0);
    CHECK(losses[1].reason == "the server refused the connection with HTTP 403");
    CHECK(losses[2].reason == "closed by the other side with code 1008: not today");
    const std::vector<EAcsCommand> commands = rig.connections[3]->GetCommands();
    const std::vector<EAcsCommand> wanted{
        EAcsCommand::Registration,
        EAcsCommand::PlanReport,
        EAcsCommand::PlanReport,
        EAcsCommand::TscStateUpdate,
        EAcsCommand::AcsCommStateUpdate,
        EAcsCommand::RobotStatusUpdate};
    CHECK(std::vector<EAcsCommand>(commands.begin(), commands.begin() + 6) == wanted);
    CHECK(rig.connections[3]->requests[1] == MakeReport("a"));
    CHECK(rig.connections[3]->requests[2] == MakeReport("b"));
    CHECK(rig.connections[0]->requests[1] == MakeReport("a"));
}

TEST_CASE("1 The reason of a peer that closes is reported, also without a code")
{
    ClientWireFixture rig;
    rig.onConnection = [](std::size_t /*index*/, RawMCS& mcs) {
        mcs.onRequest = [&mcs](const Protocol::AcsRequest& /*request*/) {
            mcs.Send("", EFrame::Close);
            return false;
        };
    };
    rig.ConnectTo(rig.raw.GetURL());
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::LinkLost>().empty(); }));
    CHECK(rig.acsEvents.GetFirstLoss() == "closed by the other side without a code");
}

TEST_CASE("1 The reason of a peer that closes and does not wait for the answer is reported")
{
    ClientWireFixture rig;
    rig.onConnection = [](std::size_t /*index*/, RawMCS& mcs) {
        mcs.onRequest = [&mcs](const Protocol::AcsRequest& /*request*/) {
            mcs.Send("\x03\xF0token withdrawn", EFrame::Close);
            mcs.GetPeer().Close();
            return false;
        };
    };
    rig.ConnectTo(rig.raw.GetURL());
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::LinkLost>().empty(); }));
    CHECK(rig.acsEvents.GetFirstLoss() == "closed by the other side with code 1008: token withdrawn");
}

TEST_CASE("1 A link ends for its reason although the other side keeps the TCP connection after the last close frame")
{
    struct Case
    {
        std::string bytes;
        std::string reason;
    };
    const bool bMasked = GENERATE(true, false); // as a client, as a server
    const Case last = GENERATE_COPY(
        Case{
            MakeFrame({EFrame::Close, "\x03\xE9going", true}, bMasked),
            "closed by the other side with code 1001: going"},
        Case{
            MakeFrameHead({EFrame::Text, {}, true}, HUGE_FRAME, bMasked),
            "a message is longer than 4194304 bytes, the most that is taken"},
        Case{
            MakeFrame({EFrame::Text, "{\"planId\":\"\xB0\xE8\"}", true}, bMasked),
            "the other side sent a text that is not UTF-8"});
    ProtocolBeast::LinkOptions options;
    options.handshakeTimeout = options.pingInterval = 1h;
    options.closeTimeout = 20ms;
    if (bMasked)
    {
        ServerWireFixture rig;
        rig.serverOptions.link = options;
        rig.RegisterRaw();
        rig.peer->Write(last.bytes);
        REQUIRE(rig.WasReached([&rig] { return !rig.GetFirstMcsLoss().empty(); }));
        CHECK(rig.GetFirstMcsLoss() == last.reason);
        rig.Connect(); // the place is free
        CHECK(rig.WasRegistered());
        return;
    }
    ClientWireFixture rig;
    rig.clientOptions.link = options;
    rig.onConnection = [](std::size_t /*index*/, RawMCS& mcs) {
        mcs.bKeepsOpen = true;
    };
    rig.RegisterWithRaw();
    rig.connections.at(0)->GetPeer().Write(last.bytes);
    REQUIRE(rig.WasLost());
    CHECK(rig.acsEvents.GetFirstLoss() == last.reason);
    CHECK(rig.WasRegistered(2));
}

TEST_CASE("1 A client that ends with RST in mid frame is dropped, and the next one is served")
{
    ServerWireFixture rig;
    rig.RegisterRaw();
    rig.peer->Write(MakeFrameHead({EFrame::Text, {}, true}, 5'000, true) + "{\"command\":");
    rig.peer->Reset();
    REQUIRE(rig.WasReached([&rig] { return !rig.GetFirstMcsLoss().empty(); }));
    CHECK(rig.GetFirstMcsLoss().find("the connection broke: ") == 0);
    rig.Connect();
    CHECK(rig.WasRegistered());
}

TEST_CASE("1 A link with more bytes to write than the limit is dropped and connected again")
{
    ClientWireFixture rig;
    rig.raw.SetReceiveBuffer(16'384);
    rig.clientOptions.link.maximumQueued = 2'000'000;
    rig.RegisterWithRaw();
    rig.connections.at(0)->GetPeer().StopReading();
    for (int i = 0; i < 3; ++i)
    {
        REQUIRE(rig.client->TrySendDurable(MakeReport(std::to_string(i), std::string(900'000, 'x'))));
    }
    REQUIRE(rig.WasLost());
    CHECK(rig.acsEvents.GetFirstLoss() == "the other side does not read: too much waits to be written");
    CHECK(rig.WasRegistered(2));
}
