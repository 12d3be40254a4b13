#include "controller/VirtualController.hpp"

#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

using ACS::OpenStreamSim::ControllerOptions;
using ACS::OpenStreamSim::ProgramSpec;
using ACS::Testing::ControllerFixture;
using namespace std::chrono_literals;

namespace
{

constexpr const char* MOTOR_ON = "/project/robot/motor_on";
constexpr const char* MOTOR_STATE = "/project/robot/motor_on_state";
constexpr const char* ROBOT = "/project/robot";
constexpr const char* STOP = "/project/robot/stop";
constexpr const char* SELECT = "/project/context/tasks[0]/cur_prog_cnt";
constexpr const char* SET_CURSOR = "/project/context/tasks[0]/set_cur_pc_idx";
constexpr const char* R_CODE = "/project/service/r_code/execute";

/// The last version before the withdrawals of 60.30.
ControllerOptions MakeOldOptions()
{
    ControllerOptions options;
    options.version = {60, 29, 99};
    return options;
}

bool IsMotor(ControllerFixture& fixture, int state)
{
    return fixture.Contains(MOTOR_STATE, "\"val\":" + std::to_string(state) + "}");
}

} // namespace

TEST_CASE("A 7.44 The motor is off (1) at the start, switches on (2) for a simulated second, then is on (0)")
{
    ControllerFixture fixture(MakeOldOptions());
    REQUIRE(IsMotor(fixture, 1));
    REQUIRE(fixture.Post(MOTOR_ON) == 200);
    REQUIRE(IsMotor(fixture, 2));
    fixture.clock.Advance(999ms);
    REQUIRE(fixture.Post(MOTOR_ON) == 200); // does not start again
    REQUIRE(IsMotor(fixture, 2));
    fixture.clock.Advance(1ms);
    REQUIRE(IsMotor(fixture, 0));
    REQUIRE(fixture.Post(MOTOR_ON) == 200);
    REQUIRE(IsMotor(fixture, 0));
    REQUIRE(fixture.Post("/project/robot/motor_off") == 200);
    REQUIRE(IsMotor(fixture, 1));
}

TEST_CASE("A With --ready the motor is on at once")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(IsMotor(fixture, 0));
}

TEST_CASE("C start requires, checked in this order: remote mode, motor on, no running program, a selected program")
{
    ControllerFixture fixture;
    fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -38500");
    REQUIRE(fixture.PostForCode(MOTOR_ON) == "403 -38500");
    fixture.controller.TurnModeSwitch(true, fixture.clock.GetNow());
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -1442071");
    REQUIRE(fixture.Post(MOTOR_ON) == 200);
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -1442071"); // still busy
    fixture.clock.Advance(1s);
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -3");
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.PostForCode("/project/robot/start") == "200");
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -1442080");
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]"); // no refusal counted
}

TEST_CASE("A program counts its beginning and its successful end in the relays, in this order")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(4711) == 200);
    REQUIRE(fixture.GetCounters() == "[0,0,0,0]");
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":1)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_prog_no":4711)"));
    fixture.clock.Advance(1'999ms);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    fixture.clock.Advance(1ms);
    REQUIRE(fixture.GetCounters() == "[1,1,0,4711]");
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":0)"));
    REQUIRE(fixture.Start() == 200); // the same program, from its beginning again
    fixture.clock.Advance(2s);
    REQUIRE(fixture.GetCounters() == "[2,2,0,4711]");
}

TEST_CASE("A program that is set to fail runs for its duration and counts the failed end")
{
    ControllerOptions options = ControllerFixture::MakeReadyOptions();
    options.programs.emplace(11, ProgramSpec{3s, false});
    options.programs.emplace(12, ProgramSpec{500ms, true});
    ControllerFixture fixture(options);
    REQUIRE(fixture.Select(12) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(499ms);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    fixture.clock.Advance(1ms);
    REQUIRE(fixture.GetCounters() == "[1,0,1,12]");
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(2'999ms);
    REQUIRE(fixture.GetCounters() == "[2,0,1,12]");
    fixture.clock.Advance(1ms);
    REQUIRE(fixture.GetCounters() == "[2,1,1,11]");
}

TEST_CASE("The time scale holds for the motor and for programs")
{
    ControllerOptions options;
    options.timeScale = 10.0;
    ControllerFixture fixture(options);
    REQUIRE(fixture.Post(MOTOR_ON) == 200);
    fixture.clock.Advance(99ms);
    REQUIRE(IsMotor(fixture, 2));
    fixture.clock.Advance(1ms);
    REQUIRE(IsMotor(fixture, 0));
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(199ms);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    fixture.clock.Advance(1ms);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("A stopped program continues at the next start for the rest of its duration, counted once")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Post(STOP) == 200); // nothing to stop
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1'500ms);
    REQUIRE(fixture.Post(STOP) == 200);
    REQUIRE(fixture.Contains(ROBOT, R"("is_playback":0)"));
    fixture.clock.Advance(1h);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(499ms);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    fixture.clock.Advance(1ms);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("A program is abandoned, and counted as failed, by a reset and by another selection before its end")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Reset() == 200);
    REQUIRE(fixture.GetCounters() == "[0,0,0,0]"); // it had not begun
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Reset() == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");
    REQUIRE(fixture.Contains(ROBOT, R"("is_playback":0)"));
    fixture.clock.Advance(10s);
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");

    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":12,"ext_sel":1})") == "403 -1442080");
    REQUIRE(fixture.Post(STOP) == 200);
    REQUIRE(fixture.Post(SELECT, R"({"pno":-1,"sno":-1,"fno":-1,"ext_sel":1})") == 200);
    REQUIRE(fixture.GetCounters() == "[2,0,1,11]");
    REQUIRE(fixture.Select(12) == 200);
    REQUIRE(fixture.GetCounters() == "[2,0,2,11]");
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":12)"));
}

TEST_CASE("The emergency stop switches the motor off, halts the program and lasts until it is released")
{
    constexpr const char* BUTTON = "/project/robot/emergency_stop";
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Get(BUTTON) == R"({"_type":"JObject","val":0})");
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Post(BUTTON) == 200);
    REQUIRE(fixture.Get(BUTTON) == R"({"_type":"JObject","val":1})");
    REQUIRE(IsMotor(fixture, 1));
    REQUIRE(fixture.Contains(ROBOT, R"("is_playback":0)"));
    REQUIRE(fixture.PostForCode(MOTOR_ON) == "403 -4");
    REQUIRE(fixture.Post(BUTTON, R"({"val":0})") == 200);
    REQUIRE(IsMotor(fixture, 1));
    REQUIRE(fixture.Post(MOTOR_ON) == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("D-1 Remote mode accepts only selections with ext_sel 1, manual mode those with 0; absent is 0")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":11})") == "403 -102");
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":11,"ext_sel":0})") == "403 -102");
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":-1,"ext_sel":0})") == "403 -102");
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":11,"ext_sel":2})") == "400 -1");
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":0)"));
    REQUIRE(fixture.Post(SELECT, R"({"pno":11,"ext_sel":1})") == 200);
    fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
    REQUIRE(fixture.PostForCode(SELECT, R"({"pno":12,"ext_sel":1})") == "403 -1114208");
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":11)"));
    REQUIRE(fixture.Post(SELECT, R"({"pno":12})") == 200);
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":12)"));
}

TEST_CASE("D-2 After a start or stop a selection is refused until the cursor is set")
{
    const std::string program = R"({"pno":11,"ext_sel":1})";
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(
        fixture.PostForCode("/project/context/tasks[0]/cur_prog_cnt", R"({"sno":1,"ext_sel":1})") == "403 -1245280");
    REQUIRE(fixture.Post(SELECT, program) == 200);
    REQUIRE(fixture.Post(SELECT, program) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.PostForCode(SET_CURSOR, R"({"idx":1})") == "403 -38501");
    fixture.clock.Advance(2s);
    REQUIRE(fixture.PostForCode(SELECT, program) == "403 -1245280");
    REQUIRE(fixture.Post("/project/context/tasks[1]/set_cur_pc_idx", R"({"idx":1})") == 200); // another task's
    REQUIRE(fixture.Reset() == 200);
    REQUIRE(fixture.PostForCode(SELECT, program) == "403 -1245280");
    REQUIRE(fixture.Post(SET_CURSOR, R"({"idx":1})") == 200);
    REQUIRE(fixture.Post(SELECT, program) == 200);
    REQUIRE(fixture.Post(STOP) == 200);
    REQUIRE(fixture.PostForCode(SELECT, program) == "403 -1245280");
    for (const char* body : {R"({"idx":0})", R"({"idx":2})"})
    {
        INFO(body);
        REQUIRE(fixture.Post(SET_CURSOR, body) == 200); // another place in the program
        REQUIRE(fixture.PostForCode(SELECT, program) == "403 -1245280");
    }
    REQUIRE(fixture.Post(SET_CURSOR, R"({"idx":1})") == 200);
    REQUIRE(fixture.Post(SELECT, program) == 200);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("D-3 D-4 Before 60.30 reset and motor_off are served and r_code is not; since then it is the reverse")
{
    ControllerOptions options = ControllerFixture::MakeReadyOptions();
    const bool bOld = GENERATE(true, false);
    options.version =
        bOld ? ACS::OpenStreamSim::ControllerVersion{60, 29, 99} : ACS::OpenStreamSim::ControllerVersion{60, 30, 0};
    ControllerFixture fixture(options);
    REQUIRE(fixture.Contains("/versions/sysver", bOld ? R"("ver":"60.29-99")" : R"("ver":"60.30-00")"));
    REQUIRE(fixture.Select(11) == 200);
    for (const char* path :
         {"/project/context/tasks/reset", "/project/context/tasks[0]/reset", "/project/robot/motor_off"})
    {
        INFO(path);
        REQUIRE(fixture.PostForCode(path) == (bOld ? "200" : "403 -103"));
    }
    REQUIRE(IsMotor(fixture, bOld ? 1 : 0));
    REQUIRE(fixture.PostForCode(R_CODE, R"({"code":1})") == (bOld ? "404 -2" : "200"));
}

TEST_CASE("D-3 Before 60.30 the reset of task 0 abandons the program, that of another task does not")
{
    ControllerOptions options = MakeOldOptions();
    options.bMotorOn = true;
    ControllerFixture fixture(options);
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Post("/project/context/tasks[3]/reset") == 200);
    REQUIRE(fixture.Contains(ROBOT, R"("is_playback":1)"));
    REQUIRE(fixture.Post("/project/context/tasks[0]/reset") == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");
}

TEST_CASE("D-3 r_code 1 resets the tasks and keeps the selection, 0 clears it too; others are refused")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(
        fixture.Call(ACS::OpenStream::EApiMethod::Post, R_CODE, R"({"code":1})").body->GetText()
        == R"({"_type":"JObject","code":1})");
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":11)"));
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Post(R_CODE, R"({"code":0})") == 200);
    REQUIRE(fixture.GetCounters() == "[2,0,2,11]");
    REQUIRE(fixture.Contains(ROBOT, R"("cur_prog_no":0)"));
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -3");
    REQUIRE(fixture.PostForCode(R_CODE, R"({"code":2})") == "400 -1");
    REQUIRE(fixture.PostForCode(R_CODE, "{}") == "400 -1");
}

TEST_CASE("D-5 rgen shows the model that is set and the state of the job")
{
    ControllerOptions options;
    REQUIRE(ControllerFixture(options).Contains("/project/rgen", R"("robot_model":"HA006B-01")"));
    options.robotModel = "HS220-02";
    ControllerFixture fixture(options);
    REQUIRE(fixture.Contains("/project/rgen", R"("robot_model":"HS220-02")"));
    REQUIRE(fixture.Contains("/project/rgen", R"("job_state":0,"job_sub_state":0)"));
}

TEST_CASE("D-9 What clients in the field send is accepted: true as playback mode, bits with any value, upper case")
{
    ControllerFixture fixture;
    const auto answer = fixture.Call(
        ACS::OpenStream::EApiMethod::Put,
        "/project/control/op_cnd",
        R"({"playback_mode":true,"playback_spd_rate":30})");
    REQUIRE(answer.status == 200);
    REQUIRE(answer.body->GetText() == R"({"_text":""})");
    REQUIRE(fixture.Contains("/project/control/op_cnd", R"("playback_mode":1,)"));
    REQUIRE(fixture.Post("/project/control/op_cnd", R"({"playback_mode":false})") == 400);
    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"FB3.DOF12","value":"2.5"})") == 200);
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=dof&blk_no=3&sig_no=12", R"("val":2.5})"));
    REQUIRE(fixture.Post("/project/control/ios/dio/do_val", R"({"type":"do","blk_no":2,"sig_no":3,"val":-99})") == 200);
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=do&blk_no=2&sig_no=3", R"("val":1})"));
    REQUIRE(fixture.Get("/project/plc/fb2_do/val_s32?len=1") == "[8]");
}

TEST_CASE("Motor off and manual mode halt the program")
{
    ControllerOptions options = MakeOldOptions();
    options.bMotorOn = true;
    ControllerFixture fixture(options);
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":0,"is_remote_mode":0)"));
    fixture.controller.TurnModeSwitch(true, fixture.clock.GetNow());
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":1,"is_remote_mode":1)"));
    REQUIRE(fixture.Post("/project/robot/motor_off") == 200);
    fixture.clock.Advance(1h);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
}

TEST_CASE("A program continues when a client sends STOP control: there is no trajectory to release")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    fixture.controller.StopControl(fixture.clock.GetNow());
    fixture.clock.Advance(1s);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("The program's step moves with its time")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_step_no":0)"));
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_step_no":1,)"));
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_step_no":5,)"));
    fixture.clock.Advance(999ms);
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_step_no":9,)"));
}
