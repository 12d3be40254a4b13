#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "ChildProcess.hpp"
#include "LinkFixture.hpp"

#include <fstream>
#include <memory>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EMqttVersion;
using VDA5050::MosquittoTLS;

class TlsTest
{
protected:
    TemporaryFolder _folder;
    CertificateMaker _maker{_folder.GetPath()};
    CertificateFiles _ca = _maker.MakeCA("ca");
    boost::asio::io_context _context;

    [[nodiscard]] std::string MakeSettings(const CertificateRequest& request, const std::string& more = {})
    {
        const CertificateFiles files = _maker.Make(_ca, request);
        return "allow_anonymous true\ncafile " + _ca.certificate + "\ncertfile " + files.certificate + "\nkeyfile "
            + files.key + "\n" + more;
    }

    [[nodiscard]] std::unique_ptr<TestLink> MakeLink(
        const MosquittoBroker& broker,
        const std::optional<MosquittoTLS>& tlsOrNull,
        const std::string& clientID = "client",
        const std::string& filter = {})
    {
        auto options = MakeOptions(broker.GetPort(), clientID);
        options.tls = tlsOrNull;
        auto link = std::make_unique<TestLink>(_context, options);
        if (!filter.empty())
        {
            link->link.Subscribe({{filter, 2}});
        }
        link->link.Start();
        return link;
    }

    [[nodiscard]] bool CanConnect(const std::unique_ptr<TestLink>& link)
    {
        // A link that cannot connect logs it at the first attempt.
        CHECK(TryRunUntil(_context, [&]() { return link->listener.ups == 1 || !link->log.GetLines().empty(); }));
        return link->listener.ups == 1;
    }
};

} // namespace

TEST_CASE_METHOD(TlsTest, "2 Over TLS thousands of messages arrive complete and in order")
{
    const MosquittoBroker broker(MakeSettings({}, "max_queued_messages 0\n"));
    const auto receiver = MakeLink(broker, MosquittoTLS{_ca.certificate, {}, {}}, "receiver", "load");
    REQUIRE(CanConnect(receiver));
    const auto sender = MakeLink(broker, MosquittoTLS{_ca.certificate, {}, {}}, "sender");
    REQUIRE(CanConnect(sender));
    constexpr std::size_t COUNT = 3000;
    const std::string filling(700, 'x');
    std::size_t sent = 0;
    REQUIRE(TryRunUntil(_context, [&]() {
        while (sent < COUNT && sender->link.Publish({"load", std::to_string(sent) + filling, 2, false}).has_value())
        {
            ++sent;
        }
        return receiver->listener.messages.size() >= COUNT;
    }));
    for (std::size_t i = 0; i < COUNT; ++i)
    {
        REQUIRE(receiver->listener.messages[i].payload == std::to_string(i) + filling);
    }
}

TEST_CASE_METHOD(
    TlsTest,
    "2 No connection is made to a broker with an invalid certificate, and the log names what to check")
{
    CertificateRequest request;
    std::optional<MosquittoTLS> tls = MosquittoTLS{_ca.certificate, {}, {}};
    SECTION("by another authority")
    {
        tls->caFile = _maker.MakeCA("other").certificate;
    }
    SECTION("for another host")
    {
        request.alternativeName = "DNS:elsewhere.test";
    }
    SECTION("expired")
    {
        request.validFrom = -48h;
        request.validTo = -1h;
    }
    const MosquittoBroker broker(MakeSettings(request));
    const auto link = MakeLink(broker, tls);
    CHECK_FALSE(CanConnect(link));
    CHECK_THAT(link->log.GetLines().front().message, Catch::Contains("check the certificates"));
}

TEST_CASE_METHOD(TlsTest, "2 A broker that requires a client certificate accepts only one of its authority")
{
    const MosquittoBroker broker(MakeSettings({}, "require_certificate true\n"));
    const CertificateFiles own = _maker.Make(_ca, {});
    CHECK(CanConnect(MakeLink(broker, MosquittoTLS{_ca.certificate, own.certificate, own.key}, "own")));
    CHECK_FALSE(CanConnect(MakeLink(broker, MosquittoTLS{_ca.certificate, {}, {}}, "none")));
    const CertificateFiles foreign = _maker.MakeSelfSigned({});
    CHECK_FALSE(CanConnect(MakeLink(broker, MosquittoTLS{_ca.certificate, foreign.certificate, foreign.key}, "other")));
    CHECK_FALSE(CanConnect(MakeLink(broker, MosquittoTLS{"/nowhere.pem", {}, {}}, "nowhere")));
    CHECK_FALSE(CanConnect(MakeLink(broker, std::nullopt, "plain")));
}

TEST_CASE("2 User and password work with either version of MQTT; a wrong password is reported")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const TemporaryFolder folder;
    const std::string passwords = folder.GetPath() / "passwords";
    std::ofstream(passwords) << "";
    std::filesystem::permissions(passwords, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    ChildProcess maker({"/usr/bin/mosquitto_passwd", "-b", passwords, "acs", "secret"});
    REQUIRE(maker.WaitForExitOrNull(10s) == 0);
    const MosquittoBroker broker("allow_anonymous false\npassword_file " + passwords + "\n");
    boost::asio::io_context context;
    auto options = MakeOptions(broker.GetPort(), "client");
    options.version = version;
    options.username = "acs";
    options.password = "secret";
    TestLink right(context, options);
    right.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return right.listener.ups == 1; }));
    options.password = "guess";
    options.clientID = "other";
    TestLink wrong(context, options);
    wrong.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return !wrong.log.GetLines().empty(); }));
    CHECK(wrong.listener.ups == 0);
    CHECK_THAT(wrong.log.GetLines().front().message, Catch::Contains("check user name"));
}

} // namespace ACS::Testing
