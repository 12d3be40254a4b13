#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

using ACS::OpenStream::ApiResponse;
using ACS::OpenStream::EApiMethod;
using ACS::Testing::ControllerFixture;

namespace
{

struct Row
{
    EApiMethod method;
    const char* url;
    const char* body;
    int status;
    const char* part; ///< Of the answer's body.
};

constexpr const char* EMPTY_OBJECT = R"({"_type":"JObject"})";

// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Row> ROWS{
    {EApiMethod::Get, "/api/health", "", 200, R"({"_type":"JObject","status":"ok"})"},
    {EApiMethod::Get, "/api_ver", "", 200, "5"},
    {EApiMethod::Get, "/versions/sysver", "", 200, R"("modules":[{"name":"com","ver":"70.04-00","build-date")"},
    {EApiMethod::Get,
     "/project/robot",
     "",
     200,
     R"("status":"ok","motor_on_state":1,"is_playback":0,"is_remote_mode":1)"},
    {EApiMethod::Get,
     "/project/robot/joints/joint_states",
     "",
     200,
     R"("position":[0,90,0,0,0,0],"velocity":[0,0,0,0,0,0],"effort":[0,94,94,)"},
    {EApiMethod::Get, "/project/robot/joint_states", "", 200, R"("position":[0,90,0,0,0,0])"},
    {EApiMethod::Get, "/robot/joint_states", "", 200, R"("position":[0,90,0,0,0,0])"},
    {EApiMethod::Get,
     "/project/robot/joint_states?jno_start=2&jno_n=2",
     "",
     200,
     R"("position":[90,0],"velocity":[0,0],"effort":[94,94]})"},
    {EApiMethod::Get, "/project/robot/joint_states?jno_start=6", "", 200, R"("position":[0],)"},
    {EApiMethod::Get,
     "/project/robot/joint_states?jno_start=0",
     "",
     400,
     R"("err_msg":"jno_start: expected a whole number from 1 to 6)"},
    {EApiMethod::Get, "/project/robot/joint_states?jno_start=6&jno_n=2", "", 400, R"("err_code":-1,"err_msg":"jno_n)"},
    {EApiMethod::Get, "/project/robot/joint_states?jno_n=x", "", 400, "jno_n"},
    {EApiMethod::Get,
     "/project/robot/po_cur",
     "",
     200,
     R"("crd":"base","x":1070,"y":0,"z":1320,"rx":0,"ry":0,"rz":0,"j1":0,"j2":90,"j3":0,"j4":0,"j5":0,"j6":0,)"
     R"("enc_cur":[0,900000,0,0,0,0]})"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=2", "", 200, R"("crd":"joint","j1":0,"j2":90)"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=1&mechinfo=-1", "", 200, R"("mechinfo":65535,"crd":"robot","x":1070)"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=4&ucrd_no=1&task_no=7", "", 200, R"("crd":"user","x":)"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=-1", "", 200, R"("crd":"base","x":)"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=3", "", 200, R"("crd":"encoder","j1":0,"j2":900000,)"},
    {EApiMethod::Get, "/project/robot/po_cur?crd=5", "", 400, "crd"},
    {EApiMethod::Get, "/project/robot/po_cur?task_no=8", "", 400, "task_no"},
    {EApiMethod::Get,
     "/project/rgen",
     "",
     200,
     R"("cur_mode":3,"enable_state":257,"is_playback":0,"is_remote_mode":1)"},
    {EApiMethod::Get, "/project/robot/motor_on_state", "", 200, R"({"_type":"JObject","val":1})"},
    {EApiMethod::Get, "/project/robot/emergency_stop", "", 200, R"({"_type":"JObject","val":0})"},
    {EApiMethod::Post, "/project/robot/emergency_stop", R"({"val":2})", 400, "val"},
    {EApiMethod::Get, "/project/robot/cur_tool_data", "", 200, R"({"_type":"Tool","x":0,"y":0,)"},
    {EApiMethod::Get, "/project/robot/tools", "", 200, R"({"_type":"Tools","t_0":{"_type":"Tool","x":0,)"},
    {EApiMethod::Get,
     "/project/robot/tools/t_1",
     "",
     200,
     R"("mass":4.5,"cx":0,"cy":0,"cz":0,"ixx":0,"iyy":0,"izz":0,"mass_esti":0,"bias_0":0)"},
    {EApiMethod::Get, "/project/robot/tools/t_2", "", 404, "err_msg"},
    {EApiMethod::Get, "/project/robot/tools/t_32", "", 404, "err_msg"},
    {EApiMethod::Get, "/project/robot/tools/t_1x", "", 404, "err_msg"},
    {EApiMethod::Post, "/project/robot/tool_no", R"({"val":32})", 400, "val: expected"},
    {EApiMethod::Post, "/project/robot/tool_no", "{}", 400, "val"},
    {EApiMethod::Post, "/project/robot/tool_no", R"({"val":31})", 200, EMPTY_OBJECT},
    {EApiMethod::Post, "/project/robot/crd_sys", R"({"val":3})", 200, R"({"_type":"JObject","cur_crd":3,"ucrd_no":0})"},
    {EApiMethod::Post, "/project/robot/crd_sys", R"({"val":4})", 400, "val"},
    {EApiMethod::Get,
     "/project/control/op_cnd",
     "",
     200,
     R"({"_type":"CondGrp","playback_mode":1,"step_goback_max_spd":100,)"},
    {EApiMethod::Put, "/project/control/op_cnd", R"({"playback_spd_rate":0})", 400, "playback_spd_rate"},
    {EApiMethod::Put, "/project/control/op_cnd", R"({"intp_base":1.5})", 400, "intp_base"},
    {EApiMethod::Post, "/project/control/op_cnd", R"({"plc_mode":4})", 200, R"({"_text":""})"},
    {EApiMethod::Get,
     "/project/control/ios/dio/di_val?type=dib&blk_no=2&sig_no=3",
     "",
     200,
     R"({"_type":"JObject","val":0})"},
    {EApiMethod::Get, "/project/control/ios/dio/di_val?type=dob", "", 400, "type"},
    {EApiMethod::Get, "/project/control/ios/dio/do_val?type=do&blk_no=10", "", 400, "blk_no"},
    {EApiMethod::Get, "/project/control/ios/dio/do_val?type=dow&sig_no=2048", "", 400, "sig_no"},
    {EApiMethod::Get, "/project/control/ios/dio/do_val?type=do&sig_no=-1", "", 400, "sig_no"},
    {EApiMethod::Get, "/project/control/ios/dio/do_val?type=dof", "", 200, R"("val":0)"},
    {EApiMethod::Post, "/project/control/ios/dio/do_val", R"({"type":"dob","blk_no":2,"sig_no":3})", 400, "val"},
    {EApiMethod::Post,
     "/project/control/ios/dio/do_val",
     R"({"type":"dob","sig_no":3,"val":256})",
     400,
     "value: expected a number from -128 to 255"},
    {EApiMethod::Post,
     "/project/control/ios/dio/di_val",
     R"({"type":"dib","sig_no":3,"val":1})",
     404,
     "only another method"},
    {EApiMethod::Get, "/project/control/ios/sio/si_val?type=sib&sig_no=1", "", 200, R"("val":0)"},
    {EApiMethod::Get, "/project/control/ios/sio/so_val?type=so&sig_no=1", "", 200, R"("val":0)"},
    {EApiMethod::Get, "/project/control/ios/sio/so_val?type=si", "", 400, "type"},
    {EApiMethod::Get, "/project/plc/m/val_s32", "", 200, "[0,0,0,0,0,0,0,0]"},
    {EApiMethod::Get, "/project/plc/fb9_di/val_s32?len=1", "", 200, "[0]"},
    {EApiMethod::Get, "/project/plc/fn63_do/val_s32?len=1", "", 200, "[0]"},
    {EApiMethod::Get, "/project/plc/k/val_s32?st=4092", "", 200, "[0]"},
    {EApiMethod::Get, "/project/plc/k/val_s32?st=4093", "", 400, "st"},
    {EApiMethod::Get, "/project/plc/k/val_s32?st=4092&len=2", "", 400, "len"},
    {EApiMethod::Get, "/project/plc/q/val_s32", "", 404, "err_msg"},
    {EApiMethod::Get, "/project/plc/fb10_di/val_s32", "", 404, "err_msg"},
    {EApiMethod::Get, "/project/plc/m/x/val_s32", "", 404, "err_msg"},
    {EApiMethod::Post, "/project/plc/set_relay_value", R"({"name":"fb0.di23","value":"1"})", 200, EMPTY_OBJECT},
    {EApiMethod::Post,
     "/project/plc/set_relay_value",
     R"({"name":"fb0.di23","value":"on"})",
     400,
     "value: expected a number"},
    {EApiMethod::Post, "/project/plc/set_relay_value", R"({"name":"q1","value":1})", 400, "name: expected a relay"},
    {EApiMethod::Post,
     "/project/plc/set_relay_value",
     R"({"name":"m1","value":2})",
     400,
     "value: expected a number from 0 to 1"},
    {EApiMethod::Post, "/project/plc/set_relay_value", "[1]", 400, "object"},
    {EApiMethod::Post, "/project/robot/motor_off", "{}", 403, R"("err_code":-103)"},
    {EApiMethod::Post, "/project/robot/stop", "{}", 200, EMPTY_OBJECT},
    {EApiMethod::Post, "/robot/stop", "{}", 200, EMPTY_OBJECT},
    {EApiMethod::Post, "/robot/start", R"({"speed":10})", 403, R"("err_code":-1442071)"},
    {EApiMethod::Post,
     "/project/context/tasks[0]/cur_prog_cnt",
     R"({"pno":11,"sno":0,"fno":0,"ext_sel":1})",
     200,
     R"({"_type":"JObject","sno_new":0,"fno_new":0,"ln_new":0,"ofs_moved":0})"},
    {EApiMethod::Post, "/project/context/tasks%5B0%5D/cur_prog_cnt", R"({"pno":9999,"ext_sel":1})", 200, "sno_new"},
    {EApiMethod::Post, "/project/context/tasks%5b0%5d/cur_prog_cnt", R"({"pno":1,"ext_sel":1})", 200, "sno_new"},
    {EApiMethod::Post, "/project/context/tasks[0]/cur_prog_cnt", R"({"pno":0,"ext_sel":1})", 400, "pno"},
    {EApiMethod::Post, "/project/context/tasks[0]/cur_prog_cnt", R"({"pno":10000})", 400, "pno"},
    {EApiMethod::Post, "/project/context/tasks[0]/cur_prog_cnt", R"({"pno":"11"})", 400, "pno"},
    {EApiMethod::Post,
     "/project/context/tasks[0]/cur_prog_cnt",
     R"({"sno":1,"ext_sel":1})",
     403,
     R"("err_code":-1245280)"},
    {EApiMethod::Post, "/project/context/tasks[1]/cur_prog_cnt", R"({"pno":11})", 404, "err_msg"},
    {EApiMethod::Post, "/project/context/tasks[0]/set_cur_pc_idx", R"({"idx":0})", 200, EMPTY_OBJECT},
    {EApiMethod::Post, "/project/context/tasks[0]/set_cur_pc_idx", "{}", 400, "idx"},
    {EApiMethod::Post, "/project/context/tasks[8]/set_cur_pc_idx", R"({"idx":0})", 404, "err_msg"},
    {EApiMethod::Post, "/project/context/tasks/reset", "{}", 403, R"("err_code":-103)"},
    {EApiMethod::Post, "/project/context/tasks[7]/reset", "{}", 403, R"("err_code":-103)"},
    {EApiMethod::Post, "/project/service/r_code/execute", R"({"code":1})", 200, R"({"_type":"JObject","code":1})"},
    {EApiMethod::Post, "/project/service/r_code/execute", R"({"code":7})", 400, "code"},
    {EApiMethod::Get, "/project/service/r_code/execute", "", 404, "only another method"},
    {EApiMethod::Get, "/project/robot/", "", 404, R"("err_code":-2)"},
    {EApiMethod::Get, "", "", 404, R"("err_code":-2)"},
    {EApiMethod::Delete, "/project/robot", "{}", 404, "only another method"},
};

} // namespace

TEST_CASE("A Every endpoint answers a fresh controller's client with the documented status and body")
{
    for (const Row& row : ROWS)
    {
        ControllerFixture fixture;
        const ApiResponse response = fixture.Call(row.method, row.url, row.body);
        INFO(row.url << ' ' << row.body);
        REQUIRE(response.body.has_value());
        INFO(response.body->GetText());
        CHECK(response.status == row.status);
        CHECK(response.body->GetText().find(row.part) != std::string::npos);
    }
}

TEST_CASE(
    "D-8 po_cur without crd has the pose of the tool, the axes and their encoder values; with it only one of them")
{
    ControllerFixture fixture;
    const std::string all = fixture.Get("/project/robot/po_cur");
    for (const char* member : {R"("x":1070)", R"("rx":0)", R"("j2":90)", R"("enc_cur":[0,900000,0,0,0,0])"})
    {
        INFO(member);
        CHECK(all.find(member) != std::string::npos);
    }
    for (const char* crd : {"0", "1", "2", "3", "4", "-1"})
    {
        INFO(crd);
        const std::string one = fixture.Get(std::string("/project/robot/po_cur?crd=") + crd);
        CHECK(one.find(R"("enc_cur")") == std::string::npos);
        CHECK((one.find(R"("x")") == std::string::npos) != (one.find(R"("j1")") == std::string::npos));
    }
}

TEST_CASE("A What is set is what is read")
{
    ControllerFixture fixture;
    REQUIRE(
        fixture.Call(EApiMethod::Put, "/project/control/op_cnd", R"({"playback_spd_rate":40,"plc_mode":2})").status
        == 200);
    REQUIRE(fixture.Contains("/project/control/op_cnd", R"("playback_mode":1)"));
    REQUIRE(fixture.Contains("/project/control/op_cnd", R"("playback_spd_rate":40)"));
    REQUIRE(fixture.Contains("/project/control/op_cnd", R"("plc_mode":2)"));
    REQUIRE(fixture.Post("/project/control/op_cnd", R"({"intp_base":1,"robot_lock":1})") == 200);
    REQUIRE(fixture.Contains("/project/rgen", R"("auto_spd":40)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("base_intp":1,"plc_mode":2,"task_no":0,"axis_lock":1)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_mech_axis_info":63)"));

    REQUIRE(fixture.Post("/project/robot/tool_no", R"({"val":1})") == 200);
    REQUIRE(fixture.Contains("/project/robot", R"("tool_no":1)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("tool_no":1)"));
    REQUIRE(fixture.Contains("/project/robot/cur_tool_data", R"("mass":4.5)"));

    REQUIRE(fixture.Post("/project/robot/crd_sys", R"({"val":3})") == 200);
    REQUIRE(fixture.Post("/project/robot/crd_sys", R"({"val":-1})") == 200); // the next one is axis again
    REQUIRE(fixture.Contains("/project/robot/po_cur?crd=-1", R"("crd":"joint")"));
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_crd":0)"));
    REQUIRE(fixture.Post("/project/robot/crd_sys", R"({"val":2})") == 200);
    REQUIRE(fixture.Contains("/project/rgen", R"("cur_crd":2)"));

    REQUIRE(
        fixture.Post("/project/control/ios/dio/do_val", R"({"type":"dob","blk_no":2,"sig_no":3,"val":-99})") == 200);
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=dob&blk_no=2&sig_no=3", R"("val":-99})"));
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=do&blk_no=2&sig_no=24", R"("val":1})"));
    REQUIRE(fixture.Get("/project/plc/fb2_do/val_s32?st=3&len=1") == "[157]");
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=dob&blk_no=1&sig_no=3", R"("val":0})"));

    REQUIRE(fixture.Post("/project/control/ios/dio/do_val", R"({"type":"dof","sig_no":5,"val":1.5})") == 200);
    REQUIRE(fixture.Contains("/project/control/ios/dio/do_val?type=dof&sig_no=5", R"("val":1.5})"));

    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"ml100","value":-2})") == 200);
    REQUIRE(fixture.GetCounters() == "[-2,0,0,0]");
}

TEST_CASE("7.41 7.42 joint_states and po_cur change while a program runs, and stay the same when it is stopped")
{
    using namespace std::chrono_literals;
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    const std::string home = fixture.Get("/project/robot/joint_states");
    const std::string homePose = fixture.Get("/project/robot/po_cur");
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Get("/project/robot/joint_states") == home);
    fixture.clock.Advance(300ms);
    const std::string moved = fixture.Get("/project/robot/joint_states");
    REQUIRE(moved != home);
    REQUIRE(fixture.Get("/project/robot/po_cur") != homePose);
    REQUIRE(fixture.Post("/project/robot/stop") == 200);
    const std::string halted = fixture.Get("/project/robot/joint_states");
    REQUIRE(halted.find(R"("velocity":[0,0,0,0,0,0])") != std::string::npos);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Get("/project/robot/joint_states") == halted);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.Get("/project/robot/joint_states") == moved);
    fixture.clock.Advance(1'700ms);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
    REQUIRE(fixture.Contains("/project/robot/joint_states", R"("velocity":[0,0,0,0,0,0])"));
}
