#include "commands/ActionCommand.hpp"

#include "Catch.hpp"
#include "commands/Requests.hpp"
#include "view/ActionViews.hpp"

#include <string>
#include <utility>
#include <vector>

namespace Acsctl = ACS::Acsctl;

namespace
{

/// A robot that offers "beep" with the parameters n (NUMBER) and s (STRING).
Acsctl::ActionsAnswer MakeBeep()
{
    Acsctl::ActionsAnswer answer;
    answer.offered.push_back({"beep", "", {{"n", "NUMBER", true}, {"s", "STRING", false}}});
    return answer;
}

std::string MakeBody(const std::vector<std::string>& parameters)
{
    Acsctl::CommandArguments arguments;
    arguments.word = "beep";
    arguments.parameters = parameters;
    return Acsctl::MakeActionBody(arguments, MakeBeep()).value();
}

} // namespace

TEST_CASE("A parameter that is offered as STRING is sent as a text, any other as JSON if it is JSON")
{
    using Row = std::pair<std::string, std::string>;
    const auto [parameter, member] = GENERATE(
        Row{"n=1.50", R"("n":1.5)"},
        Row{"n=-2", R"("n":-2)"},
        Row{"n=one", R"("n":"one")"},
        Row{"s=2", R"("s":"2")"},
        Row{"s=true", R"("s":"true")"},
        Row{"s=", R"("s":"")"},
        Row{"o={\"a\": [1, 2]}", R"("o":{"a":[1,2]})"},
        Row{"o=true", R"("o":true)"},
        Row{"o=\"1\"", R"("o":"1")"},
        Row{"o=a=b", R"("o":"a=b")"},
        Row{"o={", R"("o":"{")"});
    CHECK(MakeBody({parameter}) == R"({"actionType":"beep","parameters":{)" + member + "}}");
}

TEST_CASE("An instant action has a question, and the same target for its request and its outcome")
{
    Acsctl::AcsctlOptions options;
    options.command = Acsctl::ECommand::Action;
    options.arguments.id = "LR 01";
    options.arguments.word = "beep";
    CHECK(Acsctl::MakeReadTarget(options) == "/v1/robots/LR%2001/actions");
    CHECK(Acsctl::MakeQuestionOrNull(options) == "Send beep to LR 01?");
    CHECK_FALSE(Acsctl::MakeChangeOrNull(options).has_value());
}

TEST_CASE("The body has the reason, and no parameters without any")
{
    Acsctl::CommandArguments arguments;
    arguments.word = "beep";
    arguments.reason = "a \"test\"";
    CHECK(Acsctl::MakeActionBody(arguments, {}) == R"({"actionType":"beep","reason":"a \"test\""})");
    arguments.parameters = {"x=1", "x=2"};
    const Acsctl::Outcome<std::string> body = Acsctl::MakeActionBody(arguments, {});
    REQUIRE_FALSE(body.has_value());
    CHECK(body.error().exitCode == Acsctl::EXIT_BAD_INPUT);
}

TEST_CASE("The actions of a robot are a table, followed by those that it offers")
{
    Acsctl::ActionsAnswer answer;
    CHECK(Acsctl::PrintActions(answer, {}) == "No instant action was requested.\n\nThe robot offers none.\n");
    answer = MakeBeep();
    answer.actions.push_back({"A1", "beep", "Failed", "no horn", "2026-11-27T23:10:00.000Z", std::nullopt});
    const std::string text = Acsctl::PrintActions(answer, {});
    CHECK(text.find("beep    Failed") != std::string::npos);
    CHECK(text.find("no horn") != std::string::npos);
    CHECK(text.find("n=NUMBER [s=STRING]") != std::string::npos);
    CHECK(Acsctl::MakeOutcomeLine("LR01", answer.actions[0]) == "beep of LR01: Failed: no horn\n");
    answer.actions[0].resultDescription = "\x1b[2J";
    CHECK(Acsctl::MakeOutcomeLine("LR01", answer.actions[0]).find('\x1b') == std::string::npos);
}
