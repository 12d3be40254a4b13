#include "common/config/ShellCommand.hpp"

#include "Catch.hpp"

#include <string>
#include <utility>

namespace Apps = ACS::Apps;

TEST_CASE("A word with a meaning for a shell is quoted, any other stays as it is")
{
    using Row = std::pair<std::string, std::string>;
    const auto [word, quoted] = GENERATE(
        Row{"PLAN_1", "PLAN_1"},
        Row{"a:b@c%d+e/f,g-h.i", "a:b@c%d+e/f,g-h.i"},
        Row{"$(touch X);x y", "'$(touch X);x y'"},
        Row{"it's", R"('it'\''s')"},
        Row{"`id`", "'`id`'"},
        Row{"a=b", "'a=b'"},
        Row{"~", "'~'"},
        Row{"*", "'*'"},
        Row{"a\nb", "'a\nb'"},
        Row{"", "''"});
    CHECK(Apps::QuoteForShell(word) == quoted);
}

TEST_CASE("The words of a command line that begin with - follow --")
{
    CHECK(Apps::MakeShellCommand("resume", {"P1"}) == "acsctl resume P1");
    CHECK(Apps::MakeShellCommand("resume", {"-P 1"}) == "acsctl resume -- '-P 1'");
    CHECK(Apps::MakeShellCommand("unblock", {"node", "--yes"}) == "acsctl unblock -- node --yes");
    CHECK(Apps::MakeShellCommand("tsc resume", {}) == "acsctl tsc resume");
}
