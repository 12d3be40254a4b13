#include "robots/ArmFixture.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A paused program is resumed, and the controller accepts that.
void SettleGoingOn(ArmFixture& arm, OpenStream::EControlOutcome outcome = OpenStream::EControlOutcome::Refused)
{
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(outcome, 403);
}

/// Shows the sample of a probe of the program, then the counters.
void ShowProgramProbe(ArmFixture& arm, std::string_view sample, std::string_view counters = "[6,5,0]")
{
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.DeliverData(sample);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.AcknowledgeMonitor();
    arm.DeliverData(counters);
}

} // namespace

TEST_CASE("6.8 A program counts as stopped when the controller shows that it is stopped")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.ShowBase(true);
    arm.actions.clear();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.DeliverData(RUNNING_STATE);
    CHECK(arm.TakeRequests().empty()); // still looked for
    CHECK_FALSE(arm.IsReportedPaused());
    arm.DeliverData(STOPPED_STATE);
    arm.ShowVerification("[6,5,0]");
    CHECK(arm.IsReportedPaused());
}

TEST_CASE("6.8 A program that is shown running after its stop is not paused: it is stopped again, and not reset")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.ShowBase(true);
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.DeliverData(RUNNING_STATE);
    arm.Fire(ArmFixture::EFFECT_TIMER);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK, MONITOR_COUNTERS});
    arm.AcknowledgeMonitor();
    const bool bResumed = GENERATE(false, true);
    if (bResumed)
    {
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    }
    arm.DeliverData("[6,5,0]");
    CHECK_FALSE(arm.IsReportedPaused());
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == (bResumed ? std::vector<std::string>{} : std::vector<std::string>{STOP}));
}

TEST_CASE("6.8 A program that is shown stopped after its resume is not resumed: that is reported, and repeated")
{
    ArmFixture arm;
    SettleGoingOn(arm, OpenStream::EControlOutcome::Accepted);
    arm.DeliverData(STOPPED_STATE);
    arm.Fire(ArmFixture::EFFECT_TIMER);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK, MONITOR_COUNTERS});
    arm.AcknowledgeMonitor();
    arm.actions.clear();
    arm.DeliverData("[6,5,0]");
    ShowProgramProbe(arm, STOPPED_STATE);
    CHECK(arm.IsReportedPaused());
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    arm.Fire(ArmFixture::RETRY_TIMER);
    ShowProgramProbe(arm, STOPPED_STATE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("6.7 Pause stops the arm's program where it is; the robot is paused when base and arm are stopped")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.ShowBase(true);
    CHECK_FALSE(arm.IsReportedPaused());
    arm.Accept("[6,5,0]");
    CHECK(arm.IsReportedPaused());

    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.ShowBase(false);
    CHECK(arm.IsReportedPaused());
    arm.Accept("[6,5,0]");
    CHECK_FALSE(arm.IsReportedPaused());
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("6.7 Pause without a job is the base's alone; a program that was just selected is selected again by Resume")
{
    ArmFixture arm;
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    arm.BringUp();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.ShowBase(true);
    CHECK(arm.IsReportedPaused());
    arm.Command("J");
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Accept();
    CHECK(arm.TakeRequests().empty());
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Accept();
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("6.7 A program that is just being started is stopped once it has begun")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    static_cast<void>(arm.TakeRequests());
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.Accept();
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

TEST_CASE("6.7 A stop that the arm refuses leaves the robot not paused, and is not repeated without end")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.ShowBase(true);
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    CHECK(arm.TakeRequests().empty());
    CHECK_FALSE(arm.IsReportedPaused());
}

TEST_CASE(
    "6.8 A program whose resume got lost is stopped, probed and resumed again; if it runs already, that is not a failure")
{
    ArmFixture arm;
    // While it was under way, or after the silence that was taken for its answer.
    SettleGoingOn(arm, GENERATE(OpenStream::EControlOutcome::Unknown, OpenStream::EControlOutcome::Accepted));
    arm.Deliver(OpenStream::ClientLost{});
    arm.ComeBack();
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    SECTION("It has come to its end meanwhile: nothing is started")
    {
        arm.Accept("[6,6,0]");
        CHECK(arm.TakeRequests().empty());
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("It is stopped")
    {
        arm.Accept("[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
        arm.Accept("[6,5,0]");
        CHECK(arm.TakeRequests().empty());
        arm.DeliverData("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
}

TEST_CASE("6.8 A program counts as resumed when the controller shows that it runs")
{
    ArmFixture arm;
    SettleGoingOn(arm, OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.DeliverData(STOPPED_STATE);
    CHECK(arm.TakeRequests().empty()); // still looked for
    arm.DeliverData(RUNNING_STATE);
    arm.ShowVerification("[6,5,0]");
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

TEST_CASE("6.8 A program that ended while it was being stopped is not started again, however late its end is reported")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.DeliverData("[6,5,0]"); // from before the stop
    CHECK_FALSE(arm.IsReportedPaused());
    arm.ShowVerification("[6,6,0]");
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("6.8 A program whose stop got lost is stopped again, and continues if the robot is no longer to be paused")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.Deliver(OpenStream::ClientLost{});
    const bool bResumed = GENERATE(false, true);
    if (bResumed)
    {
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    }
    arm.ComeBack();
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Accept("[6,5,0]");
    CHECK(arm.TakeRequests() == (bResumed ? std::vector<std::string>{START} : std::vector<std::string>{}));
}

TEST_CASE("6.8 A program that runs already is not resumed, and is observed as usual")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
    arm.DeliverData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS, MONITOR_PLAYBACK});
    arm.actions.clear();
    arm.DeliverData(RUNNING_STATE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    CHECK(arm.TakeErrors().empty());
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("6.8 A program that cannot be resumed because the motor is off is resumed when the motor is on")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
    arm.actions.clear();
    arm.DeliverData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR, MOTOR_ON});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.DeliverData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.DeliverData("[6,5,0]");
    ShowProgramProbe(arm, STOPPED_STATE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeErrors() == "");
}

TEST_CASE("6.8 A stopped program whose resume is refused is reported, and resumed again until it runs")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    arm.DeliverData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR, MONITOR_COUNTERS, MONITOR_PLAYBACK});
    arm.actions.clear();
    arm.DeliverData(STOPPED_STATE);
    CHECK(arm.TakeErrors() == "?"); // it may have come to its end
    arm.ShowVerification("[6,5,0]");
    CHECK(arm.IsReportedPaused());
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    CHECK(arm.TakeRequests().empty());
    SECTION("It is resumed when that is requested again")
    {
        CHECK(arm.TakeProbe().empty());
        arm.Fire(ArmFixture::RETRY_TIMER);
        ShowProgramProbe(arm, STOPPED_STATE);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
        CHECK(arm.TakeProbe().empty());
        CHECK(arm.TakeErrors() == "?");
        arm.Accept("[6,5,0]");
        CHECK_FALSE(arm.IsReportedPaused());
        CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_PLAYBACK});
        arm.DeliverData(RUNNING_STATE);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It is resumed at the controller: it is not resumed again, and is stopped by the next pause")
    {
        const bool bPaused = GENERATE(false, true);
        if (bPaused)
        {
            arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        }
        else
        {
            arm.Fire(ArmFixture::RETRY_TIMER);
        }
        REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
        arm.DeliverData(RUNNING_STATE);
        CHECK(
            arm.TakeRequests()
            == (bPaused ? std::vector<std::string>{MONITOR_COUNTERS, STOP}
                        : std::vector<std::string>{MONITOR_COUNTERS}));
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It was brought to its end at the controller, as the counters after the probe show")
    {
        arm.Fire(ArmFixture::RETRY_TIMER);
        ShowProgramProbe(arm, STOPPED_STATE, "[6,6,0]");
        CHECK(arm.TakeRequests().empty());
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
        CHECK(arm.TakeErrors().empty());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("It is cancelled")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        ShowProgramProbe(arm, STOPPED_STATE);
        CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
        arm.AcceptReset("[6,5,0]");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It is cancelled, and was resumed at the controller: it is not aborted")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        ShowProgramProbe(arm, RUNNING_STATE);
        CHECK(arm.TakeRequests().empty());
        arm.DeliverData("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("It is paused again, and resumed after that")
    {
        arm.ShowBase(true);
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        ShowProgramProbe(arm, STOPPED_STATE);
        CHECK(arm.IsReportedPaused());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests().empty());
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The connection is lost meanwhile")
    {
        arm.Deliver(OpenStream::ClientLost{});
        arm.ComeBack();
        ShowProgramProbe(arm, STOPPED_STATE);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
}

TEST_CASE("D-16 A program whose resume is refused is reset only if a probe finds it stopped")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS, MONITOR_PLAYBACK});
    const bool bStands = GENERATE(false, true);
    arm.DeliverData(bStands ? STOPPED_STATE : RUNNING_STATE);
    arm.ShowVerification("[6,5,0]");
    CHECK(arm.TakeRequests() == (bStands ? std::vector<std::string>{RESET} : std::vector<std::string>{}));
}

TEST_CASE("6.8 A resume that got lost before counts as done if the controller does not show playback")
{
    ArmFixture arm;
    SettleGoingOn(arm, OpenStream::EControlOutcome::Unknown);
    arm.Deliver(OpenStream::ClientLost{});
    arm.BringUp("[6,5,0]");
    REQUIRE(arm.lastControl == STOP);
    arm.Accept("[6,5,0]");
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    arm.DeliverData(MOTOR_ON_SAMPLE);
    arm.RefuseMonitor("/project/rgen");
    arm.actions.clear();
    arm.ShowBase(false);
    CHECK_FALSE(arm.IsReportedPaused());
    static_cast<void>(arm.TakeRequests());
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

TEST_CASE("6.8 A refused resume fails the job if the controller shows neither motor nor playback")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    arm.RefuseMonitor("/project/robot/motor_on_state");
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.RefuseMonitor("/project/rgen");
    const auto failed = arm.TakeEvents<Planning::JobFailed>();
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().reason.find("403") != std::string::npos);
}

TEST_CASE("D-16 A job that is cancelled while it is paused resets its program and fails; a running one continues")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.AcceptReset("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(arm.TakeRequests().empty());
}

TEST_CASE("D-16 An older controller does not know r_code: its task is reset, and that is remembered for the connection")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{RESET});
    arm.Settle(OpenStream::EControlOutcome::Refused, GENERATE(403, 404));
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{RESET_TASK});
    SECTION("Neither way works: the job stays as it is")
    {
        arm.Settle(OpenStream::EControlOutcome::Refused, 403);
        CHECK(arm.TakeRequests().empty());
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The task is reset")
    {
        arm.AcceptReset("[6,5,0]");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        const bool bReconnect = GENERATE(false, true);
        if (bReconnect)
        {
            arm.Deliver(OpenStream::ClientLost{});
            arm.BringUp("[6,5,0]");
        }
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        arm.Command("K");
        arm.Accept("[6,5,0]");
        arm.Accept("[7,5,0]");
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        arm.Accept("[7,5,0]");
        arm.adapter.Handle(Planning::CancelJob{"K"}, arm.clock.GetNow(), arm.actions);
        arm.ShowProbe(STOPPED_STATE, "[7,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{bReconnect ? RESET : RESET_TASK});
    }
}

TEST_CASE("D-16 A job that was paused before its program began is cancelled at once")
{
    ArmFixture arm;
    arm.BringUp();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Command("J");
    arm.Accept();
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(arm.TakeRequests().empty());
}

} // namespace ACS::Acsd::Test
