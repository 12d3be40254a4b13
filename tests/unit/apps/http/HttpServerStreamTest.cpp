#include "Catch.hpp"
#include "common/http/HttpBodyStream.hpp"
#include "common/http/HttpServer.hpp"
#include "HttpServerFixture.hpp"
#include "RawHttpClient.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/write.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Apps = ACS::Apps;
namespace Testing = ACS::Testing;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Tcp = boost::asio::ip::tcp;

namespace
{

using RawClient = Testing::RawHttpClient;

constexpr const char* STREAM = "GET /stream HTTP/1.1\r\nHost: x\r\n\r\n";
constexpr const char* PLAIN = "GET /plain HTTP/1.1\r\nHost: x\r\n\r\n";

/// Answers /stream with a stream of the pieces that the test pushes, any other path with "<answer>".
struct StreamFixture : Testing::HttpServerFixture
{
    struct Body
    {
        std::string queued;
        std::size_t calls = 0;
        std::shared_ptr<Apps::HttpBodyStream> stream;
    };

    std::vector<std::shared_ptr<Body>> bodies;

    explicit StreamFixture(Apps::HttpLimits limits = {})
        : HttpServerFixture(limits)
    {
        respond = [this](const Apps::HttpRequest& request) {
            return request.path == "/stream" ? OpenStream() : answer;
        };
    }

    Apps::HttpResponse OpenStream()
    {
        auto body = std::make_shared<Body>();
        body->stream = std::make_shared<Apps::HttpBodyStream>([weak = std::weak_ptr<Body>(body)] {
            const std::shared_ptr<Body> own = weak.lock();
            ++own->calls;
            return std::exchange(own->queued, {});
        });
        bodies.push_back(body);
        Apps::HttpResponse response{200, "text/event-stream"};
        response.headers = {{"Cache-Control", "no-store"}};
        response.stream = body->stream;
        return response;
    }

    void Push(std::size_t number, const std::string& piece)
    {
        bodies.at(number)->queued += piece;
        bodies.at(number)->stream->Notify();
    }
};

} // namespace

TEST_CASE("A stream sends its header at once, then each piece, and ends with the connection")
{
    StreamFixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send(STREAM);
    REQUIRE(client.HasReceived("\r\n\r\n"));
    const std::string header = client.TakeReceived();
    CHECK_THAT(header, StartsWith("HTTP/1.1 200 OK\r\n"));
    CHECK_THAT(header, Contains("Content-Type: text/event-stream\r\n"));
    CHECK_THAT(header, Contains("Cache-Control: no-store\r\n"));
    CHECK_THAT(header, Contains("Connection: close\r\n"));
    CHECK_THAT(header, !Contains("Content-Length"));
    fixture.Push(0, "data: 1\n\n");
    fixture.Push(0, "data: 2\n\n");
    REQUIRE(client.HasReceived("data: 2\n\n"));
    CHECK(client.TakeReceived() == "data: 1\n\ndata: 2\n\n");
    fixture.bodies[0]->stream->End();
    REQUIRE(client.WasClosed());
    CHECK(client.TakeReceived().empty());
}

TEST_CASE("A stream of the former handler ends; the port stays open for the next one")
{
    StreamFixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send(STREAM);
    REQUIRE(client.HasReceived("\r\n\r\n"));
    fixture.server->SetHandler([&fixture](const Apps::HttpRequest&) { return fixture.answer; });
    CHECK_FALSE(fixture.bodies[0]->stream->IsOpen());
    REQUIRE(client.WasClosed());
    RawClient next(fixture.context, fixture.port);
    next.Send(STREAM);
    CHECK(next.HasReceived("<answer>"));
    CHECK(fixture.bodies.size() == 1);
}

TEST_CASE("A stream learns that its peer is gone, and that the server stops")
{
    StreamFixture fixture;
    auto gone = std::make_unique<RawClient>(fixture.context, fixture.port);
    gone->Send(STREAM);
    REQUIRE(gone->HasReceived("\r\n\r\n"));
    gone.reset();
    CHECK(fixture.IsReached([&] { return !fixture.bodies[0]->stream->IsOpen(); }));
    RawClient client(fixture.context, fixture.port);
    client.Send(STREAM);
    REQUIRE(client.HasReceived("\r\n\r\n"));
    fixture.server->Stop();
    CHECK_FALSE(fixture.bodies[1]->stream->IsOpen());
    REQUIRE(client.WasClosed());
    fixture.Push(1, "late"); // no effect
    CHECK(fixture.bodies[1]->queued == "late");
}

TEST_CASE("HEAD has the header of a stream only")
{
    StreamFixture fixture;
    RawClient client(fixture.context, fixture.port);
    client.Send("HEAD /stream HTTP/1.1\r\nHost: x\r\n\r\n");
    REQUIRE(client.HasReceived("\r\n\r\n"));
    CHECK_FALSE(fixture.bodies[0]->stream->IsOpen());
    CHECK(client.WasClosed());
}

TEST_CASE("A stream without pieces outlives the time limit of idle connections")
{
    Apps::HttpLimits limits;
    limits.timeout = 50ms;
    StreamFixture fixture(limits);
    RawClient client(fixture.context, fixture.port);
    client.Send(STREAM);
    RawClient idle(fixture.context, fixture.port);
    REQUIRE(client.HasReceived("\r\n\r\n"));
    REQUIRE(idle.WasClosed());
    client.Send("ignored");
    fixture.Push(0, "data: 1\n\n");
    REQUIRE(client.HasReceived("data: 1\n\n"));
}

TEST_CASE("The peer of a stream that does not read has one piece in memory, and is closed after the time limit")
{
    Apps::HttpLimits limits;
    limits.timeout = 200ms;
    StreamFixture fixture(limits);
    Tcp::socket silent(fixture.context, Tcp::v4());
    silent.set_option(boost::asio::socket_base::receive_buffer_size(1));
    silent.connect({boost::asio::ip::make_address("127.0.0.1"), fixture.port});
    boost::asio::write(silent, boost::asio::buffer(std::string(STREAM)));
    REQUIRE(fixture.IsReached([&] { return fixture.bodies.size() == 1; }));
    REQUIRE(fixture.IsReached([&] { return fixture.bodies[0]->calls > 0; }));
    const std::size_t calls = fixture.bodies[0]->calls;
    fixture.Push(0, std::string(16U * 1024U * 1024U, 'x'));
    for (int count = 0; count < 100; ++count)
    {
        fixture.Push(0, "data: 1\n\n");
    }
    CHECK(fixture.bodies[0]->calls <= calls + 1);
    CHECK(fixture.IsReached([&] { return !fixture.bodies[0]->stream->IsOpen(); }));
}

TEST_CASE("A hundred streams that do not read block no request; those beyond the limit are answered with 503")
{
    StreamFixture fixture;
    std::vector<std::unique_ptr<RawClient>> clients;
    std::size_t refused = 0;
    for (std::size_t number = 0; number < 100; ++number)
    {
        clients.push_back(std::make_unique<RawClient>(fixture.context, fixture.port));
        clients.back()->Send(STREAM);
        REQUIRE(clients.back()->HasReceived("\r\n\r\n"));
        const std::string header = clients.back()->TakeReceived();
        refused += header.starts_with("HTTP/1.1 503 ") && header.ends_with("too many streams are open\n") ? 1U : 0U;
        CHECK(fixture.requests.back().bCanStream == (number < Apps::HttpLimits().maxStreamsPerPeer));
    }
    CHECK(refused == 100 - Apps::HttpLimits().maxStreamsPerPeer);
    RawClient same(fixture.context, fixture.port);
    same.Send(PLAIN);
    CHECK(same.HasReceived("<answer>"));
    RawClient other(fixture.context, fixture.port, "127.0.0.2");
    other.Send(STREAM);
    REQUIRE(other.HasReceived("\r\n\r\n"));
    CHECK_THAT(other.TakeReceived(), StartsWith("HTTP/1.1 200 "));
    fixture.Push(0, "data: 1\n\n"); // a stream is never replaced
    CHECK(clients[0]->HasReceived("data: 1\n\n"));
    // A stream that ends makes room.
    clients[0].reset();
    REQUIRE(fixture.IsReached([&] { return !fixture.bodies[0]->stream->IsOpen(); }));
    same.Send(STREAM);
    REQUIRE(same.HasReceived("text/event-stream"));
}

TEST_CASE("Responses have further headers, and 204 and 304 have neither a body nor its length")
{
    Testing::HttpServerFixture fixture;
    fixture.answer.status = GENERATE(204U, 304U);
    fixture.answer.contentType.clear();
    fixture.answer.headers = {{"Set-Cookie", "a=1"}, {"ETag", "\"x\""}};
    RawClient client(fixture.context, fixture.port);
    client.Send("GET /1 HTTP/1.1\r\nHost: x\r\nCookie: b=2\r\nLast-Event-ID: 7\r\n\r\n");
    REQUIRE(client.HasReceived("\r\n\r\n"));
    const std::string received = client.TakeReceived();
    CHECK_THAT(received, Contains("\r\nSet-Cookie: a=1\r\n"));
    CHECK_THAT(received, Contains("\r\nETag: \"x\"\r\n"));
    CHECK_THAT(received, !Contains("Content-"));
    CHECK_THAT(received, EndsWith("\r\n\r\n"));
    CHECK(fixture.requests[0].GetHeaderOrNull("cookie") == "b=2");
    CHECK(fixture.requests[0].GetHeaderOrNull("last-event-id") == "7");
    fixture.answer = {};
    fixture.answer.body = "<answer>";
    client.Send(PLAIN);
    CHECK(client.HasReceived("<answer>"));
}
