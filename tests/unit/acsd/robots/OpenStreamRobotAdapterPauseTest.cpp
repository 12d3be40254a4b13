#include "robots/ArmFixture.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A paused program is to go on, and that is how the controller takes it.
void SettleGoingOn(ArmFixture& arm, OpenStream::EControlOutcome outcome = OpenStream::EControlOutcome::Refused)
{
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(outcome, 403);
}

/// The program is looked at, and the counters behind it.
void ShowLookAtProgram(ArmFixture& arm, std::string_view sample, std::string_view counters = "[6,5,0]")
{
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.TellData(sample);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
    arm.AcknowledgeMonitor();
    arm.TellData(counters);
}

} // namespace

TEST_CASE("6.8 A program counts as stopped when the controller shows that it stands")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.ShowBase(true);
    arm.actions.clear();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_PLAYBACK});
    arm.TellData(PLAYS);
    CHECK(arm.TakeRequests().empty()); // still looked for
    CHECK_FALSE(arm.IsToldPaused());
    arm.TellData(STANDS);
    arm.ShowLook("[6,5,0]");
    CHECK(arm.IsToldPaused());
}

TEST_CASE("6.7 Pause stops the arm's program where it is; the robot is paused when base and arm stand")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.ShowBase(true);
    CHECK_FALSE(arm.IsToldPaused());
    arm.Accept("[6,5,0]");
    CHECK(arm.IsToldPaused());

    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.ShowBase(false);
    CHECK(arm.IsToldPaused());
    arm.Accept("[6,5,0]");
    CHECK_FALSE(arm.IsToldPaused());
    arm.TellData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("6.7 Pause without a job is the base's alone; a program that was just selected is started by Resume")
{
    ArmFixture arm;
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    arm.BringUp();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.ShowBase(true);
    CHECK(arm.IsToldPaused());
    arm.Command("J");
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Accept();
    CHECK(arm.TakeRequests().empty());
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
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
    arm.TellData("[6,5,0]");
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
    CHECK_FALSE(arm.IsToldPaused());
}

TEST_CASE(
    "6.8 A program whose going on got lost is stopped, looked at and started again; that it runs already is no failure")
{
    ArmFixture arm;
    // While it was under way, or after the silence that was taken for its answer.
    SettleGoingOn(arm, GENERATE(OpenStream::EControlOutcome::Unknown, OpenStream::EControlOutcome::Accepted));
    arm.Tell(OpenStream::ClientLost{});
    arm.ComeBack();
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    SECTION("It has come to its end meanwhile: nothing is started")
    {
        arm.Accept("[6,6,0]");
        CHECK(arm.TakeRequests().empty());
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("It stands")
    {
        arm.Accept("[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
        arm.Accept("[6,5,0]");
        CHECK(arm.TakeRequests().empty());
        arm.TellData("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
}

TEST_CASE("6.8 A program counts as going on when the controller shows that it plays")
{
    ArmFixture arm;
    SettleGoingOn(arm, OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_PLAYBACK});
    arm.TellData(STANDS);
    CHECK(arm.TakeRequests().empty()); // still looked for
    arm.TellData(PLAYS);
    arm.ShowLook("[6,5,0]");
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

TEST_CASE("6.8 A program that ended while it was being stopped is not started again, however late that is told")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.TellData("[6,5,0]"); // from before the stop
    CHECK_FALSE(arm.IsToldPaused());
    arm.ShowLook("[6,6,0]");
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("6.8 A program whose stop got lost is stopped again, and goes on where nobody wants it paused any more")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.Tell(OpenStream::ClientLost{});
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

TEST_CASE("6.8 A program that goes on already refuses to be started, and is watched as ever")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR});
    arm.TellData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK, LOOK_AT_PLAYBACK});
    arm.actions.clear();
    arm.TellData(PLAYS);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
    CHECK(arm.TakeErrors().empty());
    arm.TellData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("6.8 A program that cannot go on for a motor that is off goes on when that is on")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR});
    arm.actions.clear();
    arm.TellData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR, MOTOR_ON});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.TellData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
    arm.TellData("[6,5,0]");
    ShowLookAtProgram(arm, STANDS);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeErrors() == "");
}

TEST_CASE("6.8 A program that stands and is refused to go on is told, and started again until it does")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    arm.TellData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR, LOOK, LOOK_AT_PLAYBACK});
    arm.actions.clear();
    arm.TellData(STANDS);
    CHECK(arm.TakeErrors() == "?"); // it may have come to its end
    arm.ShowLook("[6,5,0]");
    CHECK(arm.IsToldPaused());
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    CHECK(arm.TakeRequests().empty());
    SECTION("It goes on when it is asked again")
    {
        CHECK(arm.LookAround().empty());
        arm.Fire(ArmFixture::RETRY_TIMER);
        ShowLookAtProgram(arm, STANDS);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
        CHECK(arm.LookAround().empty());
        CHECK(arm.TakeErrors() == "?");
        arm.Accept("[6,5,0]");
        CHECK_FALSE(arm.IsToldPaused());
        CHECK(arm.LookAround() == std::vector<std::string>{LOOK_AT_PLAYBACK});
        arm.TellData(PLAYS);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("Somebody has it go on: it is not started again, and one that is paused then is stopped")
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
        REQUIRE(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_PLAYBACK});
        arm.TellData(PLAYS);
        CHECK(arm.TakeRequests() == (bPaused ? std::vector<std::string>{LOOK, STOP} : std::vector<std::string>{LOOK}));
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It has come to its end by other hands, which the counters say behind the look")
    {
        arm.Fire(ArmFixture::RETRY_TIMER);
        ShowLookAtProgram(arm, STANDS, "[6,6,0]");
        CHECK(arm.TakeRequests().empty());
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
        CHECK(arm.TakeErrors().empty());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("It is given up")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        ShowLookAtProgram(arm, STANDS);
        CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It is given up, and runs by other hands: it is not broken off")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        ShowLookAtProgram(arm, PLAYS);
        CHECK(arm.TakeRequests().empty());
        arm.TellData("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("It is paused again, and goes on after that")
    {
        arm.ShowBase(true);
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        ShowLookAtProgram(arm, STANDS);
        CHECK(arm.IsToldPaused());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests().empty());
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The connection is lost meanwhile")
    {
        arm.Tell(OpenStream::ClientLost{});
        arm.ComeBack();
        ShowLookAtProgram(arm, STANDS);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
}

TEST_CASE("D-16 A program that is refused to go on is given up only where it is seen to stand")
{
    ArmFixture arm;
    SettleGoingOn(arm);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR});
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.TellData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK, LOOK_AT_PLAYBACK});
    const bool bStands = GENERATE(false, true);
    arm.TellData(bStands ? STANDS : PLAYS);
    arm.ShowLook("[6,5,0]");
    CHECK(arm.TakeRequests() == (bStands ? std::vector<std::string>{RESET} : std::vector<std::string>{}));
}

TEST_CASE("6.8 A going on that got lost before counts as done where the controller does not show playback")
{
    ArmFixture arm;
    SettleGoingOn(arm, OpenStream::EControlOutcome::Unknown);
    arm.Tell(OpenStream::ClientLost{});
    arm.BringUp("[6,5,0]");
    REQUIRE(arm.lastControl == STOP);
    arm.Accept("[6,5,0]");
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    arm.TellData(MOTOR_ON_SAMPLE);
    arm.RefuseMonitor("/project/rgen");
    arm.actions.clear();
    arm.ShowBase(false);
    CHECK_FALSE(arm.IsToldPaused());
    static_cast<void>(arm.TakeRequests());
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
}

TEST_CASE("6.8 A program that is refused to go on fails its job where the controller shows neither motor nor playback")
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

TEST_CASE(
    "D-16 A job that is given up while it is paused resets its program and is told as failed; a running one goes on")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Accept("[6,5,0]");
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
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
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The task is reset")
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        const bool bReconnect = GENERATE(false, true);
        if (bReconnect)
        {
            arm.Tell(OpenStream::ClientLost{});
            arm.BringUp("[6,5,0]");
        }
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        arm.Command("K");
        arm.Accept("[6,5,0]");
        arm.Accept("[7,5,0]");
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        arm.Accept("[7,5,0]");
        arm.adapter.Handle(Planning::CancelJob{"K"}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeRequests() == std::vector<std::string>{bReconnect ? RESET : RESET_TASK});
    }
}

TEST_CASE("D-16 A job that was held before its program began is given up at once")
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
