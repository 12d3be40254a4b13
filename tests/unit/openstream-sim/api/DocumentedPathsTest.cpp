#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <string>

using ACS::OpenStream::EApiMethod;
using ACS::Testing::ControllerFixture;

TEST_CASE("7.40 The document's own CONTROL works: a path without /project, with an unknown member")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Post("/robot/start", R"({"speed":50})") == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    REQUIRE(fixture.Post("/project/robot/start") == 403); // it runs: both are one
    REQUIRE(fixture.Post("/robot/stop") == 200);
    for (const std::string path : {"/po_cur", "/joints/joint_states", "/motor_on_state", "/tools"})
    {
        CAPTURE(path);
        REQUIRE(fixture.Call(EApiMethod::Get, "/robot" + path).status == 200);
        REQUIRE(fixture.Get("/robot" + path) == fixture.Get("/project/robot" + path));
    }
}

TEST_CASE("7.40 The paths of the document's samples and of the vendor's client that no manual has are served")
{
    ControllerFixture fixture;
    for (const char* path : {"/project/robot", "/api/health"})
    {
        CAPTURE(path);
        REQUIRE(fixture.Call(EApiMethod::Get, path).status == 200);
        REQUIRE(fixture.Get(path).front() == '{');
        REQUIRE(fixture.Post(path) == 404);
    }
}

TEST_CASE("7.40 The alias is that of the robot alone, and of whole names")
{
    ControllerFixture fixture;
    for (const char* path : {"/robot", "/robots/po_cur", "/robot/", "/rgen", "/control/op_cnd", "/robot/robot/po_cur"})
    {
        CAPTURE(path);
        REQUIRE(fixture.Call(EApiMethod::Get, path).status == 404);
    }
}
