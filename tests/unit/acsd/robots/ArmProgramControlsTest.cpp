#include "robots/ArmProgramControls.hpp"

#include "Catch.hpp"

#include <string>
#include <utility>
#include <variant>

namespace ACS::Acsd::Test
{

namespace
{

using OpenStream::EControlOutcome;

struct ControlsFixture
{
    RobotOutputs outputs;
    ArmControls controls{outputs};
    ArmProgramControls program{controls};

    /// The only CONTROL since the last call: URL and body.
    std::string TakeControl()
    {
        const auto requests = std::exchange(outputs.armRequests, {});
        REQUIRE(requests.size() == 1);
        const auto& request = std::get<OpenStream::ControlRequest>(requests.front());
        return request.url + " " + std::string(request.body->GetText());
    }
};

constexpr const char* RCODE = R"(/project/service/r_code/execute {"code":1})";
constexpr const char* TASK_RESET = "/project/context/tasks[0]/reset {}";

} // namespace

TEST_CASE("The program counter is set before a selection after a program was started, stopped or resumed")
{
    ControlsFixture arm;
    CHECK_FALSE(arm.program.IsRewindDue());
    arm.program.OnSettled(EArmControl::StartProgram, EControlOutcome::NotSent);
    CHECK_FALSE(arm.program.IsRewindDue());
    const EArmControl kind = GENERATE(EArmControl::StartProgram, EArmControl::StopProgram, EArmControl::ResumeProgram);
    arm.program.OnSettled(
        kind,
        GENERATE(EControlOutcome::Accepted, EControlOutcome::Refused, EControlOutcome::Unknown));
    CHECK(arm.program.IsRewindDue());
    arm.program.OnSettled(EArmControl::RewindProgram, EControlOutcome::Refused);
    CHECK(arm.program.IsRewindDue());
    arm.program.OnSettled(EArmControl::RewindProgram, EControlOutcome::Accepted);
    CHECK_FALSE(arm.program.IsRewindDue());
}

TEST_CASE("A controller that refuses r_code is sent the reset of its task, and from then on only that")
{
    ControlsFixture arm;
    arm.program.Reset();
    CHECK(arm.TakeControl() == RCODE);
    CHECK(arm.program.TryOtherReset());
    CHECK(arm.TakeControl() == TASK_RESET);
    SECTION("Accepted")
    {
        arm.program.OnResetVerified();
        arm.program.Reset();
        CHECK(arm.TakeControl() == TASK_RESET);
        CHECK_FALSE(arm.program.TryOtherReset());
        arm.program.OnLost(); // the controller may have another version when it is back
    }
    SECTION("Refused too")
    {
        CHECK_FALSE(arm.program.TryOtherReset());
    }
    CHECK(arm.outputs.armRequests.empty());
    arm.program.Reset();
    CHECK(arm.TakeControl() == RCODE);
}

TEST_CASE("A controller that accepts r_code is sent no other reset")
{
    ControlsFixture arm;
    arm.program.Reset();
    arm.program.OnResetVerified();
    CHECK(arm.TakeControl() == RCODE);
    CHECK_FALSE(arm.program.TryOtherReset());
    CHECK(arm.outputs.armRequests.empty());
}

TEST_CASE("Only the refusal for a bad program counter asks for a rewind")
{
    ArmRefusal refusal;
    CHECK_FALSE(ArmProgramControls::IsRewindWanted(refusal));
    refusal.codeOrNull = -1;
    CHECK_FALSE(ArmProgramControls::IsRewindWanted(refusal));
    refusal.codeOrNull = -1'245'280;
    CHECK(ArmProgramControls::IsRewindWanted(refusal));
}

TEST_CASE("The CONTROLs of a program have the URLs and bodies of the controller's manual")
{
    ControlsFixture arm;
    arm.program.Select(11);
    CHECK(arm.TakeControl() == R"(/project/context/tasks[0]/cur_prog_cnt {"pno":11,"sno":0,"fno":0,"ext_sel":1})");
    arm.program.WriteInput({*ParseArmRelay("ml105"), 7});
    CHECK(arm.TakeControl() == R"(/project/plc/set_relay_value {"name":"ml105","value":7})");
    arm.program.Rewind();
    CHECK(arm.TakeControl() == R"(/project/context/tasks[0]/set_cur_pc_idx {"idx":1})");
}

} // namespace ACS::Acsd::Test
