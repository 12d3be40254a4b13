#include "Catch.hpp"
#include "common/http/HttpPeer.hpp"
#include "common/http/HttpPendingResponse.hpp"
#include "common/http/HttpServer.hpp"
#include "HttpServerFixture.hpp"
#include "RawHttpClient.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace Apps = ACS::Apps;
namespace Testing = ACS::Testing;
using namespace std::chrono_literals;
using Tcp = boost::asio::ip::tcp;

namespace
{

constexpr const char* ONE_HOST = "127.0.0.1";

using Fixture = Testing::HttpServerFixture;
using RawClient = Testing::RawHttpClient;

} // namespace

TEST_CASE("The connection of a silent peer is closed after the time limit")
{
    Apps::HttpLimits limits;
    limits.timeout = 50ms;
    Fixture fixture(limits);
    RawClient client(fixture.context, fixture.port);
    client.Send("GET / HT");
    REQUIRE(client.WasClosed());
    REQUIRE(client.TakeReceived().empty());
}

TEST_CASE("A peer beyond the limit replaces the one that has been silent longest")
{
    Apps::HttpLimits limits;
    limits.maxConnections = 2;
    Fixture fixture(limits);
    RawClient half(fixture.context, fixture.port);
    half.Send("GET / HT");
    RawClient idle(fixture.context, fixture.port);
    idle.Send("GET /1 HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(idle.HasReceived("<answer>"));
    RawClient third(fixture.context, fixture.port);
    third.Send("GET /2 HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(third.HasReceived("<answer>"));
    REQUIRE(half.WasClosed());
    REQUIRE(half.TakeReceived().empty());
    static_cast<void>(idle.TakeReceived());
    idle.Send("GET /3 HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(idle.HasReceived("<answer>"));
}

TEST_CASE("A peer that does not read its responses is replaced, and cannot take more than its share")
{
    Apps::HttpLimits limits;
    limits.maxPerPeer = GENERATE(2U, 64U);
    limits.maxConnections = 2;
    Fixture fixture(limits);
    fixture.answer.body.assign(32U * 1024U * 1024U, 'x');
    std::vector<std::unique_ptr<Tcp::socket>> silent;
    for (std::size_t number = 0; number < limits.maxConnections; ++number)
    {
        silent.push_back(std::make_unique<Tcp::socket>(fixture.context));
        silent.back()->connect({boost::asio::ip::make_address(ONE_HOST), fixture.port});
        boost::asio::write(*silent.back(), boost::asio::buffer(std::string("GET / HTTP/1.1\r\nHost: x\r\n\r\n")));
        REQUIRE(fixture.IsReached([&]() { return fixture.requests.size() == number + 1; }));
    }
    fixture.answer.body = "<answer>";
    RawClient client(fixture.context, fixture.port);
    client.Send("GET /livez HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("<answer>"));
}

TEST_CASE("A peer that sends requests and reads nothing has only a few of them answered")
{
    constexpr int REQUESTS = 500;
    constexpr int MOST_ANSWERED = 20;
    Fixture fixture(Apps::HttpLimits{});
    fixture.answer.body = std::string(16U * 1024U, 'x') + "<answer>";
    Tcp::socket silent(fixture.context, Tcp::v4());
    silent.set_option(boost::asio::socket_base::receive_buffer_size(1));
    silent.connect({boost::asio::ip::make_address(ONE_HOST), fixture.port});
    std::string requests;
    for (int number = 0; number < REQUESTS; ++number)
    {
        requests += "GET /silent HTTP/1.1\r\nHost: x\r\n\r\n";
    }
    boost::asio::write(silent, boost::asio::buffer(requests));
    RawClient client(fixture.context, fixture.port);
    for (int number = 0; number < REQUESTS; ++number) // each takes at least one round of the loop
    {
        client.Send("GET /read HTTP/1.1\r\nHost: x\r\n\r\n");
        REQUIRE(client.HasReceived("<answer>"));
        static_cast<void>(client.TakeReceived());
    }
    const auto isSilent = [](const Apps::HttpRequest& request) {
        return request.path == "/silent";
    };
    CHECK(std::ranges::count_if(fixture.requests, isSilent) > 0);
    CHECK(std::ranges::count_if(fixture.requests, isSilent) <= MOST_ANSWERED);
}

TEST_CASE("A peer with its share of connections replaces its own and not those of others")
{
    Apps::HttpLimits limits;
    limits.maxPerPeer = 1;
    Fixture fixture(limits);
    RawClient other(fixture.context, fixture.port, "127.0.0.2");
    other.Send("GET / HT");
    RawClient first(fixture.context, fixture.port);
    first.Send("GET / HT");
    RawClient second(fixture.context, fixture.port);
    second.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(second.HasReceived("<answer>"));
    REQUIRE(first.WasClosed());
    other.Send("TP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(other.HasReceived("<answer>"));
}

TEST_CASE("A peer that waits keeps its place when the connection of another one ends")
{
    Apps::HttpLimits limits;
    limits.maxPerPeer = 1;
    Fixture fixture(limits);
    const auto pending = std::make_shared<Apps::HttpPendingResponse>();
    fixture.respond = [&](const Apps::HttpRequest& request) {
        Apps::HttpResponse response = fixture.answer;
        response.pending = request.path == "/later" ? pending : nullptr;
        return response;
    };
    RawClient other(fixture.context, fixture.port, "127.0.0.2");
    other.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(other.HasReceived("<answer>"));
    RawClient first(fixture.context, fixture.port);
    first.Send("GET /later HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(fixture.IsReached([&fixture] { return fixture.requests.size() == 2; }));
    RawClient second(fixture.context, fixture.port);
    second.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    RawClient third(fixture.context, fixture.port);
    third.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    other.Send("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    REQUIRE(other.WasClosed());
    fixture.context.poll();
    pending->Complete({200, "text/plain", "<later>"});
    REQUIRE(first.HasReceived("<later>"));
    CHECK(second.HasReceived("<answer>"));
    CHECK(third.HasReceived("<answer>"));
}

TEST_CASE("One peer is an IPv4 address, mapped or not, or a /64 of IPv6")
{
    const auto group = [](const char* text) {
        return Apps::GetPeerGroup(boost::asio::ip::make_address(text)).to_string();
    };
    CHECK(group("10.0.0.7") == "10.0.0.7");
    CHECK(group("::ffff:10.0.0.7") == "10.0.0.7");
    CHECK(group("2001:db8:1:2:3:4:5:6") == "2001:db8:1:2::");
    CHECK(group("2001:db8:1:3::6") == "2001:db8:1:3::");
}

TEST_CASE("Peers beyond the limit wait while all others are being answered, and are then served in turn")
{
    Apps::HttpLimits limits;
    limits.maxConnections = 1;
    Fixture fixture(limits);
    fixture.answer.delay = 50ms;
    std::vector<std::unique_ptr<RawClient>> clients;
    for (std::size_t number = 0; number < 3; ++number)
    {
        clients.push_back(std::make_unique<RawClient>(fixture.context, fixture.port));
        clients.back()->Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
        REQUIRE(fixture.IsReached([&]() { return fixture.requests.size() == 1; }));
    }
    for (std::size_t number = 0; number < clients.size(); ++number)
    {
        CHECK(fixture.requests.size() <= number + 1);
        REQUIRE(clients[number]->HasReceived("<answer>"));
    }
    REQUIRE(clients.front()->WasClosed());
}
