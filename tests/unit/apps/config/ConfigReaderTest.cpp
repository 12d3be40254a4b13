#include "common/config/ConfigReader.hpp"

#include "Catch.hpp"

#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace Apps = ACS::Apps;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace
{

using Lines = std::vector<std::string>;

constexpr const char* GOOD = R"([mcs]
url = 'ws://127.0.0.1:9001/acs/'
timeout = '5s'
retries = 3
factor = 1.5
whole = 2
compress = true
words = ['a', 'b']

[robots.LR01]
type = 'LR'

[robots."CR 01"]
type = 'CR'

[[ports]]
id = 'A01'
[[ports]]
id = 'A02'
)";

Apps::ConfigReader Read(std::string_view text, const Lines& overrides = {})
{
    return Apps::ConfigReader::ReadText(text, "acsd.toml", overrides);
}

} // namespace

TEST_CASE("A valid configuration returns its values and no errors")
{
    const auto reader = Read(GOOD);
    const auto mcs = reader.GetRoot().GetSection("mcs");
    CHECK(Apps::MakeText(mcs.GetURL("url", {Apps::EUrlScheme::Ws})) == "ws://127.0.0.1:9001/acs/");
    CHECK(mcs.GetDuration("timeout", 1s, 1min, 2s) == 5s);
    CHECK(mcs.GetInteger("retries", 0, 10) == 3);
    CHECK(mcs.GetNumber("factor", 0.0, 2.0) == 1.5);
    CHECK(mcs.GetNumber("whole", 0.0, 2.0) == 2.0);
    CHECK(mcs.IsEnabled("compress", false));
    CHECK(mcs.GetStringList("words") == Lines{"a", "b"});
    const auto robots = reader.GetRoot().GetSection("robots");
    CHECK(robots.GetNames() == Lines{"CR 01", "LR01"});
    CHECK(robots.GetSection("CR 01").GetWord("type", {"LR", "CR"}) == "CR");
    CHECK(robots.GetSection("LR01").GetWord("type", {"LR", "CR"}) == "LR");
    CHECK(robots.GetSection("CR 01").GetPath() == "robots.\"CR 01\"");
    const auto ports = reader.GetRoot().GetSectionList("ports");
    REQUIRE(ports.size() == 2);
    CHECK(ports[0].GetString("id") == "A01");
    CHECK(ports[1].GetString("id") == "A02");
    CHECK(reader.GetErrors().empty());
}

TEST_CASE("Absent optional keys have their defaults, also in an absent table")
{
    const auto reader = Read("");
    const auto http = reader.GetRoot().GetSection("http");
    CHECK(http.GetEndpoint("listen", {"127.0.0.1", 8080}) == Apps::Endpoint{"127.0.0.1", 8080});
    CHECK(http.GetString("name", "x") == "x");
    CHECK_FALSE(http.GetStringOrNull("name").has_value());
    CHECK(http.GetInteger("n", 1, 9, 4) == 4);
    CHECK(http.GetNumber("f", 1.0, 9.0, 4.5) == 4.5);
    CHECK(http.GetWord("w", {"a", "b"}, "b") == "b");
    CHECK(http.GetDuration("d", 1s, 9s, 3s) == 3s);
    CHECK(http.IsEnabled("e", true));
    CHECK(http.GetStringList("l").empty());
    CHECK(http.GetSectionList("s").empty());
    CHECK_FALSE(http.HasKey("listen"));
    CHECK(reader.GetErrors().empty());
}

TEST_CASE("All errors are reported, by line, each with file, line and key")
{
    const auto reader = Read(R"(
[mcs]
url = 'http://mcs'
timeout = '5 s'
pause = 5
retries = 11
compress = 1
words = ['a', 2]
[robots.LR01]
type = 'XX'
factor = nan
wait = '2m'
)");
    const auto robot = reader.GetRoot().GetSection("robots").GetSection("LR01");
    CHECK(robot.GetWord("type", {"LR", "CR"}).empty());
    CHECK(robot.GetString("serial").empty());
    CHECK(robot.GetNumber("factor", 0.0, 1.0) == 0.0);
    CHECK(robot.GetDuration("wait", 1s, 1min, 5s) == 5s);
    const auto mcs = reader.GetRoot().GetSection("mcs");
    CHECK(mcs.GetURL("url", {Apps::EUrlScheme::Ws}) == Apps::Url{});
    CHECK(mcs.GetDuration("timeout", 1s, 1min, 2s) == 2s);
    CHECK(mcs.GetDuration("pause", 1s, 1min, 2s) == 2s);
    CHECK(mcs.GetInteger("retries", 0, 10) == 0);
    CHECK(mcs.IsEnabled("compress", true));
    CHECK(mcs.GetStringList("words").empty());
    CHECK(reader.GetRoot().GetSection("site").GetString("map").empty());
    CHECK(
        reader.GetErrors()
        == Lines{
            "acsd.toml: site.map: missing; give a string",
            "acsd.toml:3: mcs.url: expected a URL ws://HOST[:PORT][/PATH], found 'http://mcs'",
            "acsd.toml:4: mcs.timeout: expected a duration such as '200ms', '5s', '2m' or '1h', found '5 s'",
            "acsd.toml:5: mcs.pause: expected a duration such as '200ms', '5s', '2m' or '1h', found the integer 5",
            "acsd.toml:6: mcs.retries: expected an integer from 0 to 10, found the integer 11",
            "acsd.toml:7: mcs.compress: expected true or false, found the integer 1",
            "acsd.toml:8: mcs.words: expected a list of strings, found the integer 2",
            "acsd.toml:9: robots.LR01.serial: missing; give a string",
            "acsd.toml:10: robots.LR01.type: expected 'LR' or 'CR', found the string 'XX'",
            "acsd.toml:11: robots.LR01.factor: expected a number from 0 to 1, found the number nan",
            "acsd.toml:12: robots.LR01.wait: expected a duration from '1s' to '1m', found '2m'",
        });
}

TEST_CASE("The error of a missing key states its form")
{
    const auto reader = Read("[mqtt]\n");
    (void)reader.GetRoot().GetSection("mqtt").GetURL("url", {Apps::EUrlScheme::Mqtt});
    CHECK(reader.GetErrors() == Lines{"acsd.toml:1: mqtt.url: missing; give a URL mqtt://HOST[:PORT]"});
}

TEST_CASE("A key that was not read is an error, with the nearest known key")
{
    const auto reader = Read("[mcs]\nulr = 'x'\nspeed = 1\n[robts.LR01]\ntype = 'LR'\n[[ports]]\nidd = 1\n");
    const auto mcs = reader.GetRoot().GetSection("mcs");
    (void)mcs.GetStringOrNull("url");
    (void)mcs.IsEnabled("compress", true);
    (void)reader.GetRoot().GetSection("robots");
    (void)reader.GetRoot().GetSectionList("ports").at(0).GetStringOrNull("id");
    CHECK(
        reader.GetErrors()
        == Lines{
            "acsd.toml:2: mcs.ulr: unknown key; did you mean 'url'?",
            "acsd.toml:3: mcs.speed: unknown key; allowed here: compress, url",
            "acsd.toml:4: robts: unknown key; did you mean 'robots'?",
            "acsd.toml:7: ports[0].idd: unknown key; did you mean 'id'?",
        });
}

TEST_CASE("An override is a TOML value or, if it is not valid TOML, a string")
{
    const auto reader = Read(
        GOOD,
        {"mcs.url=ws://h:1/#",
         "mcs.retries=7",
         "mcs.compress=false",
         "mcs.timeout='9s'",
         "store.directory=a b",
         "store.empty="});
    const auto mcs = reader.GetRoot().GetSection("mcs");
    CHECK(mcs.GetString("url") == "ws://h:1/#");
    CHECK(mcs.GetInteger("retries", 0, 10) == 7);
    CHECK_FALSE(mcs.IsEnabled("compress", true));
    CHECK(mcs.GetDuration("timeout", 1s, 1min, 2s) == 9s);
    CHECK(mcs.GetNumber("factor", 0.0, 2.0) == 1.5);
    CHECK(reader.GetRoot().GetSection("store").GetString("directory") == "a b");
    CHECK(reader.GetRoot().GetSection("store").GetString("empty", "x").empty());
}

TEST_CASE("The last override of a key wins; an override may add a table or name a quoted one")
{
    const auto reader = Read(
        "[robots.\"CR 01\"]\ntype = 'LR'\n",
        {"robots.\"CR 01\".type=AA", "robots.\"CR 01\".type=CR", "robots.X.type=LR"});
    const auto robots = reader.GetRoot().GetSection("robots");
    CHECK(robots.GetNames() == Lines{"CR 01", "X"});
    CHECK(robots.GetSection("CR 01").GetString("type") == "CR");
    CHECK(robots.GetSection("X").GetString("type") == "LR");
    CHECK(reader.GetErrors().empty());
}

TEST_CASE("An error in an override names the option and follows those of the file")
{
    const auto reader = Read(
        "[mcs]\nretries = 1\nx = 1\n",
        {"mcs.retries=many", "mcs.rerties=1", "nonsense", "a..b=1", "=1", "a\nb=1"});
    CHECK(reader.GetRoot().GetSection("mcs").GetInteger("retries", 0, 10) == 0);
    const Lines mistakes = reader.GetErrors();
    REQUIRE(mistakes.size() == 7);
    CHECK_THAT(mistakes[0], StartsWith("acsd.toml:3: mcs.x: unknown key"));
    for (std::size_t index = 1; index < mistakes.size(); ++index)
    {
        CHECK_THAT(mistakes[index], StartsWith("--set: "));
    }
    const std::string all = mistakes[1] + mistakes[2] + mistakes[3] + mistakes[4] + mistakes[5] + mistakes[6];
    CHECK_THAT(all, Contains("mcs.retries: expected an integer from 0 to 10, found the string 'many'"));
    CHECK_THAT(all, Contains("mcs.rerties: unknown key; did you mean 'retries'?"));
    CHECK_THAT(all, Contains("'nonsense': write table.key=value"));
    CHECK_THAT(all, Contains("'a..b=1': write table.key=value"));
    CHECK_THAT(all, Contains("'=1': write table.key=value"));
    CHECK(Read("", {"a\nb"}).GetErrors() == Lines{"--set: 'a?b': write table.key=value"});
}

TEST_CASE("An override that replaces a table by a value, or a value by a table, is an error")
{
    const auto reader = Read(GOOD, {"mcs=5", "robots.LR01.type.x=1"});
    CHECK(reader.GetRoot().GetSection("mcs").GetString("url").empty());
    CHECK(reader.GetRoot().GetSection("robots").GetSection("LR01").GetString("type").empty());
    const Lines mistakes = reader.GetErrors();
    CHECK(std::count(mistakes.begin(), mistakes.end(), "--set: mcs: expected a table, found the integer 5") == 1);
    CHECK(
        std::count(mistakes.begin(), mistakes.end(), "--set: robots.LR01.type: expected a string, found a table") == 1);
}

TEST_CASE("An error of the caller has the line of its key")
{
    const auto reader = Read("[robots.LR01]\nnode = 'N9'\n");
    const auto robot = reader.GetRoot().GetSection("robots").GetSection("LR01");
    CHECK(robot.GetString("node") == "N9");
    robot.AddError("node", "no such node in the map");
    robot.AddError({}, "too many robots");
    CHECK(
        reader.GetErrors()
        == Lines{
            "acsd.toml:1: robots.LR01: too many robots",
            "acsd.toml:2: robots.LR01.node: no such node in the map",
        });
}

TEST_CASE("Only the first error of a key is reported, and none inside a refused table")
{
    const Apps::ConfigReader reader =
        Apps::ConfigReader::ReadText("a = 7\n[b]\nx = 1\ny = 2\n[c]\nz = 3\n", "f.toml", {"c=4"});
    const Apps::ConfigSection root = reader.GetRoot();
    static_cast<void>(root.GetString("a"));
    root.AddError("a", "is empty");
    root.GetSection("b").Refuse("has no good name");
    root.GetSection("b").AddError("x", "is bad");
    static_cast<void>(root.GetSection("c").GetString("z"));
    static_cast<void>(root.GetSection("c"));
    CHECK(
        reader.GetErrors()
        == std::vector<std::string>{
            "f.toml:1: a: expected a string, found the integer 7",
            "f.toml:2: b: has no good name",
            "--set: c: expected a table, found the integer 4"});
}

TEST_CASE("An error by path has the line of the key, or of its nearest parent that exists")
{
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadText("[a]\n[a.b]\nc = 1\n", "f.toml", {"d.e=1"});
    reader.AddError("a.b.c", "1");
    reader.AddError("a.b.x", "2");
    reader.AddError("a.b.c.deeper", "3");
    reader.AddError("d.e", "4");
    reader.AddError("nothing.of.it", "5");
    std::vector<std::string> mistakes = reader.GetErrors();
    std::erase_if(mistakes, [](const std::string& mistake) {
        return mistake.find("unknown key") != std::string::npos;
    });
    CHECK(
        mistakes
        == std::vector<std::string>{
            "f.toml: nothing.of.it: 5",
            "f.toml:2: a.b.x: 2",
            "f.toml:3: a.b.c: 1",
            "f.toml:3: a.b.c.deeper: 3",
            "--set: d.e: 4"});
}

TEST_CASE("A file that is not valid TOML has a single error with its line")
{
    const auto reader = Read("[mcs]\nurl = 'x'\nurl = \n", {"bad"});
    CHECK(reader.GetRoot().GetSection("mcs").GetString("url").empty());
    REQUIRE(reader.GetErrors().size() == 1);
    CHECK_THAT(reader.GetErrors()[0], StartsWith("acsd.toml:3: not TOML: "));
}

TEST_CASE("Excessive nesting is an error")
{
    const auto reader = Read("a = " + std::string(100'000, '['));
    REQUIRE(reader.GetErrors().size() == 1);
}

TEST_CASE("A file that cannot be read has a single error with the remedy")
{
    const auto* const name = GENERATE("/nonexistent/acsd.toml", "/");
    const auto reader = Apps::ConfigReader::ReadFile(name, {"a.b=1"});
    CHECK(reader.GetRoot().GetSection("mcs").GetString("url").empty());
    REQUIRE(reader.GetErrors().size() == 1);
    CHECK_THAT(reader.GetErrors()[0], StartsWith(std::string(name) + ": cannot be read ("));
}

TEST_CASE("GetValues has the path and value of every given key, overrides included")
{
    const Apps::ConfigReader reader =
        Read("a = 1\n[mcs]\nurl = \"ws://a\"\nlist = [\"x\", \"y\"]\n[[row]]\nk = true\n", {"mcs.url=ws://b"});
    const std::map<std::string, std::string> expected{
        {"a", "1"},
        {"mcs.url", R"("ws://b")"},
        {"mcs.list", R"([ "x", "y" ])"},
        {"row", "[ { k = true } ]"}};
    CHECK(reader.GetValues() == expected);
}

TEST_CASE("An override replaces the value of its key, also a table, and keeps the keys beside it")
{
    const Apps::ConfigReader reader = Read(
        "[job]\nlimit = 1\ninputs = { x = 1, y = 2 }\nmore = { x = 1, y = 2 }\n",
        {"job.inputs={z=3}", "job.more.x=4"});
    const std::map<std::string, std::string> expected{
        {"job.limit", "1"},
        {"job.inputs.z", "3"},
        {"job.more.x", "4"},
        {"job.more.y", "2"}};
    CHECK(reader.GetValues() == expected);
}
