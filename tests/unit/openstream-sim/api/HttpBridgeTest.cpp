#include "api/HttpBridge.hpp"

#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

using ACS::Apps::HttpRequest;
using ACS::Apps::HttpResponse;
using ACS::Testing::ControllerFixture;

namespace
{

HttpResponse Send(ControllerFixture& harness, const HttpRequest& request)
{
    return ACS::OpenStreamSim::AnswerHTTP(request, harness.controller, harness.clock.GetNow());
}

} // namespace

TEST_CASE("HTTP and Open Stream see the same controller")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(
        Send(harness, {"POST", "/project/context/tasks[0]/cur_prog_cnt", {}, R"({ "pno" : 11, "ext_sel" : 1 })"}).status
        == 200);
    REQUIRE(Send(harness, {"POST", "/robot/start", {}, ""}).status == 200); // an empty body counts as {}
    REQUIRE(harness.GetCounters() == "[1,0,0,0]");
    const HttpResponse words = Send(harness, {"GET", "/project/plc/m/val_s32", {{"st", "400"}, {"len", "1"}}, ""});
    REQUIRE(words.status == 200);
    REQUIRE(words.contentType == "application/json; charset=utf-8");
    REQUIRE(words.body == "[1]");
    const HttpResponse refusal = Send(harness, {"POST", "/project/robot/start", {}, "{}"});
    REQUIRE(refusal.status == 403);
    REQUIRE(refusal.body.find(R"("err_code":-1442080)") != std::string::npos);
    REQUIRE(Send(harness, {"PUT", "/project/control/op_cnd", {}, R"({"plc_mode":1})"}).status == 200);
}

TEST_CASE("A body that is no JSON object or array is refused, a method that the Open API has not is not found")
{
    ControllerFixture harness;
    for (const char* body : {"{", "7", "\"x\"", "null", "{} {}", R"({"val":1,"val":2})", "\xFF"})
    {
        INFO(body);
        const HttpResponse response = Send(harness, {"POST", "/project/robot/tool_no", {}, body});
        REQUIRE(response.status == 400);
        REQUIRE(response.body.find(R"("err_code":-1)") != std::string::npos);
    }
    REQUIRE(Send(harness, {"HEAD", "/project/robot", {}, ""}).status == 200);
    REQUIRE(Send(harness, {"HEAD", "/project/nothing", {}, ""}).status == 404);
    REQUIRE(Send(harness, {"PATCH", "/project/robot", {}, "{}"}).status == 404);
    REQUIRE(Send(harness, {"DELETE", "/project/robot", {}, ""}).status == 404);
    REQUIRE(harness.Contains("/project/robot", R"("tool_no":0)"));
}

TEST_CASE("A path is decoded once: what came as %255B is no bracket, and a NUL or another byte is no end of it")
{
    ControllerFixture harness;
    const std::string body = R"({"pno":11,"ext_sel":1})";
    REQUIRE(Send(harness, {"POST", "/project/context/tasks%5B0%5D/cur_prog_cnt", {}, body}).status == 404);
    REQUIRE(Send(harness, {"POST", "/project/context/tasks[0]/cur_prog_cnt", {}, body}).status == 200);
    for (const std::string& end :
         {std::string(1, '\0'), std::string("\xFF"), std::string("%"), std::string("/"), std::string("/..")})
    {
        const HttpResponse response = Send(harness, {"GET", "/project/robot" + end, {}, ""});
        REQUIRE(response.status == 404);
        REQUIRE(ACS::Core::JsonText::IsUtf8(response.body));
    }
}
