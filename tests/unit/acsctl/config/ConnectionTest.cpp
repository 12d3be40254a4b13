#include "config/Connection.hpp"

#include "Catch.hpp"
#include "common/config/Url.hpp"

namespace Acsctl = ACS::Acsctl;

namespace
{

Acsctl::Contexts MakeContexts()
{
    Acsctl::Contexts contexts;
    contexts.current = "line1";
    contexts.entries["line1"] = {"https://10.0.0.5:8081", "T1", "", "ca.pem", "", ""};
    contexts.entries["line2"] = {"http://127.0.0.1:9", "", "token", "", "", ""};
    return contexts;
}

std::string Resolve(const Acsctl::ConnectionOptions& options, const Acsctl::Environment& environment)
{
    const auto connection = Acsctl::ResolveConnection(options, environment, MakeContexts());
    return connection.has_value()
        ? ACS::Apps::MakeText(connection->url) + " " + connection->token + connection->tokenFile
        : "error: " + connection.error();
}

} // namespace

TEST_CASE("The current context is used unless an address or a context is given")
{
    CHECK(Resolve({}, {}) == "https://10.0.0.5:8081/ T1");
    Acsctl::ConnectionOptions options;
    options.context = "line2";
    CHECK(Resolve(options, {}) == "http://127.0.0.1:9/ token");
    options.context = "line3";
    CHECK_THAT(Resolve(options, {}), Catch::StartsWith("error: there is no context \"line3\""));
    Acsctl::Environment environment;
    environment.context = "line2";
    CHECK(Resolve({}, environment) == "http://127.0.0.1:9/ token");
    CHECK(Acsctl::ResolveConnection({}, {}, {})->url.peer.port == 8081);
}

TEST_CASE("The token of the current context is not sent to another address")
{
    Acsctl::ConnectionOptions options;
    options.url = "https://other";
    CHECK(Resolve(options, {}) == "https://other:443/ ");
    Acsctl::Environment environment;
    environment.url = "https://other:1";
    CHECK(Resolve({}, environment) == "https://other:1/ ");
    options.context = "line1"; // named: on purpose
    CHECK(Resolve(options, environment) == "https://other:443/ T1");
    options.url.reset();
    CHECK(Resolve(options, environment) == "https://10.0.0.5:8081/ T1");
}

TEST_CASE("The option of the token comes before the environment, and this before the context")
{
    Acsctl::Environment environment;
    environment.token = "T2";
    CHECK(Resolve({}, environment) == "https://10.0.0.5:8081/ T2");
    Acsctl::ConnectionOptions options;
    options.tokenFile = "file";
    CHECK(Resolve(options, environment) == "https://10.0.0.5:8081/ file");
}

TEST_CASE("Contradicting options of the connection are refused")
{
    Acsctl::ConnectionOptions options;
    options.url = "ftp://x";
    CHECK_THAT(Resolve(options, {}), Catch::StartsWith("error: "));
    options.url = "https://x";
    options.key = "k";
    CHECK_THAT(Resolve(options, {}), Catch::Contains("--certificate and --key"));
    options.key.reset();
    options.url = "http://127.0.0.1";
    options.ca = "ca.pem";
    CHECK_THAT(Resolve(options, {}), Catch::Contains("https://"));
}

TEST_CASE("A token is sent encrypted, or to this machine only")
{
    Acsctl::Connection connection;
    connection.token = "T";
    for (const auto& [url, bRisk] :
         {std::pair{"http://127.0.0.1", false},
          std::pair{"http://localhost:1", false},
          std::pair{"http://10.0.0.5", true},
          std::pair{"https://10.0.0.5", false}})
    {
        CAPTURE(url);
        connection.url = *Acsctl::ParseHttpURL(url);
        CHECK(Acsctl::FindTokenRiskOrNull(connection).has_value() == bRisk);
    }
    connection.token.clear();
    connection.url = *Acsctl::ParseHttpURL("http://10.0.0.5");
    CHECK_FALSE(Acsctl::FindTokenRiskOrNull(connection).has_value());
}
