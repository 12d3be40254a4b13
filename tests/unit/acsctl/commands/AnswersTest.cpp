#include "commands/Answers.hpp"

#include "Catch.hpp"

namespace Acsctl = ACS::Acsctl;
using Acsctl::ApiAnswer;

namespace
{

int GetCode(unsigned status, std::string body)
{
    const auto got = Acsctl::GetBody(ApiAnswer{status, "application/json", std::move(body), "2"});
    return got.has_value() ? 0 : got.error().exitCode;
}

} // namespace

TEST_CASE("The status of an answer decides the exit code")
{
    CHECK(GetCode(200, "{}") == 0);
    CHECK(GetCode(202, "") == 0);
    for (const unsigned status : {400U, 404U, 409U, 500U, 503U})
    {
        CHECK(GetCode(status, R"({"error":"No."})") == 1);
        CHECK(GetCode(status, "No.") == 6);
    }
    CHECK(GetCode(301, "") == 6);
    CHECK(GetCode(401, R"({"error":"No."})") == 4);
    CHECK(GetCode(403, "<html>") == 4);
    CHECK(Acsctl::GetBody(ApiAnswer{503, "", R"({"error":"Full."})", "2"}).error().text == "Full. Try again in 2 s.");
}

TEST_CASE("A change whose answer is lost may have been executed")
{
    const Acsctl::ApiFailure lost{Acsctl::EApiFailure::ConnectionLost, "lost", true};
    CHECK(Acsctl::MakeError(lost, true).exitCode == 3);
    CHECK_THAT(Acsctl::MakeError(lost, true).text, Catch::Contains("may have executed"));
    CHECK(Acsctl::MakeError(lost, false).text == "lost");
    CHECK(Acsctl::MakeError({Acsctl::EApiFailure::CannotConnect, "no", false}, true).text == "no");
    CHECK(Acsctl::MakeError({Acsctl::EApiFailure::BadAnswer, "odd", true}, false).exitCode == 6);
}

TEST_CASE("JSON is passed on as it came, on one line, with escapes for what could control a terminal")
{
    Acsctl::AcsctlOptions options;
    options.command = Acsctl::ECommand::Robots;
    options.bJSON = true;
    CHECK(
        Acsctl::ShowAnswer(
            options,
            R"({"robots": [1.50]})"
            "\n",
            {})
            ->text
        == R"({"robots": [1.50]})"
           "\n");
    CHECK(Acsctl::ShowAnswer(options, "{\"robots\":\n []}", {})->text == "{\"robots\":[]}\n");
    CHECK(Acsctl::ShowAnswer(options, "{", {}).error().exitCode == 6);
    CHECK(Acsctl::ShowAnswer(options, "{\"robots\":\"\u009b\u202e\"}", {})->text == "{\"robots\":\"\\u009b\\u202e\"}\n");
    options.command = Acsctl::ECommand::Trace;
    CHECK(Acsctl::ShowAnswer(options, "{\"a\":1}\n\n{\"b\":2}", {})->text == "{\"a\":1}\n{\"b\":2}\n");
    CHECK(Acsctl::ShowAnswer(options, "{\"a\":1}\nodd\n", {}).error().exitCode == 6);
}
