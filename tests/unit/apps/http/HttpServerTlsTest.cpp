#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "common/http/HttpBodyStream.hpp"
#include "common/http/HttpServer.hpp"
#include "common/http/HttpTls.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Apps = ACS::Apps;
namespace Core = ACS::Core;
namespace Testing = ACS::Testing;
namespace Ssl = boost::asio::ssl;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Testing::CertificateFiles;
using Tcp = boost::asio::ip::tcp;
using ErrorCode = boost::system::error_code;

namespace
{

constexpr auto TLS_LIMIT = 10s;

struct TlsFixture
{
    Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker{folder.GetPath()};
    CertificateFiles ca = maker.MakeCA("ca");
    CertificateFiles own = maker.Make(ca, {});
    boost::asio::io_context context;
    Testing::RecordingLogSink log;
    std::vector<Apps::HttpRequest> requests;
    Apps::HttpResponse answer{200, "text/plain", "<answer>"};
    Apps::HttpServer server{
        context.get_executor(),
        [this](const Apps::HttpRequest& request) {
            requests.push_back(request);
            return answer;
        },
        Core::Logger(log, "operator")};
    std::uint16_t port = 0;

    explicit TlsFixture(const std::string& clientCA = {})
    {
        auto tls = Apps::MakeHttpTlsContext({own.certificate, own.key, clientCA.empty() ? clientCA : ca.certificate});
        REQUIRE(tls.has_value());
        server.UseTLS(std::move(*tls));
        const auto endpoint = server.Listen({"127.0.0.1", 0});
        REQUIRE(endpoint.has_value());
        port = endpoint->port;
    }

    void Run(const bool& bDone)
    {
        const auto deadline = std::chrono::steady_clock::now() + TLS_LIMIT;
        while (!bDone && std::chrono::steady_clock::now() < deadline)
        {
            context.restart();
            context.run_one_for(100ms);
        }
        REQUIRE(bDone);
    }
};

/// What a client receives until the connection ends, and how it ends.
struct Exchange
{
    std::string received;
    ErrorCode handshake;
    ErrorCode end;
};

Exchange Ask(TlsFixture& fixture, const std::string& request, const std::optional<CertificateFiles>& identityOrNull)
{
    Ssl::context tls(Ssl::context::tls_client);
    tls.set_verify_mode(Ssl::verify_peer);
    tls.load_verify_file(fixture.ca.certificate);
    if (identityOrNull.has_value())
    {
        tls.use_certificate_chain_file(identityOrNull->certificate);
        tls.use_private_key_file(identityOrNull->key, Ssl::context::pem);
    }
    Ssl::stream<Tcp::socket> stream(fixture.context, tls);
    stream.next_layer().connect({boost::asio::ip::make_address("127.0.0.1"), fixture.port});
    Exchange exchange;
    bool bDone = false;
    stream.async_handshake(Ssl::stream_base::client, [&](const ErrorCode& error) {
        exchange.handshake = error;
        bDone = true;
    });
    fixture.Run(bDone);
    if (exchange.handshake.failed())
    {
        return exchange;
    }
    bDone = false;
    boost::asio::async_write(stream, boost::asio::buffer(request), [](const ErrorCode&, std::size_t) {});
    boost::asio::async_read(
        stream,
        boost::asio::dynamic_buffer(exchange.received),
        [&](const ErrorCode& error, std::size_t) {
            exchange.end = error;
            bDone = true;
        });
    fixture.Run(bDone);
    return exchange;
}

constexpr const char* REQUEST = "GET /status HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

} // namespace

TEST_CASE("Over TLS a request is answered like any other, and the end of the connection is announced")
{
    TlsFixture fixture;
    const Exchange exchange = Ask(
        fixture,
        "POST /1 HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\nContent-Length: 4\r\n\r\nbody" + std::string(REQUEST),
        std::nullopt);
    CHECK_THAT(exchange.received, StartsWith("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\n"));
    CHECK_THAT(exchange.received, EndsWith("<answer>"));
    CHECK(exchange.end == boost::asio::error::eof); // not stream_truncated
    REQUIRE(fixture.requests.size() == 2);
    CHECK(fixture.requests[0].body == "body");
    CHECK(fixture.requests[1].path == "/status");
    CHECK(fixture.requests[1].sender.certificateName.empty());
}

TEST_CASE("The handler gets the CN of a client certificate; a client without one is served")
{
    TlsFixture fixture("ca");
    const CertificateFiles kim = fixture.maker.Make(fixture.ca, {.commonName = "kim"});
    CHECK_THAT(Ask(fixture, REQUEST, kim).received, StartsWith("HTTP/1.1 200 OK\r\n"));
    CHECK_THAT(Ask(fixture, REQUEST, std::nullopt).received, StartsWith("HTTP/1.1 200 OK\r\n"));
    REQUIRE(fixture.requests.size() == 2);
    CHECK(fixture.requests[0].sender.certificateName == "kim");
    CHECK(fixture.requests[1].sender.certificateName.empty());
}

TEST_CASE("A client certificate of another CA, or one that has expired, is refused in the handshake and logged")
{
    TlsFixture fixture("ca");
    const CertificateFiles foreign = fixture.maker.MakeSelfSigned({.commonName = "kim"});
    const CertificateFiles expired =
        fixture.maker.Make(fixture.ca, {.validFrom = -48h, .validTo = -24h, .commonName = "kim"});
    for (const CertificateFiles& identity : {foreign, expired})
    {
        const Exchange exchange = Ask(fixture, REQUEST, identity);
        CHECK(exchange.received.empty());
        CHECK((exchange.handshake.failed() || exchange.end.category() == boost::asio::error::get_ssl_category()));
    }
    CHECK(fixture.requests.empty());
    CHECK(fixture.log.GetLines().size() == 2);
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "Refused an HTTP request"));
}

TEST_CASE("Over TLS a stream sends its pieces until it ends")
{
    TlsFixture fixture;
    int pieces = 0;
    fixture.answer.stream = std::make_shared<Apps::HttpBodyStream>([&] {
        if (++pieces < 3)
        {
            return fmt::format("data: {}\n\n", pieces);
        }
        boost::asio::post(fixture.context, [&fixture] { fixture.answer.stream->End(); });
        return std::string();
    });
    const Exchange exchange = Ask(fixture, REQUEST, std::nullopt);
    CHECK_THAT(exchange.received, StartsWith("HTTP/1.1 200 OK\r\n"));
    CHECK_THAT(exchange.received, EndsWith("\r\n\r\ndata: 1\n\ndata: 2\n\n"));
    CHECK(exchange.end.failed());
    CHECK(fixture.requests.at(0).sender.bTLS);
}

TEST_CASE("Without TLS a client of the TLS address gets no answer")
{
    TlsFixture fixture;
    Tcp::socket socket(fixture.context);
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), fixture.port});
    std::string received;
    bool bDone = false;
    boost::asio::async_write(socket, boost::asio::buffer(std::string_view(REQUEST)), [](const ErrorCode&, std::size_t) {
    });
    boost::asio::async_read(socket, boost::asio::dynamic_buffer(received), [&](const ErrorCode&, std::size_t) {
        bDone = true;
    });
    fixture.Run(bDone);
    CHECK(received.find("HTTP") == std::string::npos);
    CHECK(fixture.requests.empty());
}

TEST_CASE("A file for TLS that is missing or does not fit is an error with key, path and reason")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const CertificateFiles ca = maker.MakeCA("ca");
    const CertificateFiles own = maker.Make(ca, {});
    const CertificateFiles locked = maker.Make(ca, {.passphrase = "secret"});
    struct Row
    {
        Apps::HttpTlsFiles files;
        std::string path;
        std::string found;
    };
    const std::vector<Row> rows{
        {{"", own.key, ""}, "certificate", "none"},
        {{own.certificate, "", ""}, "key", "none"},
        {{"/nowhere", own.key, ""}, "certificate", "/nowhere: No such file or directory"},
        {{own.certificate, folder.GetPath().string(), ""}, "key", "Is a directory"},
        {{own.certificate, ca.key, ""}, "key", ": the key of another certificate than " + own.certificate},
        {{locked.certificate, locked.key, ""}, "key", locked.key + ": "},
        {{own.key, own.key, ""}, "certificate", own.key + ": "},
        {{own.certificate, own.key, own.key}, "client_ca", own.key + ": "}};
    for (const Row& row : rows)
    {
        const auto context = Apps::MakeHttpTlsContext(row.files);
        REQUIRE_FALSE(context.has_value());
        CHECK(context.error().path == row.path);
        CHECK_THAT(context.error().found, Contains(row.found));
    }
    CHECK(Apps::MakeHttpTlsContext({own.certificate, own.key, ca.certificate}).has_value());
}
