#include "AcsdConfig.hpp"

#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "TemporaryFolder.hpp"

#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

/// The example site with these keys on top.
Acsd::AcsdConfig Read(const std::vector<std::string>& overrides)
{
    return Acsd::ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

} // namespace

TEST_CASE("The example site is without mistakes, and without TLS")
{
    const Acsd::AcsdConfig config = Read({});
    CHECK(config.mistakes.empty());
    CHECK(config.mcs.tls == ProtocolBeast::TlsOptions());
}

TEST_CASE("mcs.tls is read, its relative paths count from the folder of the configuration")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});
    const Acsd::AcsdConfig config = Read(
        {"mcs.url=wss://10.0.0.1:9001/acs/",
         "mcs.tls.ca=" + ca.certificate,
         "mcs.tls.certificate=" + own.certificate,
         "mcs.tls.key=" + own.key,
         "mcs.tls.server_name=mcs.example"});
    CHECK(config.mistakes.empty());
    CHECK(config.mcs.tls == ProtocolBeast::TlsOptions{ca.certificate, own.certificate, own.key, "mcs.example"});

    const Acsd::AcsdConfig relative = Read({"mcs.url=wss://10.0.0.1:9001/acs/", "mcs.tls.ca=nowhere.pem"});
    CHECK(relative.mcs.tls.caFile == std::string(ACS_SITE) + "/nowhere.pem");
}

TEST_CASE("A file for TLS that is missing or does not fit is a mistake with key, path and reason")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});

    const auto missing = Read({"mcs.url=wss://mcs/acs/", "mcs.tls.ca=/nowhere/ca.pem"}).mistakes;
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].find("mcs.tls.ca: expected a PEM file") != std::string::npos);
    CHECK(missing[0].find("/nowhere/ca.pem: No such file or directory") != std::string::npos);

    const auto foreign =
        Read({"mcs.url=wss://mcs/acs/", "mcs.tls.certificate=" + own.certificate, "mcs.tls.key=" + ca.key}).mistakes;
    REQUIRE(foreign.size() == 1);
    CHECK(foreign[0].find("mcs.tls.key: ") != std::string::npos);
    CHECK(foreign[0].find("is the key of another certificate than " + own.certificate) != std::string::npos);
}

TEST_CASE("mcs.tls with a ws URL is a mistake: it would encrypt nothing")
{
    const auto mistakes = Read({"mcs.tls.server_name=mcs.example"}).mistakes;
    REQUIRE(mistakes.size() == 1);
    CHECK(mistakes[0].find("mcs.tls: is for wss:// only") != std::string::npos);
}

TEST_CASE("mcs.headers go with the upgrade; what would break it is a mistake that does not show the value")
{
    CHECK(Read({}).mcs.headers.empty());
    const Acsd::AcsdConfig config = Read({"mcs.headers.Authorization=Bearer secret", "mcs.headers.X-Site=A"});
    CHECK(config.mistakes.empty());
    CHECK(config.mcs.headers == ProtocolBeast::HttpHeaders{{"Authorization", "Bearer secret"}, {"X-Site", "A"}});

    const auto control = Read({R"(mcs.headers.X-Key="secret\r\nX-Other: 1")"}).mistakes;
    REQUIRE(control.size() == 1);
    CHECK(control[0].find("mcs.headers.X-Key: expected a value without control characters") != std::string::npos);
    CHECK(control[0].find("secret") == std::string::npos);
    const auto own = Read({"mcs.headers.Sec-WebSocket-Key=x"}).mistakes;
    REQUIRE(own.size() == 1);
    CHECK(own[0].find("mcs.headers.Sec-WebSocket-Key: expected a header that") != std::string::npos);
    CHECK(Read({"mcs.headers.X-Number=1"}).mistakes.size() == 1);
}
