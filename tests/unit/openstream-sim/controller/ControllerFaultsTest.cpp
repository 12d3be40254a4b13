#include "controller/FaultFixture.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using OpenStreamSim::EFaultKind;
using Texts = std::vector<std::string>;

constexpr const char* MOTOR = "/project/robot/motor_on_state";
constexpr const char* ON = R"({"_type":"JObject","val":0})";
constexpr const char* OFF = R"({"_type":"JObject","val":1})";

} // namespace

TEST_CASE("9 Without a fault both sides are the controller's own")
{
    FaultFixture harness;
    CHECK(harness.Sample(MOTOR) == ON);
    CHECK(harness.response.delay == 0s);
    CHECK(harness.GetOverHTTP(MOTOR) == ON);
    CHECK(harness.Control("/project/robot/tool_no", R"({"val":1})") == 200);
    CHECK(harness.ContainsInRobot(R"("tool_no":1)"));
    CHECK(harness.GetChanges().empty());
    CHECK_FALSE(harness.wakeAt.has_value());
}

TEST_CASE("9 In a silence the MONITOR gets no line; CONTROL and HTTP are served, and the arm goes on")
{
    FaultFixture harness;
    harness.Begin("silence at=1s for=2s");
    harness.Pass(999ms);
    CHECK(harness.Sample(MOTOR) == ON);
    harness.Pass(1ms);
    CHECK(harness.Sample(MOTOR).empty());
    CHECK(harness.Control("/project/robot/emergency_stop") == 200);
    CHECK(harness.GetOverHTTP(MOTOR) == OFF);
    harness.Pass(1999ms);
    CHECK(harness.Sample(MOTOR).empty());
    harness.Pass(1ms);
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.GetChanges() == Texts{"+silence at=1s for=2s", "-silence at=1s for=2s its time is over"});
    harness.Begin("silence");
    harness.Pass(1h);
    CHECK(harness.Sample(MOTOR).empty());
    CHECK(harness.End(EFaultKind::Silence) == 1);
    CHECK(harness.Sample(MOTOR) == OFF);
}

TEST_CASE("9 A hole is a silence of 100 ms, and comes again where that is asked for")
{
    FaultFixture harness;
    harness.Begin("hole every=1s");
    std::string pattern;
    for (int i = 0; i < 42; ++i)
    {
        pattern += harness.Sample(MOTOR).empty() ? '-' : 'x';
        harness.Pass(50ms);
    }
    const std::string second = "--" + std::string(18, 'x');
    CHECK(pattern == second + second + "--");
}

TEST_CASE("9 A call by call controller sees the same as one whose timers fire, every fault at its own time")
{
    FaultFixture harness;
    harness.Begin("estop at=1s for=1s");
    REQUIRE(harness.StartProgram(11) == 200);
    harness.clock.Advance(10s);                  // no timer fired
    CHECK(harness.GetCounters() == "[1,0,0,0]"); // halted after 1 s of 2
    CHECK(harness.GetOverHTTP(MOTOR) == OFF);
    CHECK(harness.GetChanges() == Texts{"+estop at=1s for=1s", "-estop at=1s for=1s its time is over"});
    CHECK(harness.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
}

TEST_CASE("9 A program that has ended is not met by a fault that begins later")
{
    FaultFixture harness;
    REQUIRE(harness.StartProgram(11) == 200);
    harness.clock.Advance(3s);
    harness.Begin("program-fails");
    CHECK(harness.GetCounters() == "[1,1,0,11]");
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Begin("program-fails at=3s");
    harness.End();
    harness.Begin("program-fails at=3s");
    harness.clock.Advance(10s);
    CHECK(harness.GetCounters() == "[2,2,0,11]");
}

TEST_CASE("9 A slow service answers later on the side that is meant, and does what it is asked for")
{
    FaultFixture harness;
    harness.Begin("slow time=300ms for=1s");
    CHECK(harness.Sample(MOTOR) == ON);
    CHECK(harness.response.delay == 300ms);
    CHECK(harness.Control("/project/robot/emergency_stop") == 200);
    CHECK(harness.response.delay == 300ms);
    CHECK(harness.GetOverHTTP(MOTOR) == OFF);
    CHECK(harness.response.delay == 300ms);
    harness.Begin("slow time=1s side=http");
    CHECK(harness.PostOverHTTP("/nothing") == 404);
    CHECK(harness.response.delay == 1s);
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.response.delay == 300ms);
    harness.Pass(1s);
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.response.delay == 0s);
    CHECK(harness.GetOverHTTP(MOTOR) == OFF);
    CHECK(harness.response.delay == 1s);
}

TEST_CASE("9 A drop closes what is connected, once, and again where that is asked for")
{
    FaultFixture harness;
    harness.Begin("drop at=1s");
    CHECK(harness.drops == 0);
    harness.Pass(1s);
    CHECK(harness.drops == 1);
    CHECK_FALSE(harness.wakeAt.has_value());
    harness.Begin("drop every=500ms");
    harness.Pass(1s);
    CHECK(harness.drops == 4);
}

TEST_CASE("9 A burst of refusals takes the next CONTROLs, of one time or in a time, and executes none of them")
{
    FaultFixture harness;
    const std::string tool = R"({"val":3})";
    harness.Begin("refuse count=2");
    for (int i = 0; i < 2; ++i)
    {
        CHECK(harness.Control("/project/robot/tool_no", tool) == 403);
        CHECK_THAT(harness.response.body->GetText(), Catch::Contains(R"("err_code":-1554)"));
        CHECK(harness.ContainsInRobot(R"("tool_no":0)"));
    }
    CHECK(harness.Sample(MOTOR) == ON);                                           // the MONITOR is none
    CHECK(harness.PostOverHTTP("/project/robot/tool_no", R"({"val":2})") == 200); // nor is HTTP
    CHECK(harness.Control("/project/robot/tool_no", tool) == 200);
    CHECK(harness.GetChanges() == Texts{"+refuse count=2", "-refuse count=2 it is used up"});
    harness.Begin("refuse status=500 code=-9");
    CHECK(harness.Control("/project/robot/stop") == 500);
    CHECK_THAT(harness.response.body->GetText(), Catch::Contains(R"("err_code":-9)"));
    CHECK(harness.Control("/project/robot/stop") == 200);
    harness.Begin("refuse for=1s");
    for (int i = 0; i < 20; ++i)
    {
        CHECK(harness.Control("/project/robot/stop") == 403);
        harness.Pass(50ms);
    }
    CHECK(harness.Control("/project/robot/stop") == 200);
}

TEST_CASE("9 Out of remote mode the program halts and CONTROLs are refused; the stream may fall silent at each turn")
{
    FaultFixture harness;
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Begin("mode for=5s silence=2s");
    CHECK(harness.ContainsInRobot(R"("is_remote_mode":0)"));
    CHECK(harness.ContainsInRobot(R"("is_playback":0)"));
    CHECK(harness.Control("/project/robot/start") == 403);
    CHECK_THAT(harness.response.body->GetText(), Catch::Contains("-38500"));
    std::string pattern;
    for (int i = 0; i < 16; ++i)
    {
        pattern += harness.Sample(MOTOR).empty() ? '-' : 'x';
        harness.Pass(500ms);
    }
    CHECK(pattern == "----xxxxxx----xx");
    CHECK(harness.ContainsInRobot(R"("is_remote_mode":1)"));
    harness.Begin("mode");
    CHECK(harness.Sample(MOTOR) == ON);
    harness.Begin("mode for=1s silence=2s"); // the switch is there already: it is not turned
    CHECK(harness.Sample(MOTOR) == ON);
    harness.Pass(2s);
    CHECK(harness.Sample(MOTOR) == ON);
    CHECK(harness.ContainsInRobot(R"("is_remote_mode":0)")); // the other one lasts
    CHECK(harness.End(EFaultKind::Mode) == 1);
    CHECK(harness.ContainsInRobot(R"("is_remote_mode":1)"));
}

TEST_CASE("9 Who ends the turned mode switch by hand has the stream back at once")
{
    const std::optional<EFaultKind> kindOrNull = GENERATE(std::optional<EFaultKind>(EFaultKind::Mode), std::nullopt);
    FaultFixture harness;
    harness.Begin("mode silence=1h");
    CHECK(harness.Sample(MOTOR).empty());
    CHECK(harness.End(kindOrNull) == 1);
    CHECK_FALSE(harness.Sample(MOTOR).empty());
}

TEST_CASE("9 The emergency stop takes the motor until it is released; then motor and program go on by command")
{
    FaultFixture harness;
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Pass(1s);
    harness.Begin("estop for=5s");
    CHECK(harness.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":1})");
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.Control("/project/robot/motor_on") == 403);
    harness.Pass(5s);
    CHECK(harness.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.Control("/project/robot/motor_on") == 200);
    harness.Pass(1s);
    CHECK(harness.Control("/project/robot/start") == 200);
    harness.Pass(1s);
    CHECK(harness.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("9 A protective stop does likewise, without the emergency stop")
{
    FaultFixture harness;
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Pass(1s);
    harness.Begin("protective-stop for=5s");
    CHECK(harness.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.Control("/project/robot/motor_on") == 403);
    CHECK_THAT(harness.response.body->GetText(), Catch::Contains(R"("err_code":-5,"err_msg":"a safeguard is open)"));
    CHECK(harness.ContainsInRobot(R"("is_playback":0)"));
    harness.Pass(5s);
    CHECK(harness.Control("/project/robot/motor_on") == 200);
    harness.Pass(1s);
    CHECK(harness.Control("/project/robot/start") == 200);
    harness.Pass(1s);
    CHECK(harness.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("9 The motor that the operator switches off can be switched on again at once")
{
    FaultFixture harness;
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Begin("motor-off at=1s");
    harness.Pass(1s);
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.ContainsInRobot(R"("is_playback":0)"));
    CHECK(harness.Control("/project/robot/motor_on") == 200);
}

TEST_CASE("9 The next program fails at its end, or where it begins, and the one behind it does not")
{
    FaultFixture harness;
    harness.Begin("program-fails");
    REQUIRE(harness.StartProgram(11) == 200);
    CHECK(harness.GetCounters() == "[1,0,0,0]");
    harness.Pass(2s);
    CHECK(harness.GetCounters() == "[1,0,1,11]");
    REQUIRE(harness.StartProgram(12) == 200);
    harness.Pass(2s);
    CHECK(harness.GetCounters() == "[2,1,1,12]");
    harness.Begin("program-fails when=start");
    REQUIRE(harness.StartProgram(13) == 200);
    CHECK(harness.GetCounters() == "[3,1,2,13]");
    CHECK(harness.ContainsInRobot(R"("is_playback":0)"));
    CHECK(harness.GetChanges().size() == 4);
    // One that goes on after a stop does not begin.
    REQUIRE(harness.StartProgram(14) == 200);
    harness.Pass(1s);
    REQUIRE(harness.PostOverHTTP("/project/robot/stop") == 200);
    harness.Begin("program-fails when=start");
    REQUIRE(harness.PostOverHTTP("/project/robot/start") == 200);
    harness.Pass(1s);
    CHECK(harness.GetCounters() == "[4,2,2,14]");
}

TEST_CASE("9 The next relay that is written gets another value, and those after it their own")
{
    FaultFixture harness;
    const auto write = [&harness](const std::string& name, int value) {
        const std::string body = R"({"name":")" + name + R"(","value":)" + std::to_string(value) + "}";
        REQUIRE(harness.Control("/project/plc/set_relay_value", body) == 200);
    };
    harness.Begin("wrong-value count=3");
    CHECK(harness.Control("/project/plc/set_relay_value", R"({"name":"m1","value":7})") == 400); // not used up by that
    write("ml105", 4711);
    write("ml106", 0);
    write("m3424", 1); // the first bit of ml107
    write("ml108", 5);
    CHECK(harness.GetOverHTTP("/project/plc/m/val_s32?st=420&len=4") == "[4710,1,0,5]");
    CHECK(harness.GetChanges() == Texts{"+wrong-value count=3", "-wrong-value count=3 it is used up"});
}

TEST_CASE("9 A fault with a program waits until that one begins")
{
    FaultFixture harness;
    harness.Begin("program-fails program=12");
    harness.Begin("estop program=13 at=500ms for=1s");
    REQUIRE(harness.StartProgram(11) == 200);
    harness.Pass(2s);
    CHECK(harness.GetCounters() == "[1,1,0,11]");
    REQUIRE(harness.StartProgram(12) == 200);
    harness.Pass(2s);
    CHECK(harness.GetCounters() == "[2,1,1,12]");
    REQUIRE(harness.StartProgram(13) == 200);
    harness.Pass(499ms);
    CHECK(harness.Sample(MOTOR) == ON);
    harness.Pass(1ms);
    CHECK(harness.Sample(MOTOR) == OFF);
    harness.Begin("motor-off program=14");
    harness.Pass(1s);
    REQUIRE(harness.PostOverHTTP("/project/robot/motor_on") == 200);
    harness.Pass(1s);
    REQUIRE(harness.StartProgram(14) == 200); // it began, and was stopped at once
    CHECK(harness.Sample(MOTOR) == OFF);
    CHECK(harness.ContainsInRobot(R"("is_playback":0)"));
}

TEST_CASE("9 One fault too many is refused; ending all takes those to come, too")
{
    FaultFixture harness;
    const auto fault = Apps::ParseFault(OpenStreamSim::GetFaultGrammar(), "silence at=1h");
    for (std::size_t i = 0; i < OpenStreamSim::FaultBoard::MAX_FAULTS; ++i)
    {
        REQUIRE(harness.TryBegin(*fault));
    }
    CHECK_FALSE(harness.TryBegin(*fault));
    CHECK(harness.wakeAt.has_value());
    CHECK(harness.End() == OpenStreamSim::FaultBoard::MAX_FAULTS);
    CHECK_FALSE(harness.wakeAt.has_value());
    CHECK(harness.GetChanges().empty());
}

} // namespace ACS::Testing
