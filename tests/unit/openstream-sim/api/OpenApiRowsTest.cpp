#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

using namespace std::chrono_literals;
using ACS::OpenStream::ApiResponse;
using ACS::OpenStream::EApiMethod;
using ACS::OpenStreamSim::ControllerOptions;
using ACS::Testing::ControllerFixture;
using enum EApiMethod;

namespace
{

/// One call of section A as its row documents it, on a controller with the motor on and a waiting program in playback.
struct Call
{
    EApiMethod method;
    std::string url;
    std::string body;
    std::string part; ///< Of the body of the 200.
};

constexpr const char* EMPTY = R"({"_type":"JObject"})";

/// A call for each row of section A, in its order: each path, alias, parameter and member that it names.
// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Call> CALLS{
    {Get, "/project/robot", "", R"("status":"ok")"},
    {Get, "/api/health", "", R"("status":"ok")"},
    {Get, "/project/robot/joints/joint_states", "", R"("effort":[)"},
    {Get, "/project/robot/joint_states?jno_start=3&jno_n=2", "", R"("position":[0,0])"},
    {Get, "/project/robot/po_cur", "", R"("_type":"Pose")"},
    {Get, "/project/robot/po_cur?task_no=7&crd=-1", "", R"("crd":"base")"},
    {Get, "/project/robot/po_cur?crd=0", "", R"("crd":"base")"},
    {Get, "/project/robot/po_cur?crd=1", "", R"("crd":"robot")"},
    {Get, "/project/robot/po_cur?crd=2&mechinfo=-1", "", R"("mechinfo":65535,"crd":"joint")"},
    {Get, "/project/robot/po_cur?crd=3", "", R"("crd":"encoder")"},
    {Get, "/project/robot/po_cur?crd=4&ucrd_no=2", "", R"("crd":"user")"},
    {Get, "/project/rgen", "", R"("cur_mode":3)"},
    {Get, "/project/robot/motor_on_state", "", R"("val":0)"},
    {Get, "/project/robot/emergency_stop", "", R"("val":0)"},
    {Get, "/project/robot/cur_tool_data", "", R"("bias_5":0)"},
    {Get, "/project/robot/tools", "", R"("_type":"Tools","t_0":{)"},
    {Get, "/project/robot/tools/t_0", "", R"("mass":0)"},
    {Get, "/project/control/op_cnd", "", R"("_type":"CondGrp")"},
    {Put, "/project/control/op_cnd", R"({"playback_spd_rate":50})", R"({"_text":""})"},
    {Post, "/project/control/op_cnd", R"({"playback_mode":2})", R"({"_text":""})"},
    {Get, "/project/control/ios/dio/di_val?type=di&blk_no=9&sig_no=0", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/di_val?type=dib", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/di_val?type=diw", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/di_val?type=dil", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/di_val?type=dif", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/do_val?type=do", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/do_val?type=dob", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/do_val?type=dow", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/do_val?type=dol", "", R"("val":0)"},
    {Get, "/project/control/ios/dio/do_val?type=dof", "", R"("val":0)"},
    {Post, "/project/control/ios/dio/do_val", R"({"type":"dob","blk_no":2,"sig_no":3,"val":-99})", EMPTY},
    {Get, "/project/control/ios/sio/si_val?type=si&sig_no=1", "", R"("val":0)"},
    {Get, "/project/control/ios/sio/so_val?type=sow&sig_no=1", "", R"("val":0)"},
    {Get, "/project/plc/di/val_s32?st=4&len=2", "", "[0,0]"},
    {Get, "/project/plc/do/val_s32", "", "[0,0,0,0,0,0,0,0]"},
    {Get, "/project/plc/x/val_s32", "", "[0,"},
    {Get, "/project/plc/y/val_s32", "", "[0,"},
    {Get, "/project/plc/m/val_s32", "", "[0,"},
    {Get, "/project/plc/s/val_s32", "", "[0,"},
    {Get, "/project/plc/r/val_s32", "", "[0,"},
    {Get, "/project/plc/k/val_s32", "", "[0,"},
    {Get, "/project/plc/fb3_di/val_s32", "", "[0,"},
    {Get, "/project/plc/fn12_do/val_s32", "", "[0,"},
    {Post, "/project/plc/set_relay_value", R"({"name":"fb0.di23","value":1})", EMPTY},
    {Post, "/project/plc/set_relay_value", R"({"name":"fb0.di23","value":"1"})", EMPTY},
    {Post, "/project/robot/motor_on", "{}", EMPTY},
    {Post, "/project/robot/stop", "{}", EMPTY},
    {Post, "/robot/stop", "{}", EMPTY},
    {Post, "/project/robot/tool_no", R"({"val":31})", EMPTY},
    {Post, "/project/robot/crd_sys", R"({"val":1})", R"("cur_crd":1,"ucrd_no":0)"},
    {Post, "/project/robot/crd_sys", R"({"val":-1})", R"("cur_crd":2)"},
    {Post, "/project/robot/emergency_stop", "{}", EMPTY},
    {Post, "/project/robot/trajectory/joint_traject_init", "{}", EMPTY},
    {Post, "/project/robot/trajectory/joint_traject_init", R"({"agility_mode":true,"agility_freq":500})", EMPTY},
    {Post,
     "/project/robot/trajectory/joint_traject_insert_point",
     R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0.04,"point":[0,90,0,0,0,0]})",
     EMPTY},
    {Post,
     "/project/robot/trajectory/joint_traject_insert_points",
     R"({"joint_names":["j1","j2","j3","j4","j5","j6"],"points":{"point_1":{"positions":[0,1.570796,0,0,0,0],)"
     R"("time_from_start":0},"point_2":{"positions":[0.1,1.570796,0,0,0,0],"time_from_start":1}}})",
     EMPTY},
    {Get, "/project/robot/trajectory/joint_traject_buf_avail", "", R"("val":2048)"},
    {Get, "/project/robot/trajectory/joint_traject_agility_info", "", R"("agility_mode":false,"agility_freq":20)"},
    {Get, "/project/robot/trajectory/joint_traject_log", "", R"("val":0)"},
    {Post, "/project/robot/trajectory/joint_traject_log", R"({"enable":true})", EMPTY},
    {Post, "/project/service/r_code/execute", R"({"code":1})", R"("code":1)"},
    {Post, "/project/context/tasks[0]/release_wait", "{}", EMPTY},
    {Post, "/console/execute_cmd", R"({"cmd_line":"rl.exit"})", EMPTY},
    {Post, "/console/execute_cmd", R"({"cmd_line":"rl.stop"})", EMPTY},
    {Post, "/console/execute_cmd", R"({"cmd_line":"rl.reinit"})", EMPTY},
    {Get, "/api_ver", "", "5"},
    {Get, "/versions/sysver", "", R"({"name":"com","ver":"70.04-00","build-date":)"},
};

/// The same, of calls that need a base task that does not play.
// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Call> IDLE_CALLS{
    {Post, "/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"sno":-1,"fno":-1,"ext_sel":1})", R"("ofs_moved":0)"},
    {Post,
     "/project/context/tasks%5B0%5D/cur_prog_cnt",
     R"({"pno":-1,"sno":-1,"fno":-1,"ext_sel":1})",
     R"("ln_new":0)"},
    {Post, "/project/context/tasks[0]/set_cur_pc_idx", R"({"idx":1})", EMPTY},
    {Post, "/project/context/tasks[7]/set_cur_pc_idx", R"({"idx":1})", EMPTY},
    {Post,
     "/project/context/tasks[0]/execute_move",
     R"({"stmt":"move SP,spd=1sec,accu=0,tool=1 [0 90 0 0 0 0]"})",
     EMPTY},
    {Post, "/console/execute_cmd", R"({"cmd_line":"rl.i wait di1"})", EMPTY},
    {Post, "/console/execute_cmd", R"({"cmd_line":"rl.x"})", R"({"_type":"JObject","ecode":1})"},
};

/// Of a controller of 70.06.
// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Call> NEW_CALLS{
    {Get, "/project/robot/trajectory/joint_traject_mode", "", R"("mode":false)"},
    {Get, "/project/robot/trajectory/joint_traject_ready", "", R"("ready":true)"},
    {Post, "/project/robot/trajectory/joint_traject_off", "{}", EMPTY},
};

/// Of a controller before 60.30.
// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Call> OLD_CALLS{
    {Post, "/project/robot/motor_off", "{}", EMPTY},
    {Post, "/project/context/tasks/reset", "{}", EMPTY},
    {Post, "/project/context/tasks[3]/reset", "{}", EMPTY},
    {Post, "/project/context/tasks%5B3%5D/reset", "{}", EMPTY},
};

struct Refusal
{
    std::vector<std::pair<std::string, std::string>> before; ///< POSTs, by path and body.
    EApiMethod method;
    std::string url;
    std::string body;
    std::string code;
    bool bRemote = true;
};

constexpr const char* ON = "/project/robot/motor_on";
constexpr const char* SELECT = "/project/context/tasks[0]/cur_prog_cnt";
constexpr const char* START = "/project/robot/start";
constexpr const char* PROGRAM = R"({"pno":11,"ext_sel":1})";
constexpr const char* MOVE = "/project/context/tasks[0]/execute_move";
constexpr const char* GOOD_MOVE = R"({"stmt":"move P,spd=1sec,accu=0,tool=0 [10 90 0 0 0 0]"})";
constexpr const char* CONSOLE = "/console/execute_cmd";

/// A call for each refusal that a row documents and that is not in OpenApiTest's or TrajectoryAPITest's, on a fresh
/// controller; motor_on takes its second.
// NOLINTNEXTLINE(cert-err58-cpp)
const std::vector<Refusal> REFUSALS{
    {{}, Post, ON, "{}", "403 -38500", false},
    {{}, Post, START, "{}", "403 -38500", false},
    {{}, Post, "/robot/start", "{}", "403 -38500", false},
    {{}, Post, START, "{}", "403 -1442071"},
    {{{ON, "{}"}}, Post, START, "{}", "403 -3"},
    {{{ON, "{}"}, {SELECT, PROGRAM}, {START, "{}"}}, Post, START, "{}", "403 -1442080"},
    {{{ON, "{}"}, {SELECT, PROGRAM}, {START, "{}"}}, Post, SELECT, PROGRAM, "403 -1442080"},
    {{{ON, "{}"}, {SELECT, PROGRAM}, {START, "{}"}},
     Post,
     "/project/context/tasks[0]/set_cur_pc_idx",
     R"({"idx":0})",
     "403 -38501"},
    {{}, Post, MOVE, GOOD_MOVE, "403 -38500", false},
    {{}, Post, MOVE, GOOD_MOVE, "403 -1442071"},
    {{{ON, "{}"}, {SELECT, PROGRAM}, {START, "{}"}}, Post, MOVE, GOOD_MOVE, "403 -1442080"},
    {{{ON, "{}"}, {MOVE, GOOD_MOVE}}, Post, MOVE, GOOD_MOVE, "403 -1442080"},
    {{{ON, "{}"}}, Post, MOVE, R"({"stmt":"move"})", "403 -1376272"},
    {{}, Post, "/project/context/tasks[8]/execute_move", GOOD_MOVE, "404 -2"},
    {{}, Post, CONSOLE, R"({"cmd_line":"rl.start"})", "403 -38500", false},
    {{}, Post, CONSOLE, R"({"cmd_line":"rl.start"})", "403 -1442071"},
    {{{ON, "{}"}}, Post, CONSOLE, R"({"cmd_line":"rl.start"})", "403 -3"},
    {{{ON, "{}"}, {SELECT, PROGRAM}, {START, "{}"}}, Post, CONSOLE, R"({"cmd_line":"rl.start"})", "403 -1442080"},
    {{}, Get, "/project/robot/tools/t_9", "", "404 -2"},
    {{}, Get, "/project/plc/z/val_s32", "", "404 -2"},
    {{}, Post, "/project/robot/trajectory/joint_traject_inits", "{}", "404 -2"},
};

constexpr std::array<const char*, 14> BAD_BODIES{
    "[]",
    "[{}]",
    R"({"val":"1"})",
    R"({"val":[]})",
    R"({"val":1.5})",
    R"({"val":1e300})",
    R"({"val":-1e300})",
    R"({"val":"NaN"})",
    R"({"val":{}})",
    R"({"stmt":7,"cmd_line":7,"name":7,"type":7,"idx":"7","pno":"7","playback_mode":"7","interval":"7","enable":7})",
    R"({"stmt":[],"cmd_line":[],"name":[],"type":[],"idx":[],"pno":[],"playback_mode":[],"interval":[],"enable":[]})",
    R"({"stmt":{},"cmd_line":{},"name":{},"type":{},"idx":{},"pno":{},"playback_mode":{},"interval":{},"enable":{}})",
    R"({"name":"m1","value":[],"type":"dob","sig_no":-1,"val":true,"idx":-1,"pno":99999,"playback_mode":3,"sno":1.5})",
    R"({"name":"m1","value":"","type":"dob","sig_no":1e99,"val":1e99,"idx":1e99,"pno":1e99,"playback_mode":1e99})"};

ControllerOptions MakePlayingOptions()
{
    ControllerOptions options;
    options.bWaiting = true;
    return options;
}

ControllerOptions MakeNewOptions()
{
    ControllerOptions options = MakePlayingOptions();
    options.version = ACS::OpenStreamSim::FIRST_WITH_TRAJECTORY_MODE;
    return options;
}

void CheckCalls(const std::vector<Call>& calls, const ControllerOptions& options)
{
    for (const Call& call : calls)
    {
        ControllerFixture fixture(options);
        const ApiResponse response = fixture.Call(call.method, call.url, call.body);
        INFO(call.url << ' ' << call.body);
        REQUIRE(response.body.has_value());
        INFO(response.body->GetText());
        CHECK(response.status == 200);
        CHECK(response.body->GetText().find(call.part) != std::string::npos);
    }
}

} // namespace

TEST_CASE("A Each row of section A is served with the query, the body and the aliases that it names")
{
    CheckCalls(CALLS, MakePlayingOptions());
    CheckCalls(IDLE_CALLS, ControllerFixture::MakeReadyOptions());
    ControllerOptions old = MakePlayingOptions();
    old.version = {60, 29, 0};
    CheckCalls(OLD_CALLS, old);
    CheckCalls(NEW_CALLS, MakeNewOptions());
}

TEST_CASE("A Each refusal that a row of section A names has its status and its code, and a sentence")
{
    for (const Refusal& refusal : REFUSALS)
    {
        ControllerFixture fixture;
        for (const auto& [url, body] : refusal.before)
        {
            REQUIRE(fixture.Post(url, body) == 200);
            fixture.clock.Advance(url == ON ? 1s : 0s);
        }
        fixture.controller.TurnModeSwitch(refusal.bRemote, fixture.clock.GetNow());
        INFO(refusal.url << ' ' << refusal.body);
        const ApiResponse response = fixture.Call(refusal.method, refusal.url, refusal.body);
        REQUIRE(response.body.has_value());
        const std::string text = response.body->GetText();
        INFO(text);
        const std::size_t space = refusal.code.find(' ');
        CHECK(std::to_string(response.status) == refusal.code.substr(0, space));
        CHECK(
            text.starts_with(R"({"_type":"JObject","err_code":)" + refusal.code.substr(space + 1) + R"(,"err_msg":")"));
        CHECK(text.find(R"("err_msg":"")") == std::string::npos);
    }
}

TEST_CASE("A Bodies of any kind are answered by every endpoint, and a refusal has its code and sentence")
{
    std::vector<Call> calls = CALLS;
    calls.insert(calls.end(), IDLE_CALLS.begin(), IDLE_CALLS.end());
    calls.insert(calls.end(), NEW_CALLS.begin(), NEW_CALLS.end());
    calls.push_back({Post, START, "{}", ""});
    ControllerFixture fixture(MakeNewOptions());
    for (const Call& call : calls)
    {
        for (const char* body : BAD_BODIES)
        {
            INFO(call.url << ' ' << body);
            const ApiResponse response = fixture.Call(call.method, call.url, body);
            REQUIRE(response.body.has_value());
            const bool bAnswered = response.status == 200 || response.status == 400 || response.status == 403;
            CHECK(bAnswered);
            const bool bRefused = response.body->GetText().find(R"("err_code":-)") != std::string::npos
                && response.body->GetText().find(R"("err_msg":")") != std::string::npos;
            CHECK(bRefused == (response.status != 200));
        }
    }
}

TEST_CASE("A A query of any kind is a 400 with the parameter's name, or has no effect")
{
    ControllerFixture fixture;
    for (const char* value :
         {"", "x", "-", "1e3", "0x1", "99999999999999999999", "-99999999999999999999", "1.5", "NaN", "[]"})
    {
        for (const char* front :
             {"/project/robot/joint_states?jno_start=",
              "/project/robot/joint_states?jno_n=",
              "/project/robot/po_cur?task_no=",
              "/project/robot/po_cur?crd=",
              "/project/robot/po_cur?ucrd_no=",
              "/project/robot/po_cur?mechinfo=",
              "/project/control/ios/dio/di_val?blk_no=",
              "/project/control/ios/dio/do_val?sig_no=",
              "/project/control/ios/dio/do_val?type=",
              "/project/control/ios/sio/si_val?type=",
              "/project/plc/m/val_s32?st=",
              "/project/plc/m/val_s32?len="})
        {
            const std::string url = std::string(front) + value;
            INFO(url);
            const ApiResponse response = fixture.Call(Get, url);
            CHECK(response.status == 400);
            const std::string name = url.substr(url.find('?') + 1, url.find('=') - url.find('?') - 1);
            CHECK(
                response.body->GetText().find(R"("err_code":-1,"err_msg":")" + name + ": expected")
                != std::string::npos);
        }
    }
}
