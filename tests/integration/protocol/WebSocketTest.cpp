#include "CertificateMaker.hpp"
#include "RawPeer.hpp"
#include "TemporaryFolder.hpp"
#include "TwoAddresses.hpp"
#include "WebSocketFixture.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Testing::MakePlan;
using Testing::MakeReport;
using Testing::PATIENCE;
using Recorder = Testing::SessionRecorder;

namespace
{

/// Over TLS where it is wanted.
class LinkWireFixture : public Testing::WebSocketFixture
{
    Testing::TemporaryFolder _folder;

public:
    explicit LinkWireFixture(bool bSecure = false)
    {
        if (bSecure)
        {
            Testing::CertificateMaker maker(_folder.GetPath());
            const Testing::CertificateFiles ca = maker.MakeCA("ca");
            const Testing::CertificateFiles files = maker.Make(ca, {});
            serverOptions.tls = ProtocolBeast::TlsOptions{{}, files.certificate, files.key, {}};
            clientOptions.tls.caFile = ca.certificate;
        }
    }

    /// The answer to a client that does not use WebSocket.
    [[nodiscard]] std::string TalkRaw(const std::string& text)
    {
        const auto peer = Testing::RawPeer::Connect(io, serverOptions.port);
        peer->Write(text);
        peer->ReadAsync();
        CHECK(WasReached([&peer] { return peer->HasEnded(); }));
        return peer->GetReceived();
    }
};

} // namespace

TEST_CASE("6 Over a real socket, ws and wss: register, plan, Ack, reports, isConnected=false")
{
    LinkWireFixture rig(GENERATE(false, true));
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

TEST_CASE("6 Over a real socket the application accepts the registration, then refuses a report")
{
    LinkWireFixture rig(false);
    for (const EAcsCommand command : {EAcsCommand::Registration, EAcsCommand::PlanReport})
    {
        rig.serverOptions.session.answeredByApplication.set(static_cast<std::size_t>(command));
    }
    rig.Listen();
    rig.Connect();
    const auto getToken = [&rig](std::size_t index) {
        REQUIRE(
            rig.WasReached([&rig, index] { return rig.mcsEvents.GetAll<Protocol::RequestReceived>().size() > index; }));
        return rig.mcsEvents.GetAll<Protocol::RequestReceived>()[index].token;
    };
    const Protocol::AnswerToken registration = getToken(0);
    CHECK_FALSE(rig.server->IsRegistered());
    CHECK(rig.server->GetUnansweredCount() == 1);
    REQUIRE(rig.server->TryAnswer(registration, EAckResult::Success, "Welcome."));
    REQUIRE(rig.WasReached([&rig] { return rig.client->IsRegistered(); }));

    REQUIRE(rig.client->TrySendDurable(MakeReport("rep-1")));
    const Protocol::AnswerToken report = getToken(1);
    CHECK(rig.acsEvents.GetAll<Protocol::Acked>().empty());
    REQUIRE(rig.server->TryAnswer(report, EAckResult::Fail, "Unknown plan."));
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::Acked>()[0].result == EAckResult::Fail);
    CHECK(rig.acsEvents.GetAll<Protocol::Acked>()[0].message == "Unknown plan.");
    CHECK_FALSE(rig.server->TryAnswer(report, EAckResult::Success, ""));
}

TEST_CASE("1 After a lost link, ws and wss, the client registers again and unacknowledged reports are sent again")
{
    LinkWireFixture rig(GENERATE(false, true));
    rig.RegisterBoth();
    REQUIRE(rig.client->TrySendDurable(MakeReport("a")));
    rig.CloseFromServer(Protocol::CLOSE_ABNORMAL, "cut");
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

TEST_CASE("1 The client reconnects to a server that restarts on its port")
{
    LinkWireFixture rig;
    rig.RegisterBoth();
    rig.server.reset();
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::LinkLost>().size() >= 3; }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().at(2).reason.find("cannot connect to 127.0.0.1") == 0);
    rig.Listen();
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::Registered>().size() == 2; }));
}

TEST_CASE("A server at the second address of its host is reached although the first one does not answer")
{
    Fixture rig;
    rig.Listen();
    const Testing::TwoAddresses addresses(rig.io, rig.serverOptions.port);
    rig.clientOptions.link.handshakeTimeout = 50ms;
    rig.ConnectTo(rig.GetURL("/acs/", Testing::TwoAddresses::HOST));
    CHECK(rig.WasRegistered());
    CHECK(rig.WasLost());
}

TEST_CASE("12.3 After a close with 1008 the client tries again")
{
    LinkWireFixture rig;
    rig.RegisterBoth();
    rig.CloseFromServer(1008, "not today");
    REQUIRE(rig.WasReached([&rig] { return rig.acsEvents.GetAll<Protocol::Registered>().size() == 2; }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().at(0).reason.find("1008: not today") != std::string::npos);
}

TEST_CASE("1 A close reason that is too long for its frame is truncated between characters")
{
    LinkWireFixture rig;
    rig.RegisterBoth();
    std::string reason = "x"; // the 123 bytes of a close frame end within the 41st of the characters that follow
    for (int i = 0; i < 50; ++i)
    {
        reason += "\xEA\xB0\x80";
    }
    rig.CloseFromServer(1008, reason);
    REQUIRE(rig.WasLost());
    CHECK(rig.acsEvents.GetFirstLoss().find("1008: " + reason.substr(0, 121)) != std::string::npos);
    CHECK(rig.acsEvents.GetFirstLoss().find("1008: " + reason.substr(0, 122)) == std::string::npos);
}

TEST_CASE("12.3 By option a second client is rejected with 403, and keeps trying")
{
    LinkWireFixture rig;
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

TEST_CASE("1 A wrong path is answered with 404, plain HTTP with 426, garbage with 400")
{
    LinkWireFixture rig;
    rig.Listen();
    const std::string other = rig.TalkRaw("GET /other HTTP/1.1\r\nHost: x\r\n\r\n");
    CHECK(other.find("HTTP/1.1 404") == 0);
    CHECK(other.find("The ACS connects at /acs/.") != std::string::npos);
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

TEST_CASE("1 Garbage inside a WebSocket is counted and the connection continues")
{
    LinkWireFixture rig;
    rig.RegisterBoth();
    // A plan with a name that no JSON text can hold is written with a replacement, so that the peer can read it.
    REQUIRE(rig.client->TrySendDurable(MakeReport("bad \xFF utf-8")));
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.client->IsRegistered());
    CHECK(rig.server->IsRegistered());
}

TEST_CASE("The error about a port in use or a bad address names it")
{
    LinkWireFixture rig;
    rig.Listen();
    const auto second = rig.TryListen();
    REQUIRE_FALSE(second.has_value());
    const std::string sentence = Core::Describe(second.error());
    CHECK(sentence.find("127.0.0.1:" + std::to_string(rig.serverOptions.port)) != std::string::npos);
    CHECK(sentence.find("choose another") != std::string::npos);
    CHECK(sentence.find("Address already in use") != std::string::npos);
}

TEST_CASE("An MCS can listen on a host name")
{
    LinkWireFixture rig;
    rig.serverOptions.address = "localhost";
    rig.Listen();
    CHECK(rig.server->GetPort() != 0);
}

TEST_CASE("An invalid URL is rejected with the reason")
{
    LinkWireFixture rig;
    for (const std::string url :
         {"",
          "http://x/",
          "ws://",
          "ws://:80/",
          "ws://x:0/",
          "ws://x:99999/",
          "ws://u@x/",
          "ws://x/\r\nEvil: 1",
          "wss://",
          "wss://x:0/"})
    {
        INFO(url);
        rig.clientOptions.url = url;
        const auto refused = rig.TryMakeClient(rig.acsEvents);
        REQUIRE_FALSE(refused.has_value());
        CHECK(Core::Describe(refused.error()).find("wss://host[:port][/path]") != std::string::npos);
    }
}

TEST_CASE("After destruction, ws and wss, no handler is called and nothing is left to run")
{
    LinkWireFixture rig(GENERATE(false, true));
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

TEST_CASE("An observer gets every text of both directions before the session handles it")
{
    LinkWireFixture rig;
    std::vector<std::string> seen;
    rig.serverOptions.onWire =
        [&seen](ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text) {
            const std::string arrow = direction == ProtocolBeast::EWireDirection::In ? "in " : "out ";
            const std::size_t start = text.find(R"("command":")") + 11;
            seen.push_back(
                arrow + std::to_string(connection) + " "
                + std::string(text.substr(start, text.find('"', start) - start)));
        };
    rig.RegisterBoth();
    CHECK(seen == std::vector<std::string>{"in 1 Registration", "out 1 RegistrationAck"});
}

TEST_CASE("A text that the client sends past its session arrives as it is, and without a connection it has no effect")
{
    LinkWireFixture rig;
    rig.Listen();
    rig.Connect();
    rig.client->SendText("{"); // Not connected yet.
    REQUIRE(rig.WasRegistered());
    rig.client->ReplayDone();
    rig.client->SendText(R"({"command":"Dance","transactionId":"d-1","payload":{}})");
    REQUIRE(rig.client->TrySendDurable(Testing::MakeReport("r-1")));
    REQUIRE(rig.WasReached([&rig] { return !rig.acsEvents.GetAll<Protocol::Acked>().empty(); }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().empty());
    std::vector<Protocol::EProtocolNote> notes;
    for (const Protocol::ProtocolNoted& noted : rig.mcsEvents.GetAll<Protocol::ProtocolNoted>())
    {
        notes.push_back(noted.what);
    }
    CHECK(std::ranges::count(notes, Protocol::EProtocolNote::UnknownCommand) == 1);
    CHECK(std::ranges::count(notes, Protocol::EProtocolNote::Undecodable) == 0);
}
