#include "CertificateMaker.hpp"
#include "RawPeer.hpp"
#include "TemporaryFolder.hpp"
#include "WebSocketFixture.hpp"
#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// Which clients an application lets in: ServerOptions::checkUpgrade.

using namespace ACS; // NOLINT(google-build-using-namespace)
using ProtocolBeast::FindHeaderOrNull;
using ProtocolBeast::HttpHeaders;
using ProtocolBeast::UpgradeRefusal;
using ProtocolBeast::UpgradeRequest;
using Testing::CertificateFiles;
using Testing::RawPeer;

namespace
{

constexpr const char* TOKEN = "Bearer right";

/// The request of a WebSocket client. The headers end with a line end.
std::string MakeUpgrade(const std::string& headers = {}, const std::string& target = "/acs/")
{
    return "GET " + target + " HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        + "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" + headers + "\r\n";
}

std::string MakeAuthorization(const std::string& value = TOKEN)
{
    return "Authorization: " + value + "\r\n";
}

/// A server whose application records the requests, and accepts those with the token.
class GuardedFixture : public Testing::WebSocketFixture
{
public:
    std::vector<UpgradeRequest> requests;
    UpgradeRefusal refusal{401, "A token is required.\n", {{"WWW-Authenticate", "Bearer"}}};

    GuardedFixture()
    {
        serverOptions.checkUpgrade = [this](const UpgradeRequest& request) -> std::optional<UpgradeRefusal> {
            requests.push_back(request);
            const std::string* const valueOrNull = FindHeaderOrNull(request.headers, "authorization");
            return valueOrNull != nullptr && *valueOrNull == TOKEN ? std::nullopt : std::optional(refusal);
        };
    }

    /// The whole answer to these bytes; of an accepted client the head.
    [[nodiscard]] std::string Talk(const std::string& bytes)
    {
        const auto peer = RawPeer::Connect(io, serverOptions.port);
        peer->Write(bytes);
        peer->ReadAsync();
        std::string head;
        REQUIRE(WasReached([&peer, &head] {
            if (head.empty())
            {
                head = peer->TakeHead();
            }
            return peer->HasEnded() || head.find("HTTP/1.1 101") == 0;
        }));
        return head + peer->GetReceived();
    }
};

bool HasPart(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("An application sees peer, target and headers of an upgrade, and the connection of the events that follow")
{
    GuardedFixture rig;
    rig.clientOptions.headers = {{"Authorization", TOKEN}, {"X-Site", "hall 2"}, {"x-site", "hall 3"}};
    rig.Listen();
    rig.Connect("/acs/?robots=2");
    REQUIRE(rig.WasRegistered());
    rig.client->ReplayDone();
    REQUIRE(rig.client->TrySendDurable(Testing::MakeReport("r-1")));
    REQUIRE(rig.WasReached([&rig] { return !rig.mcsEvents.GetAll<Protocol::RequestReceived>().empty(); }));

    REQUIRE(rig.requests.size() == 1);
    const UpgradeRequest& request = rig.requests[0];
    CHECK(request.peerAddress == "127.0.0.1");
    CHECK(request.peerPort != 0);
    CHECK(request.peerPort != rig.serverOptions.port);
    CHECK(request.target == "/acs/?robots=2");
    CHECK(rig.sink.ContainsField("url", "ws://127.0.0.1:" + std::to_string(rig.serverOptions.port) + "/acs/?***"));
    CHECK(request.certificateSubject.empty());
    CHECK(*FindHeaderOrNull(request.headers, "UPGRADE") == "websocket");
    CHECK(request.connection == rig.mcsEvents.GetAll<Protocol::RequestReceived>()[0].connection);
}

TEST_CASE("A refused client gets status, reason and headers, and the session has no connection of it")
{
    GuardedFixture rig;
    rig.serverOptions.maximumClients = 1;
    rig.Listen();
    const std::string answer = rig.Talk(MakeUpgrade(MakeAuthorization("Bearer wrong")));
    CHECK(answer.find("HTTP/1.1 401 Unauthorized\r\n") == 0);
    CHECK(HasPart(answer, "\r\nWWW-Authenticate: Bearer\r\n"));
    CHECK(HasPart(answer, "\r\n\r\nA token is required.\n"));
    CHECK(rig.WasReached([&rig] { return rig.sink.ContainsField("reason", "answered with HTTP 401"); }));

    rig.Connect();
    REQUIRE(rig.WasLost(2));
    CHECK(rig.acsEvents.GetFirstLoss() == "the server refused the connection with HTTP 401: \"A token is required.\"");
    CHECK(rig.mcsEvents.events.empty());
    CHECK_FALSE(rig.server->IsRegistered());

    rig.client.reset();
    rig.clientOptions.headers = {{"authorization", TOKEN}};
    rig.Connect();
    CHECK(rig.WasRegistered());
}

TEST_CASE("The reason of a refusal is shown in the language of the MCS, without control characters and limited")
{
    GuardedFixture rig;
    rig.refusal.text = "등록되지 않은 ACS입니다.\nA\x1b[31m";
    rig.Listen();
    rig.Connect();
    REQUIRE(rig.WasLost(1));
    CHECK(
        rig.acsEvents.GetFirstLoss()
        == "the server refused the connection with HTTP 401: \"등록되지 않은 ACS입니다. A [31m\"");
}

TEST_CASE("An application is not asked about requests that are no upgrade at the server's path")
{
    GuardedFixture rig;
    rig.Listen();
    const std::string token = MakeAuthorization();
    CHECK(rig.Talk("GET /acs/ HTTP/1.1\r\nHost: x\r\n" + token + "\r\n").find("HTTP/1.1 426") == 0);
    CHECK(rig.Talk(MakeUpgrade(token, "/other")).find("HTTP/1.1 404") == 0);
    CHECK(rig.Talk("POST\r\n\r\n").find("HTTP/1.1 400") == 0);
    CHECK(rig.requests.empty());
    CHECK(rig.Talk(MakeUpgrade(token, "/acs")).find("HTTP/1.1 101") == 0);
}

TEST_CASE("With an empty path an application decides about every path")
{
    GuardedFixture rig;
    rig.serverOptions.path.clear();
    rig.refusal.status = 404;
    rig.Listen();
    const std::string target = GENERATE("/", "/line-1/acs/", "/acs/%2e%2e/secret", "http://other/acs/", "*");
    CHECK(rig.Talk(MakeUpgrade({}, target)).find("HTTP/1.1 404") == 0);
    REQUIRE(rig.requests.size() == 1);
    CHECK(rig.requests[0].target == target);
}

TEST_CASE("A header that is too long or malformed never reaches the application")
{
    GuardedFixture rig;
    rig.Listen();
    const std::string bad = GENERATE(
        MakeUpgrade(MakeAuthorization(std::string(20'000, 'x'))),
        MakeUpgrade(std::string(20'000, 'x') + ": y\r\n"),
        MakeUpgrade({}, "/" + std::string(20'000, 'x')),
        MakeUpgrade(MakeAuthorization(std::string("Bearer\0right", 12))),
        MakeUpgrade(MakeAuthorization("Bearer\x01right")),
        MakeUpgrade("Authorization : Bearer right\r\n"),
        MakeUpgrade("No colon\r\n"),
        MakeUpgrade(": no name\r\n"));
    CHECK(rig.Talk(bad).find("HTTP/1.1 400") == 0);
    CHECK(rig.requests.empty());
}

TEST_CASE("A header that comes twice is like a missing one, so that no client chooses which one counts")
{
    GuardedFixture rig;
    rig.Listen();
    CHECK(rig.Talk(MakeUpgrade(MakeAuthorization() + "AUTHORIZATION: Bearer right\r\n")).find("HTTP/1.1 401") == 0);

    const HttpHeaders headers{{"A", "1"}, {"b", "2"}, {"B", "2"}, {"", "3"}};
    REQUIRE(FindHeaderOrNull(headers, "a") != nullptr);
    CHECK(*FindHeaderOrNull(headers, "a") == "1");
    CHECK(FindHeaderOrNull(headers, "B") == nullptr);
    CHECK(FindHeaderOrNull(headers, "c") == nullptr);
    CHECK(FindHeaderOrNull({}, "a") == nullptr);
}

TEST_CASE("A value may have bytes that are not valid UTF-8")
{
    GuardedFixture rig;
    rig.Listen();
    CHECK(rig.Talk(MakeUpgrade(MakeAuthorization("\xFF\xFE\tx"))).find("HTTP/1.1 401") == 0);
    REQUIRE(rig.requests.size() == 1);
    CHECK(*FindHeaderOrNull(rig.requests[0].headers, "Authorization") == "\xFF\xFE\tx");
}

TEST_CASE("A refusal with a status that is no error is sent as 403, invalid headers of it are left out")
{
    GuardedFixture rig;
    rig.refusal = {GENERATE(0U, 101U, 200U, 399U, 600U, 4'000'000'000U), "", {{"X-A", "1\r\nX-B: 2"}, {"X-C", "3"}}};
    rig.Listen();
    const std::string answer = rig.Talk(MakeUpgrade());
    CHECK(answer.find("HTTP/1.1 403 Forbidden\r\n") == 0);
    CHECK_FALSE(HasPart(answer, "X-"));
}

TEST_CASE("A client that an application accepts is still refused where an ACS is connected")
{
    GuardedFixture rig;
    rig.serverOptions.session.bSecondRefused = true;
    rig.clientOptions.headers = {{"Authorization", TOKEN}};
    rig.RegisterBoth();
    CHECK(rig.Talk(MakeUpgrade()).find("HTTP/1.1 401") == 0);
    CHECK(rig.Talk(MakeUpgrade(MakeAuthorization())).find("HTTP/1.1 403") == 0);
}

TEST_CASE("Clients that disconnect at once, and a server that ends, leave nothing behind")
{
    GuardedFixture rig;
    rig.serverOptions.maximumClients = 2;
    rig.Listen();
    for (std::size_t count = 0; count < 20; ++count)
    {
        const auto peer = RawPeer::Connect(rig.io, rig.serverOptions.port);
        peer->Write(MakeUpgrade());
        peer->Reset();
    }
    CHECK(rig.WasReached([&rig] {
        rig.client.reset();
        rig.clientOptions.headers = {{"Authorization", TOKEN}};
        rig.Connect();
        return rig.WasRegistered();
    }));
    const auto waiting = RawPeer::Connect(rig.io, rig.serverOptions.port);
    waiting->Write(MakeUpgrade().substr(0, 20));
    rig.server.reset();
    const std::size_t asked = rig.requests.size();
    waiting->Write(MakeUpgrade().substr(20));
    waiting->ReadAsync();
    CHECK(rig.WasReached([&waiting] { return waiting->HasEnded(); }));
    CHECK(rig.requests.size() == asked);
}

TEST_CASE("wss: an application sees the subject of a client certificate that the CA has issued")
{
    GuardedFixture rig;
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const CertificateFiles ca = maker.MakeCA("ca");
    const CertificateFiles own = maker.Make(ca, {});
    rig.serverOptions.tls = {ca.certificate, own.certificate, own.key, {}};
    rig.clientOptions.tls.caFile = ca.certificate;
    rig.clientOptions.headers = {{"Authorization", TOKEN}};
    Testing::CertificateRequest wanted;
    std::string subject;
    SECTION("a plain name")
    {
        wanted.commonName = "acs-1";
        subject = "CN=acs-1";
    }
    SECTION("a name that imitates another one")
    {
        wanted.commonName = "acs-1,O=Plant";
        subject = "CN=acs-1\\,O=Plant";
    }
    SECTION("a name with a line end")
    {
        wanted.commonName = "acs-1\n";
        subject = "CN=acs-1\\0A";
    }
    const CertificateFiles client = maker.Make(ca, wanted);
    rig.clientOptions.tls.certificateFile = client.certificate;
    rig.clientOptions.tls.keyFile = client.key;
    rig.Listen();
    rig.ConnectTo(rig.GetURL("/acs/", "localhost"));
    REQUIRE(rig.WasRegistered());
    REQUIRE(rig.requests.size() == 1);
    CHECK(rig.requests[0].certificateSubject == subject);
    CHECK(rig.requests[0].peerAddress == "127.0.0.1");
}

TEST_CASE("wss: without a client CA no certificate is demanded, and there is no subject")
{
    GuardedFixture rig;
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const CertificateFiles ca = maker.MakeCA("ca");
    const CertificateFiles own = maker.Make(ca, {});
    rig.serverOptions.tls = {{}, own.certificate, own.key, {}};
    rig.clientOptions.tls = {ca.certificate, own.certificate, own.key, {}};
    rig.clientOptions.headers = {{"Authorization", TOKEN}};
    rig.Listen();
    rig.ConnectTo(rig.GetURL("/acs/", "localhost"));
    REQUIRE(rig.WasRegistered());
    CHECK(rig.requests.at(0).certificateSubject.empty());
}

TEST_CASE("An application closes the connection of the registered ACS, which may connect again")
{
    GuardedFixture rig;
    rig.clientOptions.headers = {{"Authorization", TOKEN}};
    rig.Listen();
    CHECK_FALSE(rig.server->GetRegisteredOrNull().has_value());
    rig.Connect();
    REQUIRE(rig.WasRegistered());
    const std::optional<Protocol::ConnectionID> registered = rig.server->GetRegisteredOrNull();
    REQUIRE(registered.has_value());
    rig.server->Close(*registered + 1, "a connection that does not exist");
    rig.server->Close(*registered, "the token \xED\x86\xA0\xED\x81\xB0 was withdrawn");
    rig.server->Close(*registered, "again");
    REQUIRE(rig.WasLost());
    CHECK(HasPart(rig.acsEvents.GetFirstLoss(), "the token \xED\x86\xA0\xED\x81\xB0 was withdrawn"));
    CHECK(rig.WasReached([&rig, &registered] {
        const std::optional<Protocol::ConnectionID> next = rig.server->GetRegisteredOrNull();
        return next.has_value() && *next != *registered;
    }));
}

TEST_CASE("A reason that is not UTF-8 does not break the closing handshake")
{
    GuardedFixture rig;
    rig.clientOptions.headers = {{"Authorization", TOKEN}};
    rig.Listen();
    rig.Connect();
    REQUIRE(rig.WasRegistered());
    rig.server->Close(*rig.server->GetRegisteredOrNull(), "bad \xFF token");
    REQUIRE(rig.WasLost());
    CHECK(HasPart(rig.acsEvents.GetFirstLoss(), "1008"));
    CHECK(HasPart(rig.acsEvents.GetFirstLoss(), "bad ? token"));
}
