#include "CertificateMaker.hpp"
#include "RawPeer.hpp"
#include "RawServer.hpp"
#include "TemporaryFolder.hpp"
#include "WebSocketFixture.hpp"

#include <openssl/bio.h>
#include <openssl/ssl.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ProtocolBeast::TlsOptions;
using Testing::CertificateFiles;
using Testing::CertificateRequest;
using Testing::RawPeer;
using Testing::RawServer;

namespace
{

/// A CA that both sides trust, one that neither trusts, and a server with a valid certificate.
class TLSFixture : public Testing::WebSocketFixture
{
    Testing::TemporaryFolder _folder;

public:
    Testing::CertificateMaker maker{_folder.GetPath()};
    CertificateFiles ca = maker.MakeCA("ca");
    CertificateFiles otherCA = maker.MakeCA("other");

    TLSFixture()
    {
        serverOptions.tls.emplace();
        UseOnServer(maker.Make(ca, {}));
        clientOptions.tls.caFile = ca.certificate;
    }

    void UseOnServer(const CertificateFiles& files)
    {
        serverOptions.tls->certificateFile = files.certificate;
        serverOptions.tls->keyFile = files.key;
    }

    void UseOnClient(const CertificateFiles& files)
    {
        clientOptions.tls.certificateFile = files.certificate;
        clientOptions.tls.keyFile = files.key;
    }

    /// Why the client is rejected. Two attempts: the second one fails too.
    [[nodiscard]] std::string ConnectInVain(const std::string& host = "localhost")
    {
        Listen();
        ConnectTo(GetURL("/acs/", host));
        REQUIRE(WasLost(2));
        CHECK(acsEvents.GetAll<Protocol::Registered>().empty());
        CHECK_FALSE(server->IsRegistered());
        const auto losses = acsEvents.GetAll<Protocol::LinkLost>();
        CHECK(losses[0].reason == losses[1].reason);
        return losses[0].reason;
    }

    /// Whether the server has logged this reason for rejecting a client.
    [[nodiscard]] bool WasLogged(const std::string& reason)
    {
        return WasReached([this, &reason] { return sink.ContainsField("reason", reason); });
    }

    /// The sentence with which Create refuses the client's files.
    [[nodiscard]] std::string RefuseClient(const TlsOptions& options)
    {
        clientOptions.url = "wss://localhost:1/acs/";
        clientOptions.tls = options;
        const auto refused = TryMakeClient(acsEvents);
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error() == CheckClientTLS(options, "localhost").error());
        return Core::Describe(refused.error());
    }

    [[nodiscard]] std::string RefuseServer(const TlsOptions& options)
    {
        serverOptions.tls = options;
        const auto refused = TryListen();
        REQUIRE_FALSE(refused.has_value());
        return Core::Describe(refused.error());
    }
};

CertificateRequest MakeCertificateRequest(
    const std::string& name,
    bool bRSA = false,
    const std::string& passphrase = {})
{
    CertificateRequest request;
    request.alternativeName = name;
    request.bRSA = bRSA;
    request.passphrase = passphrase;
    return request;
}

/// A certificate that is valid for a day, beginning `from` after now.
CertificateRequest MakeCertificateRequest(std::chrono::hours from)
{
    CertificateRequest request;
    request.validFrom = from;
    request.validTo = from + 24h;
    return request;
}

bool Contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// The first message of a client that supports TLS 1.1 at most.
std::string MakeOldHello()
{
    const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
    SSL_CTX_set_security_level(context.get(), 0);
    SSL_CTX_set_max_proto_version(context.get(), TLS1_1_VERSION);
    const std::unique_ptr<SSL, decltype(&SSL_free)> client(SSL_new(context.get()), &SSL_free);
    BIO* const output = BIO_new(BIO_s_mem());
    SSL_set_bio(client.get(), BIO_new(BIO_s_mem()), output); // which takes both
    SSL_connect(client.get());
    std::string hello(BIO_ctrl_pending(output), '\0');
    REQUIRE(BIO_read(output, hello.data(), static_cast<int>(hello.size())) > 0);
    return hello;
}

} // namespace

TEST_CASE("1 wss: a server is accepted by its name, its address or the configured name")
{
    TLSFixture rig;
    std::string host = "localhost";
    SECTION("name")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:localhost")));
    }
    SECTION("address")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("IP:127.0.0.1")));
        host = "127.0.0.1";
    }
    SECTION("given name")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:mcs.example")));
        rig.clientOptions.tls.serverName = "mcs.example";
        host = "127.0.0.1";
    }
    SECTION("a certificate that is its own CA")
    {
        const CertificateFiles own = rig.maker.MakeSelfSigned({});
        rig.UseOnServer(own);
        rig.clientOptions.tls.caFile = own.certificate;
    }
    SECTION("RSA")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:localhost", true)));
    }
    rig.Listen();
    rig.ConnectTo(rig.GetURL("/acs/", host));
    CHECK(rig.WasRegistered());
}

TEST_CASE("1 wss without a CA file trusts the CAs of the system and no other")
{
    TLSFixture rig;
    rig.clientOptions.tls.caFile.clear();
    SECTION("unknown there")
    {
        CHECK(Contains(rig.ConnectInVain(), "the server's certificate comes from an unknown CA"));
    }
    SECTION("known there")
    {
        setenv("SSL_CERT_FILE", rig.ca.certificate.c_str(), 1); // NOLINT(concurrency-mt-unsafe): one thread
        rig.Listen();
        rig.ConnectTo(rig.GetURL("/acs/", "localhost"));
        unsetenv("SSL_CERT_FILE"); // NOLINT(concurrency-mt-unsafe)
        CHECK(rig.WasRegistered());
    }
}

TEST_CASE("1 wss: each wrong server is rejected with the reason")
{
    TLSFixture rig;
    const std::string start = "the TLS handshake failed: the server's certificate ";
    std::string host = "localhost";
    std::string wanted;
    SECTION("unknown CA")
    {
        rig.UseOnServer(rig.maker.Make(rig.otherCA, {}));
        wanted = "comes from an unknown CA: name the right CA file";
    }
    SECTION("self-signed")
    {
        rig.UseOnServer(rig.maker.MakeSelfSigned({}));
        wanted = "is self-signed and is not itself in the CA file";
    }
    SECTION("expired")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest(-48h)));
        wanted = "has expired (or this machine's clock is wrong)";
    }
    SECTION("not valid yet")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest(24h)));
        wanted = "is not valid yet (or this machine's clock is wrong)";
    }
    SECTION("wrong name")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:other.example,IP:127.0.0.1")));
        wanted = "is for another name than localhost";
    }
    SECTION("wrong address")
    {
        rig.UseOnServer(rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:localhost,IP:127.0.0.2")));
        host = "127.0.0.1";
        wanted = "is for another name than 127.0.0.1";
    }
    CHECK(rig.ConnectInVain(host) == start + wanted);
}

TEST_CASE("1 wss: a server with a client CA accepts only clients with its certificate, and both sides log the reason")
{
    TLSFixture rig;
    rig.serverOptions.tls->caFile = rig.ca.certificate;
    const std::string start = "the TLS handshake failed: ";
    SECTION("a good one")
    {
        rig.UseOnClient(rig.maker.Make(rig.ca, {}));
        rig.Listen();
        rig.Connect();
        CHECK(rig.WasRegistered());
    }
    SECTION("none")
    {
        CHECK(Contains(rig.ConnectInVain(), "the other side demands a client certificate"));
        CHECK(rig.WasLogged(start + "the client shows no certificate"));
    }
    SECTION("of an unknown CA")
    {
        rig.UseOnClient(rig.maker.Make(rig.otherCA, {}));
        CHECK(Contains(rig.ConnectInVain(), "the other side does not know the CA of our certificate"));
        CHECK(rig.WasLogged(start + "the client's certificate comes from an unknown CA: name the right CA file"));
    }
    SECTION("expired")
    {
        rig.UseOnClient(rig.maker.Make(rig.ca, MakeCertificateRequest(-48h)));
        CHECK(Contains(rig.ConnectInVain(), "the other side reports that our certificate has expired"));
        CHECK(rig.WasLogged(start + "the client's certificate has expired (or this machine's clock is wrong)"));
    }
}

TEST_CASE("1 wss: a renewed certificate is used by the next connection after ReloadTLS; a wrong one is not")
{
    TLSFixture rig;
    rig.serverOptions.tls->caFile = rig.ca.certificate;
    const CertificateFiles used = rig.maker.Make(rig.ca, MakeCertificateRequest(-48h));
    const CertificateFiles valid = rig.maker.Make(rig.ca, {});
    rig.UseOnClient(used);
    CHECK(Contains(rig.ConnectInVain(), "our certificate has expired"));
    std::filesystem::copy_file(valid.certificate, used.certificate, std::filesystem::copy_options::overwrite_existing);
    const Core::Result<void> wrong = rig.client->ReloadTLS(); // the key is that of the former certificate
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().path == "tls.key");
    std::filesystem::copy_file(valid.key, used.key, std::filesystem::copy_options::overwrite_existing);
    REQUIRE(rig.client->ReloadTLS().has_value());
    CHECK(rig.WasRegistered());
}

TEST_CASE("1 wss against ws, and ws against wss, fail with a clear error")
{
    TLSFixture rig;
    SECTION("client wss, server ws")
    {
        rig.serverOptions.tls.reset();
        rig.Listen();
        rig.ConnectTo("wss://localhost:" + std::to_string(rig.serverOptions.port) + "/acs/");
        REQUIRE(rig.WasLost());
        CHECK(
            rig.acsEvents.GetFirstLoss()
            == "the TLS handshake failed: the other side does not speak TLS (ws instead of wss?)");
    }
    SECTION("client ws, server wss")
    {
        rig.Listen();
        rig.clientOptions.tls = {};
        rig.ConnectTo("ws://localhost:" + std::to_string(rig.serverOptions.port) + "/acs/");
        REQUIRE(rig.WasLost());
        CHECK(rig.WasLogged("the TLS handshake failed: the other side does not speak TLS (ws instead of wss?)"));
    }
}

TEST_CASE("1 wss: a server survives garbage, plain HTTP and old TLS")
{
    TLSFixture rig;
    rig.serverOptions.maximumClients = 1;
    rig.Listen();
    const std::string bad = GENERATE(
        std::string("GET /acs/ HTTP/1.1\r\nHost: x\r\n\r\n"),
        std::string(100'000, 'x'),
        std::string("\x16\x03\x01\xFF\xFF garbage that looks like TLS"),
        std::string("\x16\x03\x01\x00\x05\x01\x00\x00\x01\x00", 10));
    const auto peer = RawPeer::Connect(rig.io, rig.serverOptions.port);
    peer->Write(bad);
    peer->Close();
    rig.Connect();
    CHECK(rig.WasRegistered());
}

TEST_CASE("1 wss: TLS before 1.2 is rejected")
{
    TLSFixture rig;
    rig.Listen();
    const auto peer = RawPeer::Connect(rig.io, rig.serverOptions.port);
    peer->Write(MakeOldHello());
    peer->ReadAsync();
    REQUIRE(rig.WasReached([&peer] { return peer->HasEnded(); }));
    CHECK(peer->GetReceived().substr(0, 1) == "\x15");                          // an alert,
    CHECK(peer->GetReceived().substr(3) == std::string("\x00\x02\x02\x46", 4)); // fatal, protocol_version
    CHECK(rig.WasLogged("the TLS handshake failed: the other side speaks only versions of TLS before 1.2"));
}

TEST_CASE("1 wss: a silent peer keeps a connection no longer than the limit of the handshake")
{
    TLSFixture rig;
    SECTION("server")
    {
        rig.serverOptions.link.handshakeTimeout = 20ms;
        rig.serverOptions.maximumClients = 1;
        rig.Listen();
        const auto peer = RawPeer::Connect(rig.io, rig.serverOptions.port);
        peer->Write("\x16\x03\x01"); // not even a whole record
        peer->ReadAsync();
        CHECK(rig.WasReached([&peer] { return peer->HasEnded(); }));
    }
    SECTION("client")
    {
        RawServer silent(rig.io);
        silent.onPeer = [](std::size_t /*index*/, RawPeer& peer) {
            peer.ReadAsync();
        };
        rig.clientOptions.link.handshakeTimeout = 20ms;
        rig.ConnectTo(silent.GetURL("wss", "localhost"));
        REQUIRE(rig.WasLost(2));
        CHECK(rig.acsEvents.GetFirstLoss() == "the TLS handshake failed: the other side did not answer in time");
        // The client requests the name, so that a server with several names can choose its certificate.
        CHECK(Contains(silent.GetPeer(0).GetReceived(), "localhost"));
    }
}

TEST_CASE("1 wss: Create reports unusable files with path and reason")
{
    TLSFixture rig;
    const CertificateFiles good = rig.maker.Make(rig.ca, {});
    const CertificateFiles other = rig.maker.Make(rig.ca, {});
    const CertificateFiles rsa = rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:x", true));
    const CertificateFiles locked = rig.maker.Make(rig.ca, MakeCertificateRequest("DNS:x", false, "secret"));
    const std::string garbage = rig.maker.WriteFile("garbage", "no PEM\n");
    const std::string empty = rig.maker.WriteFile("empty", "");
    struct Row
    {
        TlsOptions options;
        std::string key;
        std::string part;
    };
    const std::vector<Row> rows{
        {{"/nowhere/ca.pem", {}, {}, {}}, "tls.ca", "/nowhere/ca.pem: No such file or directory"},
        {{garbage, {}, {}, {}}, "tls.ca", garbage + ": no certificate"},
        {{empty, {}, {}, {}}, "tls.ca", empty + ": it is empty"},
        {{"/", {}, {}, {}}, "tls.ca", "/: Is a directory"},
        {{{}, "/nowhere/a.pem", good.key, {}}, "tls.certificate", "/nowhere/a.pem: No such file or directory"},
        {{{}, garbage, good.key, {}}, "tls.certificate", garbage + ": no start line"},
        {{{}, good.certificate, "/nowhere/a.key", {}}, "tls.key", "/nowhere/a.key: No such file or directory"},
        {{{}, good.certificate, good.certificate, {}}, "tls.key", good.certificate + ": "},
        {{{}, good.certificate, other.key, {}}, "tls.key", "the key of another certificate than " + good.certificate},
        {{{}, good.certificate, rsa.key, {}}, "tls.key", "the key of another certificate than " + good.certificate},
        {{{}, locked.certificate, locked.key, {}}, "tls.key", locked.key + ": "}};
    for (const Row& row : rows)
    {
        INFO(row.key << " " << row.part);
        const std::string sentence = rig.RefuseClient(row.options);
        CHECK(sentence.find(row.key + ": expected a PEM file with ") == 0);
        CHECK(Contains(sentence, row.part));
        TlsOptions server = row.options;
        if (server.certificateFile.empty())
        {
            server.certificateFile = good.certificate;
            server.keyFile = good.key;
        }
        CHECK(rig.RefuseServer(server) == sentence);
    }
    CHECK(rig.RefuseClient({{}, good.certificate, {}, {}}).find("tls.key: ") == 0);
    CHECK(rig.RefuseClient({{}, {}, good.key, {}}).find("tls.certificate: ") == 0);
    CHECK(rig.RefuseClient({{}, {}, {}, "fe80::1%lo"}).find("tls.server_name: ") == 0);
    CHECK(rig.RefuseServer({}).find("tls.certificate: ") == 0);
    CHECK(rig.RefuseServer({{}, good.certificate, {}, {}}).find("tls.key: ") == 0);
}

TEST_CASE("TLS options with a ws URL are rejected: the link would not be encrypted")
{
    TLSFixture rig;
    rig.clientOptions.url = "ws://localhost/acs/";
    const auto refused = rig.TryMakeClient(rig.acsEvents);
    REQUIRE_FALSE(refused.has_value());
    CHECK(Contains(Core::Describe(refused.error()), "url: expected wss://"));
}
