#include "config/ContextFile.hpp"

#include "Catch.hpp"

namespace Acsctl = ACS::Acsctl;

TEST_CASE("A configuration file that is written is read again")
{
    Acsctl::Contexts contexts;
    contexts.current = "a.b";
    contexts.entries["a.b"] = {"https://acsd:8081", "to\"ken\\", "", "/ca.pem", "/c.pem", "/k.pem"};
    contexts.entries["line-2"] = {"http://127.0.0.1:1", "", "/token", "", "", ""};
    CHECK(Acsctl::ReadContexts(Acsctl::WriteContexts(contexts), "config.toml") == contexts);
    CHECK(Acsctl::ReadContexts(Acsctl::WriteContexts({}), "config.toml") == Acsctl::Contexts());
    CHECK(Acsctl::ReadContexts("", "config.toml") == Acsctl::Contexts());
}

TEST_CASE("Errors of a configuration file name the file and the key")
{
    const auto* const text = GENERATE(
        "current = 5",
        "current = 'a'",
        "odd = 1",
        "contexts = 1",
        "[contexts.a]\nurl = 'x'",
        "[contexts.a]\nodd = 1",
        "[contexts.a]\ntoken = 't'\ntoken_file = 'f'",
        "[contexts.'a b']\nurl = 'http://x'",
        "[[contexts]]\nurl = 'http://x'",
        "= =");
    CAPTURE(text);
    const auto contexts = Acsctl::ReadContexts(text, "config.toml");
    REQUIRE_FALSE(contexts.has_value());
    CHECK_THAT(contexts.error(), Catch::StartsWith("config.toml:"));
}
