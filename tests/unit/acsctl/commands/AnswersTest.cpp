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
    CHECK_THAT(
        Acsctl::GetBody(ApiAnswer{401, "", R"({"error":"A token is required."})", ""}).error().text,
        Catch::StartsWith("A token is required. Identify with --token-file FILE"));
    CHECK(Acsctl::GetBody(ApiAnswer{503, "", R"({"error":"Full."})", "2"}).error().text == "Full. Try again in 2 s.");
}

TEST_CASE("The reason that acsd states as plain text is shown")
{
    const auto getText = [](unsigned status, const std::string& type, const std::string& body) {
        return Acsctl::GetBody(ApiAnswer{status, type, body, {}}).error().text;
    };
    const std::string plain = "text/plain; charset=utf-8";
    CHECK(
        getText(403, plain, "host name \"vm\" is not allowed\n")
        == R"(not authorised: HTTP status 403: host name "vm" is not allowed)");
    CHECK(getText(403, "text/html", "<html>") == "not authorised: HTTP status 403 with text/html");
    CHECK(
        getText(400, plain, "a\x1b[2J\nb")
        == R"(the answer is not one of acsd's operator API: HTTP status 400: a\x1b[2J b)");
    CHECK(getText(400, plain, std::string(100'000, 'x')).size() < 1'000);
    CHECK_THAT(getText(431, plain, "the header is too large"), !Catch::Contains("operator.listen"));
    CHECK_THAT(getText(404, plain, "not found"), Catch::EndsWith("not found; is it the address of operator.listen?"));
    CHECK_THAT(getText(502, "text/html", "<html>"), Catch::Contains("operator.listen"));
    CHECK_THAT(
        Acsctl::GetBodyFrom("http.listen", ApiAnswer{404, plain, "not found", {}}).error().text,
        Catch::Contains("is it the address of http.listen?"));
}

TEST_CASE("A change whose answer is not that of acsd may have been executed")
{
    const auto getError = [](unsigned status, const std::string& body) {
        const auto shown = Acsctl::ShowChange({}, ApiAnswer{status, "text/html", body, {}});
        return shown.has_value() ? std::string() : shown.error().text;
    };
    CHECK(Acsctl::ShowChange({}, ApiAnswer{202, "application/json", R"({"message":"Yes."})", {}})->text == "Yes.\n");
    for (const unsigned status : {200U, 302U, 500U, 502U, 504U})
    {
        CAPTURE(status);
        CHECK_THAT(
            getError(status, "<html>"),
            Catch::EndsWith("acsd may have executed the command: check before you repeat it"));
    }
    CHECK_THAT(getError(504, R"({"error":"No."})"), Catch::Contains("may have executed"));
    CHECK_THAT(getError(409, R"({"error":"No."})"), !Catch::Contains("may have executed"));
    CHECK_THAT(getError(404, "<html>"), !Catch::Contains("may have executed"));
}

TEST_CASE("An accepted control of a plan names the commands that show its outcome")
{
    Acsctl::AcsctlOptions options;
    options.command = Acsctl::ECommand::Cancel;
    options.arguments.id = "P 1";
    const ApiAnswer answer{202, "application/json", R"({"message":"Accepted."})", {}};
    CHECK(
        Acsctl::ShowChange(options, answer)->text
        == "Accepted.\nacsctl plan 'P 1' and acsctl events show the outcome.\n");
    options.bJSON = true;
    CHECK(
        Acsctl::ShowChange(options, answer)->text
        == R"({"message":"Accepted."})"
           "\n");
    options.bJSON = false;
    options.command = Acsctl::ECommand::Block;
    CHECK(Acsctl::ShowChange(options, answer)->text == "Accepted.\n");
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
    CHECK(
        // NOLINTNEXTLINE(misc-misleading-bidirectional): what is tested
        Acsctl::ShowAnswer(options, "{\"robots\":\"\u009b\u202e\"}", {})->text == "{\"robots\":\"\\u009b\\u202e\"}\n");
    options.command = Acsctl::ECommand::Trace;
    CHECK(Acsctl::ShowAnswer(options, "{\"a\":1}\n\n{\"b\":2}", {})->text == "{\"a\":1}\n{\"b\":2}\n");
    CHECK(Acsctl::ShowAnswer(options, "{\"a\":1}\nodd\n", {}).error().exitCode == 6);
}
