#include "common/http/HttpServer.hpp"

#include "Catch.hpp"
#include "common/http/HttpPendingResponse.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "HttpServerFixture.hpp"
#include "RawHttpClient.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace Apps = ACS::Apps;
namespace Core = ACS::Core;
namespace Testing = ACS::Testing;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace
{

constexpr auto LIMIT = 10s;
constexpr const char* LOOPBACK = "127.0.0.1";

using Fixture = Testing::HttpServerFixture;
using RawClient = Testing::RawHttpClient;

} // namespace

TEST_CASE("The handler gets the decoded request and the peer gets its response")
{
    Fixture fixture;
    fixture.answer = {404, "application/json", "{\"no\":1}"};
    RawClient client(fixture.context, fixture.port);
    client.Send("POST /tasks%5B0%5D/x?type=io HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n\r\nbody");
    REQUIRE(client.HasReceived("{\"no\":1}"));
    const std::string answer = client.TakeReceived();
    REQUIRE_THAT(answer, StartsWith("HTTP/1.1 404 Not Found\r\n"));
    REQUIRE_THAT(answer, Contains("Content-Type: application/json\r\n"));
    REQUIRE_THAT(answer, Contains("Content-Length: 8\r\n"));
    REQUIRE(fixture.requests.size() == 1);
    REQUIRE(fixture.requests[0].method == "POST");
    REQUIRE(fixture.requests[0].path == "/tasks[0]/x");
    REQUIRE(fixture.requests[0].GetQueryOrNull("type") == "io");
    REQUIRE(fixture.requests[0].body == "body");
    REQUIRE(fixture.requests[0].target == "/tasks%5B0%5D/x?type=io");
}

TEST_CASE("The handler gets the peer and its Authorization; a response can have a challenge")
{
    Fixture fixture;
    fixture.answer.status = 401;
    fixture.answer.challenge = "Bearer realm=\"test\"";
    RawClient client(fixture.context, fixture.port, "127.0.0.5");
    client.Send("GET / HTTP/1.1\r\nHost: x\r\nauthorization: Bearer abc\r\n\r\nGET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(fixture.IsReached([&fixture] { return fixture.requests.size() == 2; }));
    REQUIRE(client.HasReceived("WWW-Authenticate: Bearer realm=\"test\"\r\n"));
    CHECK(fixture.requests[0].sender.peer.host == "127.0.0.5");
    CHECK(fixture.requests[0].sender.peer.port != 0);
    CHECK(fixture.requests[0].sender.authorization == "Bearer abc");
    CHECK(fixture.requests[1].sender.authorization.empty());
    CHECK(fixture.requests[1].sender.certificateName.empty());
}

TEST_CASE("A connection answers one request after the other, also if they arrive in pieces or together")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("GET /1 HT");
    client.Send("TP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    (void)client.TakeReceived();
    client.Send("GET /2 HTTP/1.1\r\nHost: x\r\n\r\nGET /3 HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    REQUIRE(client.WasClosed());
    REQUIRE(fixture.requests.size() == 3);
    REQUIRE(fixture.requests[2].path == "/3");
}

TEST_CASE("A delayed response delays neither other connections nor Stop")
{
    Fixture fixture;
    fixture.answer.delay = 1h;
    RawClient slow(fixture.context, fixture.port);
    slow.Send("GET /slow HTTP/1.1\r\nHost: x\r\n\r\n");
    RawClient gone(fixture.context, fixture.port);
    gone.Send("GET /gone HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(fixture.IsReached([&fixture] { return fixture.requests.size() == 2; }));
    fixture.answer.delay = 20ms;
    const auto asked = std::chrono::steady_clock::now();
    RawClient other(fixture.context, fixture.port);
    other.Send("GET /1 HTTP/1.1\r\nHost: x\r\n\r\nHEAD /2 HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    REQUIRE(other.WasClosed());
    CHECK(std::chrono::steady_clock::now() - asked >= 40ms);
    const std::string received = other.TakeReceived();
    CHECK(received.find("<answer>") != std::string::npos);
    CHECK(received.find("<answer>") == received.rfind("<answer>"));
    fixture.server->Stop();
    REQUIRE(slow.WasClosed());
    CHECK(slow.TakeReceived().empty());
}

TEST_CASE("A response that is completed later delays no other one, and is dropped if its connection is gone")
{
    Fixture fixture;
    std::vector<std::shared_ptr<Apps::HttpPendingResponse>> pending;
    fixture.respond = [&](const Apps::HttpRequest& request) {
        Apps::HttpResponse response = fixture.answer;
        if (request.path == "/later")
        {
            response.pending = pending.emplace_back(std::make_shared<Apps::HttpPendingResponse>());
        }
        return response;
    };
    RawClient later(fixture.context, fixture.port);
    later.Send("GET /later HTTP/1.1\r\nHost: x\r\n\r\nGET /next HTTP/1.1\r\nHost: x\r\n\r\n");
    auto gone = std::make_unique<RawClient>(fixture.context, fixture.port);
    gone->Send("GET /later HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(fixture.IsReached([&pending] { return pending.size() == 2; }));
    gone.reset();
    RawClient other(fixture.context, fixture.port);
    other.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(other.HasReceived("<answer>"));
    CHECK(later.TakeReceived().empty());
    for (const auto& response : pending)
    {
        response->Complete({200, "text/plain", "<later>"});
    }
    REQUIRE(later.HasReceived("<answer>"));
    const std::string received = later.TakeReceived();
    CHECK_THAT(received, Contains("Content-Length: 7\r\n"));
    CHECK(received.find("<later>") < received.find("<answer>"));
    fixture.server->Stop();
    pending.front()->Complete({200, "text/plain", "<again>"});
}

TEST_CASE("The next handler answers later requests, also on connections of before; without a handler they are refused")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    const auto ask = [&client](const std::string& end) {
        client.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
        REQUIRE(client.HasReceived(end));
        return client.TakeReceived();
    };
    CHECK_THAT(ask("<answer>"), StartsWith("HTTP/1.1 200 OK\r\n"));
    fixture.server->SetHandler({});
    CHECK_THAT(ask("present\n"), StartsWith("HTTP/1.1 503 "));
    fixture.server->SetHandler([](const Apps::HttpRequest&) {
        return Apps::HttpResponse{200, "text/plain", "<next>"};
    });
    CHECK_THAT(ask("<next>"), StartsWith("HTTP/1.1 200 OK\r\n"));
    CHECK(fixture.requests.size() == 1);
}

TEST_CASE("The next handler does not inherit delayed responses of the former one: their connections are closed")
{
    Fixture fixture({.maxConnections = 2});
    auto pending = std::make_shared<Apps::HttpPendingResponse>();
    fixture.respond = [&](const Apps::HttpRequest& request) {
        Apps::HttpResponse response = fixture.answer;
        if (request.path == "/pending")
        {
            response.pending = pending;
        }
        else
        {
            response.delay = 1h;
        }
        return response;
    };
    RawClient unknown(fixture.context, fixture.port);
    unknown.Send("GET /pending HTTP/1.1\r\nHost: x\r\n\r\n");
    RawClient slow(fixture.context, fixture.port);
    slow.Send("GET /slow HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(fixture.IsReached([&fixture] { return fixture.requests.size() == 2; }));
    RawClient waiting(fixture.context, fixture.port); // both connections are being answered
    waiting.Send("GET /next HTTP/1.1\r\nHost: x\r\n\r\n");
    fixture.server->SetHandler([&fixture](const Apps::HttpRequest&) { return fixture.answer; });
    CHECK(unknown.WasClosed());
    CHECK(slow.WasClosed());
    CHECK(waiting.HasReceived("<answer>"));
    CHECK(unknown.TakeReceived() + slow.TakeReceived() == "");
    pending->Complete({200, "text/plain", "<late>"}); // no effect
}

TEST_CASE("Expect: 100-continue is answered with 100, unless the body is too long")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("POST /1 HTTP/1.1\r\nHost: x\r\nExpect: 100-Continue\r\nContent-Length: 4\r\n\r\n");
    REQUIRE(client.HasReceived("HTTP/1.1 100 Continue\r\n\r\n"));
    CHECK(fixture.requests.empty());
    client.Send("bodyPOST /2 HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\nContent-Length: 1048577\r\n\r\n");
    REQUIRE(client.HasReceived("HTTP/1.1 413 "));
    REQUIRE(fixture.requests.size() == 1);
    CHECK(fixture.requests.front().body == "body");
    const std::string received = client.TakeReceived();
    CHECK(received.find("100 Continue") == received.rfind("100 Continue"));
}

TEST_CASE("A chunk size without end is refused and not buffered")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n5;" + std::string(1'000'000, 'x'));
    REQUIRE(client.HasReceived("HTTP/1.1 400 "));
    CHECK(fixture.requests.empty());
}

TEST_CASE("A chunked body is complete and has the same limit as any other")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n2;x=y\r\nbo\r\n2\r\ndy\r\n0\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    CHECK(fixture.requests.at(0).body == "body");
    const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
    std::string request = "POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n";
    for (int i = 0; i < 17; ++i)
    {
        request += chunk;
    }
    client.Send(request);
    REQUIRE(client.HasReceived("HTTP/1.1 413 "));
    CHECK(fixture.requests.size() == 1);
}

TEST_CASE("HEAD is answered with the header only")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("HEAD / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    REQUIRE(client.WasClosed());
    const std::string answer = client.TakeReceived();
    REQUIRE_THAT(answer, Contains("Content-Length: 8\r\n"));
    REQUIRE_THAT(answer, EndsWith("\r\n\r\n"));
}

TEST_CASE("The header Allow has the allowed methods, and is absent if the handler gives none")
{
    Fixture fixture;
    fixture.answer = {405, "text/plain", "<answer>", {}, "GET, HEAD"};
    RawClient client(fixture.context, fixture.port);
    client.Send("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    REQUIRE_THAT(client.TakeReceived(), Contains("\nAllow: GET, HEAD\r\n"));
    fixture.answer.allow.clear();
    client.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    REQUIRE_THAT(client.TakeReceived(), !Contains("\nAllow:"));
}

TEST_CASE("A message that is not HTTP is answered with 400 and the server continues")
{
    const auto* const garbage = GENERATE("\x16\x03\x01\x02hello\r\n\r\n", "GET\r\n\r\n", "G\x01T / HTTP/1.1\r\n\r\n");
    Fixture fixture;
    RawClient bad(fixture.context, fixture.port);
    bad.Send(garbage);
    REQUIRE(bad.WasClosed());
    REQUIRE_THAT(bad.TakeReceived(), StartsWith("HTTP/1.1 400 "));
    REQUIRE(fixture.requests.empty());
    REQUIRE(fixture.log.Contains(Core::ELogLevel::Warning, "Refused"));
    RawClient good(fixture.context, fixture.port);
    good.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(good.HasReceived("<answer>"));
}

TEST_CASE("A flood of invalid requests causes few log lines")
{
    Fixture fixture;
    for (std::size_t count = 0; count < 4 * Apps::LogRateLimiter::BURST; ++count)
    {
        RawClient bad(fixture.context, fixture.port);
        bad.Send("\x16\x03\x01 hello\r\n\r\n");
        REQUIRE(bad.WasClosed());
    }
    CHECK(fixture.log.GetLines().size() == Apps::LogRateLimiter::BURST);
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused an HTTP request"));
}

TEST_CASE("A request that the guard refuses is answered with 403 and logged; the connection stays open")
{
    Fixture fixture({}, Apps::HttpGuard({{"acs.example"}, false}));
    RawClient client(fixture.context, fixture.port);
    const std::string host = "Host: 127.0.0.1:" + std::to_string(fixture.port) + "\r\n";
    for (const std::string& header :
         {host + "Origin: http://evil.example\r\n",
          host + "sec-fetch-site: cross-site\r\n",
          host + "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\n",
          std::string("Host: evil.example\r\n")})
    {
        INFO(header);
        client.Send("POST /tsc/pause HTTP/1.1\r\n" + header + "Content-Length: 0\r\n\r\n");
        REQUIRE(client.HasReceived("\r\n\r\n"));
        const std::string answer = client.TakeReceived();
        CHECK_THAT(answer, StartsWith("HTTP/1.1 403 "));
        CHECK_THAT(answer, EndsWith("\n"));
    }
    CHECK(fixture.requests.empty());
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused an HTTP request"));
    client.Send("POST /tsc/pause HTTP/1.1\r\n" + host + "Content-Length: 0\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    (void)client.TakeReceived();
    client.Send(
        "GET /metrics HTTP/1.1\r\nHost: acs.example\r\nsec-fetch-site: cross-site\r\nsec-fetch-mode: navigate\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    CHECK(fixture.requests.size() == 2);
}

TEST_CASE("A body that a program in front of the server could see differently is refused, and nothing after it is read")
{
    const std::string second = "GET /second HTTP/1.1\r\nHost: x\r\n\r\n";
    for (const auto& [header, status] :
         {std::pair("Transfer-Encoding: xchunked\r\n", "501"),
          std::pair("Transfer-Encoding: gzip\r\n", "501"),
          std::pair("Transfer-Encoding: gzip, chunked\r\n", "501"),
          std::pair("Transfer-Encoding: chunked, identity\r\n", "501"),
          std::pair("Transfer-Encoding: chunked;q=1\r\n", "501"),
          std::pair("Transfer-Encoding: identity\r\nTransfer-Encoding: chunked\r\n", "501"),
          std::pair("Transfer-Encoding: chunked\r\nContent-Length: 4\r\n", "400"),
          std::pair("Content-Length: 4\r\nTransfer-Encoding: xchunked\r\n", "400"),
          std::pair("Host: y\r\n", "400")})
    {
        INFO(header);
        Fixture fixture;
        RawClient client(fixture.context, fixture.port);
        client.Send("POST /1 HTTP/1.1\r\nHost: x\r\n" + std::string(header) + "\r\n" + second);
        REQUIRE(client.WasClosed());
        const std::string answer = client.TakeReceived();
        CHECK_THAT(answer, StartsWith(std::string("HTTP/1.1 ") + status + " "));
        CHECK_THAT(answer, Contains("Connection: close\r\n"));
        CHECK(answer.find("\nHTTP/1.1 ") == std::string::npos);
        CHECK(fixture.requests.empty());
        CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused an HTTP request"));
    }
}

TEST_CASE("HTTP/1.1 needs a Host, HTTP/1.0 does not, and has no Transfer-Encoding")
{
    Fixture fixture;
    RawClient without(fixture.context, fixture.port);
    without.Send("GET / HTTP/1.1\r\n\r\n");
    REQUIRE(without.WasClosed());
    CHECK_THAT(without.TakeReceived(), StartsWith("HTTP/1.1 400 "));
    RawClient coded(fixture.context, fixture.port);
    coded.Send("POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n");
    REQUIRE(coded.WasClosed());
    CHECK_THAT(coded.TakeReceived(), StartsWith("HTTP/1.1 400 "));
    CHECK(fixture.requests.empty());
    RawClient old(fixture.context, fixture.port);
    old.Send("GET / HTTP/1.0\r\n\r\n");
    REQUIRE(old.WasClosed());
    CHECK_THAT(old.TakeReceived(), StartsWith("HTTP/1.1 200 "));
}

TEST_CASE("A target that cannot be decoded is answered with 400 and the connection stays open")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("GET /%zz HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("percent-encoded\n"));
    REQUIRE_THAT(client.TakeReceived(), StartsWith("HTTP/1.1 400 "));
    client.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
}

TEST_CASE("A body of 1 MiB is accepted, one byte more is answered with 413")
{
    const std::size_t excess = GENERATE(0U, 1U);
    const std::size_t size = 1024U * 1024U + excess;
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("PUT / HTTP/1.1\r\nHost: x\r\nContent-Length: " + std::to_string(size) + "\r\n\r\n");
    client.Send(std::string(size, 'x'));
    REQUIRE(client.HasReceived("\r\n\r\n"));
    REQUIRE_THAT(client.TakeReceived(), StartsWith(excess == 0 ? "HTTP/1.1 200 " : "HTTP/1.1 413 "));
    REQUIRE(fixture.requests.size() == (excess == 0 ? 1U : 0U));
}

TEST_CASE("A header without end is answered with 431")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("GET / HTTP/1.1\r\nHost: x\r\nX: " + std::string(20'000, 'x'));
    REQUIRE(client.WasClosed());
    REQUIRE_THAT(client.TakeReceived(), StartsWith("HTTP/1.1 431 "));
}

TEST_CASE("The error of a port in use has the address and the remedy; another port works")
{
    Fixture fixture;
    Apps::HttpServer other(
        fixture.context.get_executor(),
        [](const Apps::HttpRequest&) { return Apps::HttpResponse{}; },
        {});
    const auto refused = other.Listen({LOOPBACK, fixture.port});
    REQUIRE_FALSE(refused.has_value());
    const std::string text = Core::Describe(refused.error());
    REQUIRE_THAT(text, StartsWith("127.0.0.1:" + std::to_string(fixture.port) + ": "));
    REQUIRE_THAT(text, Contains("choose another"));
    REQUIRE(other.Listen({LOOPBACK, 0}).has_value());
}

TEST_CASE("An address of another machine is refused")
{
    boost::asio::io_context context;
    Apps::HttpServer server(context.get_executor(), [](const Apps::HttpRequest&) { return Apps::HttpResponse{}; }, {});
    const auto refused = server.Listen({"192.0.2.1", 0});
    REQUIRE_FALSE(refused.has_value());
    REQUIRE_THAT(Core::Describe(refused.error()), Contains("192.0.2.1:0"));
}

TEST_CASE("Stop closes every connection and the loop ends")
{
    Fixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
    fixture.server->Stop();
    REQUIRE(client.WasClosed());
    fixture.context.restart();
    fixture.context.run_for(LIMIT);
    REQUIRE(fixture.context.stopped());
}

TEST_CASE("A handler may destroy its server")
{
    boost::asio::io_context context;
    std::unique_ptr<Apps::HttpServer> server;
    server = std::make_unique<Apps::HttpServer>(
        context.get_executor(),
        [&server](const Apps::HttpRequest&) {
            server.reset();
            return Apps::HttpResponse{};
        },
        Core::Logger());
    const auto endpoint = server->Listen({LOOPBACK, 0});
    REQUIRE(endpoint.has_value());
    RawClient client(context, endpoint->port);
    client.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.WasClosed());
    REQUIRE(server == nullptr);
}
