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
    FaultFixture fixture;
    CHECK(fixture.Sample(MOTOR) == ON);
    CHECK(fixture.response.delay == 0s);
    CHECK(fixture.GetOverHTTP(MOTOR) == ON);
    CHECK(fixture.Control("/project/robot/tool_no", R"({"val":1})") == 200);
    CHECK(fixture.ContainsInRobot(R"("tool_no":1)"));
    CHECK(fixture.GetChanges().empty());
    CHECK_FALSE(fixture.wakeAt.has_value());
}

TEST_CASE("9 In a silence the MONITOR gets no line; CONTROL and HTTP are served, and the arm continues")
{
    FaultFixture fixture;
    fixture.Begin("silence at=1s for=2s");
    fixture.Pass(999ms);
    CHECK(fixture.Sample(MOTOR) == ON);
    fixture.Pass(1ms);
    CHECK(fixture.Sample(MOTOR).empty());
    CHECK(fixture.Control("/project/robot/emergency_stop") == 200);
    CHECK(fixture.GetOverHTTP(MOTOR) == OFF);
    fixture.Pass(1999ms);
    CHECK(fixture.Sample(MOTOR).empty());
    fixture.Pass(1ms);
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.GetChanges() == Texts{"+silence at=1s for=2s", "-silence at=1s for=2s its time is over"});
    fixture.Begin("silence");
    fixture.Pass(1h);
    CHECK(fixture.Sample(MOTOR).empty());
    CHECK(fixture.End(EFaultKind::Silence) == 1);
    CHECK(fixture.Sample(MOTOR) == OFF);
}

TEST_CASE("9 A hole is a silence of 100 ms, and is repeated if requested")
{
    FaultFixture fixture;
    fixture.Begin("hole every=1s");
    std::string pattern;
    for (int i = 0; i < 42; ++i)
    {
        pattern += fixture.Sample(MOTOR).empty() ? '-' : 'x';
        fixture.Pass(50ms);
    }
    const std::string second = "--" + std::string(18, 'x');
    CHECK(pattern == second + second + "--");
}

TEST_CASE("9 A call by call controller sees the same as one whose timers fire, every fault at its own time")
{
    FaultFixture fixture;
    fixture.Begin("estop at=1s for=1s");
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.clock.Advance(10s);                  // no timer fired
    CHECK(fixture.GetCounters() == "[1,0,0,0]"); // halted after 1 s of 2
    CHECK(fixture.GetOverHTTP(MOTOR) == OFF);
    CHECK(fixture.GetChanges() == Texts{"+estop at=1s for=1s", "-estop at=1s for=1s its time is over"});
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
}

TEST_CASE("9 A fault does not affect a program that ended before it begins")
{
    FaultFixture fixture;
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.clock.Advance(3s);
    fixture.Begin("program-fails");
    CHECK(fixture.GetCounters() == "[1,1,0,11]");
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Begin("program-fails at=3s");
    fixture.End();
    fixture.Begin("program-fails at=3s");
    fixture.clock.Advance(10s);
    CHECK(fixture.GetCounters() == "[2,2,0,11]");
}

TEST_CASE("9 A slow service answers later on the given side, and executes the call")
{
    FaultFixture fixture;
    fixture.Begin("slow time=300ms for=1s");
    CHECK(fixture.Sample(MOTOR) == ON);
    CHECK(fixture.response.delay == 300ms);
    CHECK(fixture.Control("/project/robot/emergency_stop") == 200);
    CHECK(fixture.response.delay == 300ms);
    CHECK(fixture.GetOverHTTP(MOTOR) == OFF);
    CHECK(fixture.response.delay == 300ms);
    fixture.Begin("slow time=1s side=http");
    CHECK(fixture.PostOverHTTP("/nothing") == 404);
    CHECK(fixture.response.delay == 1s);
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.response.delay == 300ms);
    fixture.Pass(1s);
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.response.delay == 0s);
    CHECK(fixture.GetOverHTTP(MOTOR) == OFF);
    CHECK(fixture.response.delay == 1s);
}

TEST_CASE("9 A drop closes the connections once, and is repeated if requested")
{
    FaultFixture fixture;
    fixture.Begin("drop at=1s");
    CHECK(fixture.drops == 0);
    fixture.Pass(1s);
    CHECK(fixture.drops == 1);
    CHECK_FALSE(fixture.wakeAt.has_value());
    fixture.Begin("drop every=500ms");
    fixture.Pass(1s);
    CHECK(fixture.drops == 4);
}

TEST_CASE("9 A burst of refusals refuses the next CONTROLs, a number of them or for a time, and executes none")
{
    FaultFixture fixture;
    const std::string tool = R"({"val":3})";
    fixture.Begin("refuse count=2");
    for (int i = 0; i < 2; ++i)
    {
        CHECK(fixture.Control("/project/robot/tool_no", tool) == 403);
        CHECK_THAT(fixture.response.body->GetText(), Catch::Contains(R"("err_code":-1554)"));
        CHECK(fixture.ContainsInRobot(R"("tool_no":0)"));
    }
    CHECK(fixture.Sample(MOTOR) == ON);                                           // the MONITOR is none
    CHECK(fixture.PostOverHTTP("/project/robot/tool_no", R"({"val":2})") == 200); // nor is HTTP
    CHECK(fixture.Control("/project/robot/tool_no", tool) == 200);
    CHECK(fixture.GetChanges() == Texts{"+refuse count=2", "-refuse count=2 it is used up"});
    fixture.Begin("refuse status=500 code=-9");
    CHECK(fixture.Control("/project/robot/stop") == 500);
    CHECK_THAT(fixture.response.body->GetText(), Catch::Contains(R"("err_code":-9)"));
    CHECK(fixture.Control("/project/robot/stop") == 200);
    fixture.Begin("refuse for=1s");
    for (int i = 0; i < 20; ++i)
    {
        CHECK(fixture.Control("/project/robot/stop") == 403);
        fixture.Pass(50ms);
    }
    CHECK(fixture.Control("/project/robot/stop") == 200);
}

TEST_CASE("9 Outside of remote mode the program halts and CONTROLs are refused; the stream may be silent at each turn")
{
    FaultFixture fixture;
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Begin("mode for=5s silence=2s");
    CHECK(fixture.ContainsInRobot(R"("is_remote_mode":0)"));
    CHECK(fixture.ContainsInRobot(R"("is_playback":0)"));
    CHECK(fixture.Control("/project/robot/start") == 403);
    CHECK_THAT(fixture.response.body->GetText(), Catch::Contains("-38500"));
    std::string pattern;
    for (int i = 0; i < 16; ++i)
    {
        pattern += fixture.Sample(MOTOR).empty() ? '-' : 'x';
        fixture.Pass(500ms);
    }
    CHECK(pattern == "----xxxxxx----xx");
    CHECK(fixture.ContainsInRobot(R"("is_remote_mode":1)"));
    fixture.Begin("mode");
    CHECK(fixture.Sample(MOTOR) == ON);
    fixture.Begin("mode for=1s silence=2s"); // the switch is there already: it is not turned
    CHECK(fixture.Sample(MOTOR) == ON);
    fixture.Pass(2s);
    CHECK(fixture.Sample(MOTOR) == ON);
    CHECK(fixture.ContainsInRobot(R"("is_remote_mode":0)")); // the other one lasts
    CHECK(fixture.End(EFaultKind::Mode) == 1);
    CHECK(fixture.ContainsInRobot(R"("is_remote_mode":1)"));
}

TEST_CASE("9 Ending the fault of the mode switch ends the silence of the stream at once")
{
    const std::optional<EFaultKind> kindOrNull = GENERATE(std::optional<EFaultKind>(EFaultKind::Mode), std::nullopt);
    FaultFixture fixture;
    fixture.Begin("mode silence=1h");
    CHECK(fixture.Sample(MOTOR).empty());
    CHECK(fixture.End(kindOrNull) == 1);
    CHECK_FALSE(fixture.Sample(MOTOR).empty());
}

TEST_CASE("9 The emergency stop keeps the motor off until it is released; then commands start motor and program")
{
    FaultFixture fixture;
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Pass(1s);
    fixture.Begin("estop for=5s");
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":1})");
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.Control("/project/robot/motor_on") == 403);
    fixture.Pass(5s);
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.Control("/project/robot/motor_on") == 200);
    fixture.Pass(1s);
    CHECK(fixture.Control("/project/robot/start") == 200);
    fixture.Pass(1s);
    CHECK(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("9 A client that releases the emergency stop does not end the fault that presses it")
{
    FaultFixture fixture;
    fixture.Begin("estop for=5s");
    CHECK(fixture.Control("/project/robot/emergency_stop", R"({"val":0})") == 200);
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":1})");
    CHECK(fixture.Control("/project/robot/motor_on") == 403);
    CHECK_THAT(fixture.response.body->GetText(), Catch::Contains(R"("err_code":-4)"));
    fixture.Pass(5s);
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
    CHECK(fixture.Control("/project/robot/motor_on") == 200);
}

TEST_CASE("9 The end of the fault does not release the emergency stop that a client has pressed")
{
    const bool bBefore = GENERATE(true, false);
    FaultFixture fixture;
    if (bBefore)
    {
        CHECK(fixture.Control("/project/robot/emergency_stop") == 200);
    }
    fixture.Begin("estop for=5s");
    if (!bBefore)
    {
        CHECK(fixture.Control("/project/robot/emergency_stop") == 200);
    }
    fixture.Pass(5s);
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":1})");
    CHECK(fixture.Control("/project/robot/motor_on") == 403);
    CHECK(fixture.Control("/project/robot/emergency_stop", R"({"val":0})") == 200);
    CHECK(fixture.Control("/project/robot/motor_on") == 200);
}

TEST_CASE("9 A protective stop does likewise, without the emergency stop")
{
    FaultFixture fixture;
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Pass(1s);
    fixture.Begin("protective-stop for=5s");
    CHECK(fixture.GetOverHTTP("/project/robot/emergency_stop") == R"({"_type":"JObject","val":0})");
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.Control("/project/robot/motor_on") == 403);
    CHECK_THAT(fixture.response.body->GetText(), Catch::Contains(R"("err_code":-5,"err_msg":"a safeguard is open)"));
    CHECK(fixture.ContainsInRobot(R"("is_playback":0)"));
    fixture.Pass(5s);
    CHECK(fixture.Control("/project/robot/motor_on") == 200);
    fixture.Pass(1s);
    CHECK(fixture.Control("/project/robot/start") == 200);
    fixture.Pass(1s);
    CHECK(fixture.GetCounters() == "[1,1,0,11]");
}

TEST_CASE("9 The motor that the operator switches off can be switched on again at once")
{
    FaultFixture fixture;
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Begin("motor-off at=1s");
    fixture.Pass(1s);
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.ContainsInRobot(R"("is_playback":0)"));
    CHECK(fixture.Control("/project/robot/motor_on") == 200);
}

TEST_CASE("9 The next program fails at its end, or when it begins, and the one after it does not")
{
    FaultFixture fixture;
    fixture.Begin("program-fails");
    REQUIRE(fixture.StartProgram(11) == 200);
    CHECK(fixture.GetCounters() == "[1,0,0,0]");
    fixture.Pass(2s);
    CHECK(fixture.GetCounters() == "[1,0,1,11]");
    REQUIRE(fixture.StartProgram(12) == 200);
    fixture.Pass(2s);
    CHECK(fixture.GetCounters() == "[2,1,1,12]");
    fixture.Begin("program-fails when=start");
    REQUIRE(fixture.StartProgram(13) == 200);
    CHECK(fixture.GetCounters() == "[3,1,2,13]");
    CHECK(fixture.ContainsInRobot(R"("is_playback":0)"));
    CHECK(fixture.GetChanges().size() == 4);
    // One that continues after a stop does not begin.
    REQUIRE(fixture.StartProgram(14) == 200);
    fixture.Pass(1s);
    REQUIRE(fixture.PostOverHTTP("/project/robot/stop") == 200);
    fixture.Begin("program-fails when=start");
    REQUIRE(fixture.PostOverHTTP("/project/robot/start") == 200);
    fixture.Pass(1s);
    CHECK(fixture.GetCounters() == "[4,2,2,14]");
}

TEST_CASE("9 The next relay that is written gets another value, and those after it their own")
{
    FaultFixture fixture;
    const auto write = [&fixture](const std::string& name, int value) {
        const std::string body = R"({"name":")" + name + R"(","value":)" + std::to_string(value) + "}";
        REQUIRE(fixture.Control("/project/plc/set_relay_value", body) == 200);
    };
    fixture.Begin("wrong-value count=3");
    CHECK(fixture.Control("/project/plc/set_relay_value", R"({"name":"m1","value":7})") == 400); // not used up by that
    write("ml105", 4711);
    write("ml106", 0);
    write("m3424", 1); // the first bit of ml107
    write("ml108", 5);
    CHECK(fixture.GetOverHTTP("/project/plc/m/val_s32?st=420&len=4") == "[4710,1,0,5]");
    CHECK(fixture.GetChanges() == Texts{"+wrong-value count=3", "-wrong-value count=3 it is used up"});
}

TEST_CASE("9 A fault with a program waits until that one begins")
{
    FaultFixture fixture;
    fixture.Begin("program-fails program=12");
    fixture.Begin("estop program=13 at=500ms for=1s");
    REQUIRE(fixture.StartProgram(11) == 200);
    fixture.Pass(2s);
    CHECK(fixture.GetCounters() == "[1,1,0,11]");
    REQUIRE(fixture.StartProgram(12) == 200);
    fixture.Pass(2s);
    CHECK(fixture.GetCounters() == "[2,1,1,12]");
    REQUIRE(fixture.StartProgram(13) == 200);
    fixture.Pass(499ms);
    CHECK(fixture.Sample(MOTOR) == ON);
    fixture.Pass(1ms);
    CHECK(fixture.Sample(MOTOR) == OFF);
    fixture.Begin("motor-off program=14");
    fixture.Pass(1s);
    REQUIRE(fixture.PostOverHTTP("/project/robot/motor_on") == 200);
    fixture.Pass(1s);
    REQUIRE(fixture.StartProgram(14) == 200); // it began, and was stopped at once
    CHECK(fixture.Sample(MOTOR) == OFF);
    CHECK(fixture.ContainsInRobot(R"("is_playback":0)"));
}

TEST_CASE("9 One fault too many is refused; ending all faults includes those to come")
{
    FaultFixture fixture;
    const auto fault = Apps::ParseFault(OpenStreamSim::GetFaultGrammar(), "silence at=1h");
    for (std::size_t i = 0; i < OpenStreamSim::FaultBoard::MAX_FAULTS; ++i)
    {
        REQUIRE(fixture.TryBegin(*fault));
    }
    CHECK_FALSE(fixture.TryBegin(*fault));
    CHECK(fixture.wakeAt.has_value());
    CHECK(fixture.End() == OpenStreamSim::FaultBoard::MAX_FAULTS);
    CHECK_FALSE(fixture.wakeAt.has_value());
    CHECK(fixture.GetChanges().empty());
}

} // namespace ACS::Testing
