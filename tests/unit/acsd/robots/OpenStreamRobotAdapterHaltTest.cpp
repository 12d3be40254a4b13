#include "robots/ArmFixture.hpp"

#include <string>
#include <vector>

// Programs that a person halts, resumes or replaces at the controller, and programs that do not begin.

namespace ACS::Acsd::Test
{

namespace
{

/// A job whose program is stopped for a pause.
void PauseRunning(ArmFixture& arm)
{
    arm.StartRunning();
    arm.ShowBase(true);
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    CHECK(arm.TakeRequests().empty());
}

} // namespace

TEST_CASE("6.8 A program that was resumed at the controller during a pause is neither reset nor started again")
{
    ArmFixture arm;
    PauseRunning(arm);
    const bool bCancelled = GENERATE(false, true);
    const bool bReconnected = GENERATE(false, true);
    if (bReconnected)
    {
        arm.Deliver(OpenStream::ClientLost{});
        arm.ComeBack();
    }
    else
    {
        arm.DeliverData("[6,5,0]");
    }
    if (bCancelled)
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    }
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.DeliverData(RUNNING_STATE);
    arm.ShowVerification("[6,5,0]");
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("6.8 After a reconnect a paused program is checked, and stopped again if it runs")
{
    ArmFixture arm;
    PauseRunning(arm);
    arm.Deliver(OpenStream::ClientLost{});
    arm.ComeBack();
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.AcknowledgeMonitor();
    const bool bRuns = GENERATE(false, true);
    arm.DeliverData(bRuns ? RUNNING_STATE : STOPPED_STATE);
    CHECK(
        arm.TakeRequests()
        == (bRuns ? std::vector<std::string>{MONITOR_COUNTERS, STOP} : std::vector<std::string>{MONITOR_COUNTERS}));
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeRequests().empty());
}

TEST_CASE("A program is not started while the controller shows another one as selected")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowEffect(R"({"is_playback":0,"cur_prog_no":12,"cur_step_no":0})");
    static_cast<void>(arm.TakeRequests());
    arm.Fire(ArmFixture::EFFECT_TIMER);
    arm.ShowVerification();
    CHECK(arm.TakeRequests().empty());
    const auto failed = arm.TakeEvents<Planning::JobFailed>();
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().reason.find("12") != std::string::npos);
}

TEST_CASE("6.8 A paused program is not started in place of another one that was selected meanwhile")
{
    constexpr std::string_view OTHER_STATE = R"({"is_playback":0,"cur_prog_no":12,"cur_step_no":0})";
    ArmFixture arm;
    PauseRunning(arm);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.actions.clear();
    arm.ShowProbe(OTHER_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    SECTION("It is selected again: it is started")
    {
        arm.Fire(ArmFixture::RETRY_TIMER);
        arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("It is not")
    {
        arm.Fire(ArmFixture::RETRY_TIMER);
        arm.ShowProbe(OTHER_STATE, "[6,5,0]");
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("Its job is cancelled")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        arm.ShowProbe(OTHER_STATE, "[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
    }
}

TEST_CASE("6.8 A program that was stopped in a subprogram is started there")
{
    constexpr std::string_view SUBPROGRAM_STATE = R"({"is_playback":0,"cur_prog_no":1101,"cur_step_no":2})";
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowEffect(SUBPROGRAM_STATE);
    arm.AcknowledgeMonitor();
    arm.DeliverData("[6,5,0]");
    static_cast<void>(arm.TakeRequests());
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(SUBPROGRAM_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("A program that does not begin after its start is reported when probes find no program running")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.Command("J");
    arm.Accept();
    arm.Accept("[5,5,0]");
    arm.actions.clear();
    arm.ShowTimedProbe(STOPPED_STATE, "[5,5,0]");
    CHECK(arm.TakeErrors() == "?");
    arm.ShowTimedProbe(STOPPED_STATE, "[5,5,0]");
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    SECTION("It is started at the controller")
    {
        arm.ShowTimedProbe(RUNNING_STATE, "[5,5,0]");
        CHECK(arm.TakeErrors().empty());
        arm.DeliverData("[6,5,0]");
        CHECK(arm.TakeEvents<Planning::JobStarted>().size() == 1);
    }
    SECTION("It begins")
    {
        arm.DeliverData("[6,5,0]");
        CHECK(arm.TakeErrors().empty());
    }
}

TEST_CASE("D-16 A reset that is refused late does not fail the job: the other reset is sent")
{
    ArmFixture arm;
    PauseRunning(arm);
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.ShowEffect(STOPPED_STATE);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.Deliver(OpenStream::ClientControlFault{404, std::nullopt, "late"});
    CHECK(arm.TakeRequests() == std::vector<std::string>{RESET_TASK});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowEffect(STOPPED_STATE);
    arm.Fire(ArmFixture::EFFECT_TIMER);
    static_cast<void>(arm.TakeRequests());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
}

TEST_CASE("D-16 A program that is shown running after its reset has not ended")
{
    ArmFixture arm;
    PauseRunning(arm);
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowEffect(RUNNING_STATE);
    arm.Fire(ArmFixture::EFFECT_TIMER);
    static_cast<void>(arm.TakeRequests());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

} // namespace ACS::Acsd::Test
