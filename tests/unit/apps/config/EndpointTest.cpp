#include "common/config/Endpoint.hpp"

#include "Catch.hpp"
#include "common/process/ReadyLine.hpp"

#include <string>

namespace Apps = ACS::Apps;

TEST_CASE("An endpoint is a host and a port; port 0 is allowed")
{
    REQUIRE(Apps::ParseEndpoint("127.0.0.1:0") == Apps::Endpoint{"127.0.0.1", 0});
    REQUIRE(Apps::ParseEndpoint("mcs-1.local:65535") == Apps::Endpoint{"mcs-1.local", 65535});
    REQUIRE(Apps::ParseEndpoint("[::1]:80") == Apps::Endpoint{"::1", 80});
}

TEST_CASE("An invalid endpoint is refused with the expected form")
{
    const auto* const text = GENERATE(
        "",
        ":",
        "host",
        "host:",
        ":80",
        "host:65536",
        "host:-1",
        "host:8x",
        "::1:80",
        "[::1]",
        "[]:80",
        "a b:80",
        "[x y]:1");
    const auto endpoint = Apps::ParseEndpoint(text);
    CAPTURE(text);
    REQUIRE_FALSE(endpoint.has_value());
    REQUIRE(endpoint.error().expected.find("HOST:PORT") != std::string::npos);
    REQUIRE(endpoint.error().found == "'" + std::string(text) + "'");
}

TEST_CASE("An endpoint is written as it is read")
{
    const auto* const text = GENERATE("localhost:1883", "[fe80::1%eth0]:9001");
    REQUIRE(Apps::MakeText(*Apps::ParseEndpoint(text)) == text);
}

TEST_CASE("The ready line names each address")
{
    REQUIRE(
        Apps::MakeReadyLine({{"stream", {"127.0.0.1", 49000}}, {"http", {"::1", 8888}}})
        == "ready: stream=127.0.0.1:49000 http=[::1]:8888");
}

TEST_CASE("Only localhost and addresses of the loopback interface are this machine for sure")
{
    for (const char* host : {"localhost", "127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1"})
    {
        CAPTURE(host);
        CHECK(Apps::IsLoopback(host));
    }
    for (const char* host : {"0.0.0.0", "::", "10.0.0.1", "::ffff:10.0.0.1", "acs.example", "localhost.example", ""})
    {
        CAPTURE(host);
        CHECK_FALSE(Apps::IsLoopback(host));
    }
}
