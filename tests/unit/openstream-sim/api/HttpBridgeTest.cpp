#include "api/HttpBridge.hpp"

#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <string>

using ACS::Apps::HttpRequest;
using ACS::Apps::HttpResponse;
using ACS::Testing::ControllerFixture;

namespace
{

HttpResponse Send(ControllerFixture& fixture, const HttpRequest& request)
{
    return ACS::OpenStreamSim::AnswerHTTP(request, fixture.controller, fixture.clock.GetNow());
}

} // namespace

TEST_CASE("HTTP and Open Stream see the same controller")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(
        Send(fixture, {"POST", "/project/context/tasks[0]/cur_prog_cnt", {}, R"({ "pno" : 11, "ext_sel" : 1 })"}).status
        == 200);
    REQUIRE(Send(fixture, {"POST", "/robot/start", {}, ""}).status == 200); // an empty body counts as {}
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    const HttpResponse words = Send(fixture, {"GET", "/project/plc/m/val_s32", {{"st", "400"}, {"len", "1"}}, ""});
    REQUIRE(words.status == 200);
    REQUIRE(words.contentType == "application/json; charset=utf-8");
    REQUIRE(words.body == "[1]");
    const HttpResponse refusal = Send(fixture, {"POST", "/project/robot/start", {}, "{}"});
    REQUIRE(refusal.status == 403);
    REQUIRE(refusal.body.find(R"("err_code":-1442080)") != std::string::npos);
    REQUIRE(Send(fixture, {"PUT", "/project/control/op_cnd", {}, R"({"plc_mode":1})"}).status == 200);
}

TEST_CASE("7.29 An encoded query is the same request over HTTP and Open Stream")
{
    ControllerFixture fixture;
    for (const char* query :
         {"?%6Ano_start=%31&jno_n=1",
          "?jno_start=1%20&jno_n=1",
          "?jno_start=1+&jno_n=1",
          "?jno_start=%2B1",
          "?jno_n=%2"})
    {
        INFO(query);
        const std::string url = std::string("/project/robot/joint_states") + query;
        const ACS::Core::Result<HttpRequest> target = ACS::Apps::ParseHttpTarget(url);
        if (target.has_value()) // An invalid escape is no HTTP.
        {
            HttpRequest request = *target;
            request.method = "GET";
            CHECK(Send(fixture, request).body == fixture.Get(url));
        }
        CHECK((fixture.Call(ACS::OpenStream::EApiMethod::Get, url).status == 200) == (query[1] == '%'));
    }
}

TEST_CASE("A body that is not a JSON object or array is refused, a method that the Open API lacks is not found")
{
    ControllerFixture fixture;
    for (const char* body : {"{", "7", "\"x\"", "null", "{} {}", R"({"val":1,"val":2})", "\xFF"})
    {
        INFO(body);
        const HttpResponse response = Send(fixture, {"POST", "/project/robot/tool_no", {}, body});
        REQUIRE(response.status == 400);
        REQUIRE(response.body.find(R"("err_code":-1)") != std::string::npos);
    }
    REQUIRE(Send(fixture, {"HEAD", "/project/robot", {}, ""}).status == 200);
    REQUIRE(Send(fixture, {"HEAD", "/project/nothing", {}, ""}).status == 404);
    REQUIRE(Send(fixture, {"PATCH", "/project/robot", {}, "{}"}).status == 404);
    REQUIRE(Send(fixture, {"DELETE", "/project/robot", {}, ""}).status == 404);
    REQUIRE(fixture.Contains("/project/robot", R"("tool_no":0)"));
}

TEST_CASE("A path is decoded once: %255B is not a bracket, and a NUL or another byte does not end the path")
{
    ControllerFixture fixture;
    const std::string body = R"({"pno":11,"ext_sel":1})";
    REQUIRE(Send(fixture, {"POST", "/project/context/tasks%5B0%5D/cur_prog_cnt", {}, body}).status == 404);
    REQUIRE(Send(fixture, {"POST", "/project/context/tasks[0]/cur_prog_cnt", {}, body}).status == 200);
    for (const std::string& end :
         {std::string(1, '\0'), std::string("\xFF"), std::string("%"), std::string("/"), std::string("/..")})
    {
        const HttpResponse response = Send(fixture, {"GET", "/project/robot" + end, {}, ""});
        REQUIRE(response.status == 404);
        REQUIRE(ACS::Core::JsonText::IsUtf8(response.body));
    }
}
