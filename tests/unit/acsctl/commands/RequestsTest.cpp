#include "commands/Requests.hpp"

#include "Catch.hpp"
#include "options/AcsctlParser.hpp"

#include <string>
#include <utility>
#include <vector>

namespace Acsctl = ACS::Acsctl;

namespace
{

using Line = std::vector<std::string>;

Acsctl::AcsctlOptions ParseLine(Line words)
{
    words.insert(words.begin(), "acsctl");
    Acsctl::AcsctlOptions options;
    REQUIRE_FALSE(Acsctl::ParseOptionsOrNull(words, options).has_value());
    return options;
}

} // namespace

TEST_CASE("A command that reads becomes a target")
{
    using Row = std::pair<Line, const char*>;
    const auto [words, target] = GENERATE(
        Row{{"status"}, "/v1/status"},
        Row{{"plans"}, "/v1/plans"},
        Row{{"plans", "--lot", "A&B/로", "--limit", "9"}, "/v1/plans?lot=A%26B%2F%EB%A1%9C&limit=9"},
        Row{{"plan", "P 1/2"}, "/v1/plans/P%201%2F2"},
        Row{{"robot", "LR01"}, "/v1/robots/LR01"},
        Row{{"actions", "LR 01"}, "/v1/robots/LR%2001/actions"},
        Row{{"trace", "--plan", "P", "--robot", "R"}, "/v1/trace?plan=P&robot=R"},
        Row{{"audit", "--limit", "3"}, "/v1/audit?limit=3"},
        Row{{"site"}, "/v1/site"});
    CHECK(Acsctl::MakeReadTarget(ParseLine(words)) == target);
    CHECK_FALSE(Acsctl::MakeChangeOrNull(ParseLine(words)).has_value());
    CHECK_FALSE(Acsctl::MakeQuestionOrNull(ParseLine(words)).has_value());
}

TEST_CASE("A command that changes something becomes a POST, and is asked about where it ends work or lets robots move")
{
    struct Row
    {
        Line words;
        const char* target;
        const char* body;
        bool bAsked;
    };
    const Row row = GENERATE(
        Row{{"cancel", "P/1"}, "/v1/plans/P%2F1/cancel", "", true},
        Row{{"abort", "P1", "--reason", "x"}, "/v1/plans/P1/abort", R"({"reason":"x"})", true},
        Row{{"pause", "P1"}, "/v1/plans/P1/pause", "", false},
        Row{{"resume", "P1"}, "/v1/plans/P1/resume", "", true},
        Row{{"priority", "P1", "7"}, "/v1/plans/P1/priority", R"({"priority":7})", false},
        Row{{"resolve", "P1", "J/1", "done"}, "/v1/plans/P1/jobs/J%2F1/resolve", R"({"outcome":"done"})", true},
        Row{{"skip", "P1", "3"}, "/v1/plans/P1/steps/3/skip", "", true},
        Row{{"maintenance", "LR01", "on"}, "/v1/robots/LR01/maintenance", R"({"on":true})", false},
        Row{{"maintenance", "LR01", "off"}, "/v1/robots/LR01/maintenance", R"({"on":false})", true},
        Row{{"carriers", "LR01", "C", "-"}, "/v1/robots/LR01/carriers", R"({"carrierIds":["C",null]})", true},
        Row{{"clear", "LR01", "ACS-1004"}, "/v1/alarms/clear", R"({"robotId":"LR01","errorCode":"ACS-1004"})", true},
        Row{{"clear", "LR01", "X", "--plan", "P", "--job", "J"},
            "/v1/alarms/clear",
            R"({"robotId":"LR01","errorCode":"X","planId":"P","jobId":"J"})",
            true},
        Row{{"tsc", "pause"}, "/v1/tsc/pause", "", false},
        Row{{"tsc", "resume"}, "/v1/tsc/resume", "", true},
        Row{{"block", "node", "N1", "--reason", "\"wet\""},
            "/v1/site/block",
            R"({"kind":"node","id":"N1","reason":"\"wet\""})",
            false},
        Row{{"unblock", "edge", "E1"}, "/v1/site/unblock", R"({"kind":"edge","id":"E1"})", true});
    const Acsctl::AcsctlOptions options = ParseLine(row.words);
    const auto request = Acsctl::MakeChangeOrNull(options);
    REQUIRE(request.has_value());
    CHECK(request->method == "POST");
    CHECK(request->target == row.target);
    CHECK(request->body == row.body);
    CHECK(Acsctl::MakeQuestionOrNull(options).has_value() == row.bAsked);
}
