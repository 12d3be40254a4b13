#include "robots/ArmProgram.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using OpenStream::EControlOutcome;

/// The state machine alone: what it sends, what it needs to see, what it reports.
struct ProgramFixture
{
    RobotOutputs outputs;
    ArmControls controls{outputs};
    ArmProgram program;
    Planning::AdapterActions actions;

    explicit ProgramFixture(const ArmOptions& options = {})
        : program(options, controls)
    {
    }

    /// The CONTROLs since the last call, by the last part of their URL.
    std::vector<std::string> TakeControls()
    {
        std::vector<std::string> names;
        for (const ArmRequest& request : std::exchange(outputs.armRequests, {}))
        {
            const std::string& url = std::get<OpenStream::ControlRequest>(request).url;
            names.push_back(url.substr(url.rfind('/') + 1));
        }
        return names;
    }

    void Settle(EControlOutcome outcome)
    {
        const std::optional<ArmSettlement> settlementOrNull =
            controls.SettleOrNull(OpenStream::ClientControlSettled{0, outcome, 403, std::nullopt, "no"});
        REQUIRE(settlementOrNull.has_value());
        program.OnSettled(*settlementOrNull, actions);
    }

    void Advance()
    {
        program.Advance(controls.IsIdle(), false, actions);
    }

    void Prove(bool bBegun, ArmProof::EOutcome outcome)
    {
        program.OnProof({bBegun, outcome}, "echo", actions);
    }

    /// Selected; the start is sent.
    void SendStart()
    {
        program.Start({"J", 11, {}}, actions);
        Settle(EControlOutcome::Accepted);
        program.OnVerified(true, std::nullopt, actions);
        Advance();
    }

    /// Selected, started and begun.
    void Run()
    {
        SendStart();
        Settle(EControlOutcome::Accepted);
        Prove(true, ArmProof::EOutcome::Open);
        static_cast<void>(TakeControls());
        static_cast<void>(program.TakeRequests());
        actions.clear();
    }

    template <typename TEvent>
    [[nodiscard]] bool HasReported() const
    {
        return std::ranges::any_of(actions, [](const Planning::AdapterAction& action) {
            const auto* const raiseOrNull = std::get_if<Planning::RaiseEvent>(&action);
            return raiseOrNull != nullptr && std::holds_alternative<TEvent>(raiseOrNull->event);
        });
    }
};

} // namespace

TEST_CASE("Each step of a program waits for the one before to be verified")
{
    ProgramFixture arm;
    arm.program.Start({"J", 11, {{*ParseArmRelay("ml105"), 7}}}, arm.actions);
    arm.Advance();
    CHECK(arm.TakeControls() == std::vector<std::string>{"cur_prog_cnt"});
    arm.Settle(EControlOutcome::Accepted);
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::VerifyEffect});
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    CHECK_FALSE(arm.program.IsEffectShown({false, 12, 0}));
    CHECK_FALSE(arm.program.IsEffectShown({false, 11, 5}));
    CHECK(arm.program.IsEffectShown({false, 11, 1}));
    arm.program.OnVerified(true, std::nullopt, arm.actions);
    CHECK(arm.TakeControls() == std::vector<std::string>{"set_relay_value"});
    arm.Advance();
    arm.Settle(EControlOutcome::Accepted);
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::ReadInputs});
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    arm.program.OnInputsRead({{{"/project/plc/m/val_s32", 420, 1}, {8}}}, arm.actions);
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    arm.program.OnInputsRead({{{"/project/plc/m/val_s32", 420, 1}, {7}}}, arm.actions);
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::VerifyCounters});
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    arm.program.OnVerified(true, std::nullopt, arm.actions);
    arm.program.Advance(false, false, arm.actions);
    CHECK(arm.TakeControls().empty());
    arm.Advance();
    CHECK(arm.TakeControls() == std::vector<std::string>{"start"});
    CHECK(arm.program.IsCounted());
    CHECK_FALSE(arm.HasReported<Planning::JobStarted>());
}

TEST_CASE("A program is not started where the counters have changed since its inputs were read")
{
    ProgramFixture arm;
    arm.program.Start({"J", 11, {{*ParseArmRelay("ml105"), 7}}}, arm.actions);
    arm.Settle(EControlOutcome::Accepted);
    arm.program.OnVerified(true, std::nullopt, arm.actions);
    arm.Settle(EControlOutcome::Accepted);
    arm.program.OnInputsRead({{{"/project/plc/m/val_s32", 420, 1}, {7}}}, arm.actions);
    CHECK(arm.program.IsPreparing());
    static_cast<void>(arm.TakeControls());
    arm.program.OnVerified(false, std::nullopt, arm.actions);
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    CHECK(arm.HasReported<Planning::JobUnknown>());
    CHECK_FALSE(arm.program.HasJob());
}

TEST_CASE("A program ends as the counters prove, and only once")
{
    ProgramFixture arm;
    arm.Run();
    SECTION("Finished")
    {
        arm.Prove(true, ArmProof::EOutcome::Finished);
        CHECK(arm.HasReported<Planning::JobFinished>());
    }
    SECTION("Failed")
    {
        arm.Prove(true, ArmProof::EOutcome::Failed);
        CHECK(arm.HasReported<Planning::JobFailed>());
    }
    SECTION("Another program ran")
    {
        arm.Prove(false, ArmProof::EOutcome::OtherProgram);
        CHECK(arm.HasReported<Planning::JobUnresolved>());
    }
    SECTION("The controller was restarted")
    {
        arm.program.OnRestarted(arm.actions);
        CHECK(arm.HasReported<Planning::JobUnresolved>());
    }
    CHECK_FALSE(arm.program.HasJob());
    CHECK_FALSE(arm.program.IsCounted());
}

TEST_CASE("A pause stops the program, verifies that it is stopped, and resumes it")
{
    ProgramFixture arm;
    arm.Run();
    arm.program.SetPauseWanted(true);
    arm.Advance();
    CHECK(arm.TakeControls() == std::vector<std::string>{"stop"});
    CHECK_FALSE(arm.program.IsArmStopped());
    arm.Settle(EControlOutcome::Accepted);
    CHECK_FALSE(arm.program.IsEffectShown({true, 11, 3}));
    CHECK(arm.program.IsEffectShown({false, 11, 3}));
    arm.program.OnVerified(false, std::nullopt, arm.actions);
    CHECK(arm.program.IsArmStopped());
    static_cast<void>(arm.program.TakeRequests());
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    arm.program.SetPauseWanted(false);
    CHECK(arm.program.IsResumeDue());
    arm.Advance();
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::ProbePlayback});
    arm.program.OnPlaybackProbed({EArmProbe::Playback, false, 11}, false);
    arm.Advance();
    CHECK(arm.TakeControls().empty());
    arm.program.OnCounted(false, arm.actions);
    arm.Advance();
    CHECK(arm.TakeControls() == std::vector<std::string>{"start"});
    arm.Settle(EControlOutcome::Accepted);
    CHECK_FALSE(arm.program.IsEffectShown({false, 11, 3}));
    arm.program.OnVerified(false, std::nullopt, arm.actions);
    CHECK(arm.program.IsStarted());
}

TEST_CASE("A CONTROL that settles after the end of its job changes nothing")
{
    ProgramFixture arm;
    arm.Run();
    arm.program.SetPauseWanted(true);
    arm.Advance();
    arm.Prove(true, ArmProof::EOutcome::Finished);
    arm.program.SetPauseWanted(false);
    arm.program.Start({"K", 12, {}}, arm.actions);
    arm.Settle(EControlOutcome::Refused); // the stop
    CHECK(arm.program.TakeRequests().empty());
    CHECK_FALSE(arm.HasReported<Planning::JobFailed>());
    arm.Settle(EControlOutcome::Accepted); // the program counter
    arm.Settle(EControlOutcome::Accepted); // the selection
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::VerifyEffect});
}

TEST_CASE("A job that is cancelled while its program is being selected fails when it is selected, and is not started")
{
    ProgramFixture arm;
    arm.program.Start({"J", 11, {}}, arm.actions);
    CHECK(arm.program.TryCancel("J", arm.actions));
    CHECK(arm.actions.empty());
    arm.Settle(EControlOutcome::Accepted);
    CHECK(arm.HasReported<Planning::JobFailed>());
    arm.Advance();
    CHECK(arm.TakeControls() == std::vector<std::string>{"cur_prog_cnt"});
}

TEST_CASE("A start that is refused after its program has begun does not end the job")
{
    ProgramFixture arm;
    arm.SendStart();
    arm.Prove(true, ArmProof::EOutcome::Open);
    static_cast<void>(arm.program.TakeRequests());
    arm.Settle(EControlOutcome::Refused);
    CHECK(arm.program.TakeRequests() == std::vector<EArmRequest>{EArmRequest::VerifyCounters});
    CHECK(arm.program.IsCounted());
    arm.program.OnMotorProbed(arm.actions);
    CHECK_FALSE(arm.HasReported<Planning::JobFailed>());
    arm.Prove(true, ArmProof::EOutcome::Finished);
    CHECK(arm.HasReported<Planning::JobFinished>());
}

TEST_CASE("A program has longer to begin where its counters are shown seldom")
{
    ArmOptions slow;
    slow.period = std::chrono::seconds(30);
    ProgramFixture arm(slow);
    arm.program.Recover({"J", 11, {}}, false, false, arm.actions);
    REQUIRE(arm.actions.size() == 1);
    CHECK(std::get<Planning::StartAdapterTimer>(arm.actions.front()).delay > std::chrono::seconds(60));
}

TEST_CASE("A start whose fate is unknown is awaited, and echoed without counters it is not begun again")
{
    ProgramFixture arm;
    arm.SendStart();
    arm.Settle(EControlOutcome::Unknown);
    arm.program.OnLost(arm.actions);
    CHECK(arm.program.HasJob());
    arm.program.OnCountersBack(arm.actions);
    const bool bEchoed = GENERATE(false, true);
    arm.program.OnStartTimer(bEchoed, false, arm.actions);
    CHECK(arm.HasReported<Planning::JobUnresolved>() == bEchoed);
    CHECK(arm.HasReported<Planning::JobFailed>() != bEchoed);
}

} // namespace ACS::Acsd::Test
