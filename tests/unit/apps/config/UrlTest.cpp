#include "common/config/Url.hpp"

#include "Catch.hpp"

#include <string>

namespace Apps = ACS::Apps;
using Apps::EUrlScheme;

namespace
{

const std::vector<EUrlScheme>& GetAllSchemes()
{
    static const std::vector<EUrlScheme> ALL{
        EUrlScheme::Ws,
        EUrlScheme::Wss,
        EUrlScheme::Mqtt,
        EUrlScheme::Mqtts,
        EUrlScheme::Tcp,
        EUrlScheme::Http,
        EUrlScheme::Https};
    return ALL;
}

} // namespace

TEST_CASE("A URL without a port has the default port of its scheme")
{
    using Row = std::pair<const char*, std::uint16_t>;
    const auto [text, port] = GENERATE(
        Row{"ws://mcs", 80},
        Row{"wss://mcs", 443},
        Row{"mqtt://broker", 1883},
        Row{"mqtts://broker", 8883},
        Row{"tcp://arm", 49000},
        Row{"http://arm", 80},
        Row{"https://acsd", 443});
    const auto url = Apps::ParseURL(text, GetAllSchemes());
    REQUIRE(url.has_value());
    REQUIRE(url->peer.port == port);
}

TEST_CASE("A URL keeps its host, port and path")
{
    const auto url = Apps::ParseURL("wss://[::1]:9001/acs/?site=A", {EUrlScheme::Ws, EUrlScheme::Wss});
    REQUIRE(url == Apps::Url{EUrlScheme::Wss, {"::1", 9001}, "/acs/?site=A"});
    REQUIRE(Apps::MakeText(*url) == "wss://[::1]:9001/acs/?site=A");
    REQUIRE(Apps::ParseURL("ws://mcs:1", GetAllSchemes())->path == "/");
    REQUIRE(Apps::ParseURL("mqtt://broker/", GetAllSchemes())->path.empty());
    REQUIRE(Apps::ParseURL("ws://[::1]/x", GetAllSchemes())->peer == Apps::Endpoint{"::1", 80});
}

TEST_CASE("An invalid URL or scheme is refused with the allowed forms")
{
    const auto* const text = GENERATE(
        "",
        "broker:1883",
        "ws://broker",
        "MQTT://broker",
        "mqtt://",
        "mqtt://:1883",
        "mqtt://broker:0",
        "mqtt://broker:99999",
        "mqtt://broker:1883/topic",
        "mqtt://user@broker",
        "mqtt://bro ker");
    CAPTURE(text);
    const auto url = Apps::ParseURL(text, {EUrlScheme::Mqtt, EUrlScheme::Mqtts});
    REQUIRE_FALSE(url.has_value());
    REQUIRE(url.error().expected == "a URL mqtt://HOST[:PORT] or mqtts://HOST[:PORT]");
}

TEST_CASE("The error of a URL that is refused does not show its password")
{
    const auto url = Apps::ParseURL("mqtt://acs:Gehe1m@broker", {EUrlScheme::Mqtt});
    REQUIRE_FALSE(url.has_value());
    REQUIRE(url.error().found == "'mqtt://***@broker'");
}

TEST_CASE("The path of a URL has no blank, no fragment and no control character")
{
    const auto* const text = GENERATE("ws://mcs/a b", "ws://mcs/a#b", "ws://mcs/a\nHost: x", "ws://mcs/\x7f");
    REQUIRE_FALSE(Apps::ParseURL(text, GetAllSchemes()).has_value());
}

TEST_CASE("wss and mqtts are secure schemes")
{
    REQUIRE(Apps::IsSecure(EUrlScheme::Wss));
    REQUIRE(Apps::IsSecure(EUrlScheme::Mqtts));
    REQUIRE(Apps::IsSecure(EUrlScheme::Https));
    REQUIRE_FALSE(Apps::IsSecure(EUrlScheme::Ws));
    REQUIRE_FALSE(Apps::IsSecure(EUrlScheme::Http));
}
