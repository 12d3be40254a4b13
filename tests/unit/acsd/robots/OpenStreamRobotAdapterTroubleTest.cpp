#include "robots/ArmFixture.hpp"

// What keeps an arm from its work while its session is there: seen, told, and over when it is over.

namespace ACS::Acsd::Test
{

namespace
{

/// One glance at the program, and the counters behind it.
void ShowPlayback(ArmFixture& arm, std::string_view sample, std::string_view counters = "[6,5,0]")
{
    CHECK(arm.LookAround() == std::vector<std::string>{LOOK_AT_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.TellData(sample);
    arm.ShowLook(counters);
}

} // namespace

TEST_CASE("A motor that goes off between jobs is seen, told, and asked to go on before there is another job")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    REQUIRE(arm.LookAround() == std::vector<std::string>{LOOK_AT_MOTOR});
    arm.TellData("[5,5,0]"); // of the MONITOR before
    CHECK(arm.TakeRequests().empty());
    arm.TellData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR, MOTOR_ON});
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    SECTION("It goes on")
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.TellData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeErrors() == "?");
        arm.TellData("[5,5,0]");
        CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It does not: the reason is told, and it is asked again")
    {
        arm.Settle(OpenStream::EControlOutcome::Refused, 403);
        arm.Fire(ArmFixture::RETRY_TIMER);
        const auto states = arm.TakeEvents<Planning::StateChanged>();
        REQUIRE(states.size() == 1);
        CHECK(states.front().errors.at(0).message.find("403") != std::string::npos);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MOTOR_ON});
    }
}

TEST_CASE("A motor that is on is glanced at for one sample, and the counters come back")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    REQUIRE(arm.LookAround() == std::vector<std::string>{LOOK_AT_MOTOR});
    arm.TellData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
    CHECK(arm.TakeErrors() == "?");
    CHECK(arm.LookAround().empty()); // not before the counters were there
    arm.TellData("[5,5,0]");
    CHECK(arm.LookAround() == std::vector<std::string>{LOOK_AT_MOTOR});
}

TEST_CASE("A motor that does not go on after the connection is told, with the robot in reach")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    arm.TellData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    arm.Fire(ArmFixture::RETRY_TIMER);
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    arm.Tell(OpenStream::ClientLost{});
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{false}});
}

TEST_CASE("A job that is refused for a motor that is off has not failed: it comes again when the motor is on")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    arm.Command("J");
    arm.Accept();
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR});
    SECTION("The motor is off")
    {
        arm.TellData(MOTOR_OFF_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
        CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
        // Told before, so that the job does not come at once.
        const auto isUnknown = [](const Planning::AdapterAction& action) {
            const auto* const raiseOrNull = std::get_if<Planning::RaiseEvent>(&action);
            return raiseOrNull != nullptr && std::holds_alternative<Planning::JobUnknown>(raiseOrNull->event);
        };
        arm.actions.erase(std::ranges::find_if(arm.actions, isUnknown), arm.actions.end());
        CHECK(arm.TakeErrors() == "ARM-motorOff");
    }
    SECTION("It is on")
    {
        arm.TellData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
    }
    SECTION("The controller does not show it")
    {
        arm.RefuseMonitor("/project/robot/motor_on_state");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        arm.ShowLook();
        CHECK(arm.LookAround().empty());
    }
    SECTION("It is given up meanwhile")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        arm.TellData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    }
    SECTION("The connection is lost meanwhile")
    {
        arm.Tell(OpenStream::ClientLost{});
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    }
}

TEST_CASE("A program that somebody has halted is told when two glances have seen it, and no longer when it goes on")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    ShowPlayback(arm, PLAYS);
    ShowPlayback(arm, STANDS);
    CHECK(arm.TakeErrors() == "?");
    ShowPlayback(arm, STANDS);
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    SECTION("It goes on")
    {
        ShowPlayback(arm, PLAYS);
        CHECK(arm.TakeErrors().empty());
        ShowPlayback(arm, STANDS);
        CHECK(arm.TakeErrors() == "?");
    }
    SECTION("It is given up at the controller")
    {
        arm.TellData("[6,5,1]");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It is paused")
    {
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.LookAround().empty());
        CHECK(arm.TakeErrors().empty());
    }
}

TEST_CASE("A program that has just come to its end was not halted")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    ShowPlayback(arm, STANDS);
    ShowPlayback(arm, STANDS, "[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    for (const Planning::StateChanged& state : arm.TakeEvents<Planning::StateChanged>())
    {
        CHECK(state.errors.empty());
    }
    arm.Command("K");
    arm.Accept("[6,6,0]");
    arm.Accept("[7,6,0]");
    arm.actions.clear();
    ShowPlayback(arm, STANDS, "[7,6,0]");
    CHECK(arm.TakeErrors() == "?");
}

TEST_CASE("A MONITOR that is refused is told, and asked for again")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    SECTION("The one of the motor")
    {
        arm.RefuseMonitor("/project/robot/motor_on_state");
        CHECK(arm.TakeErrors() == "ARM-monitorRefused");
        static_cast<void>(arm.TakeRequests());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK_AT_MOTOR, MOTOR_ON});
    }
    SECTION("The one of the counters")
    {
        arm.TellData(MOTOR_ON_SAMPLE);
        arm.RefuseMonitor("/project/plc/m/val_s32");
        CHECK(arm.TakeErrors() == "ARM-monitorRefused");
        static_cast<void>(arm.TakeRequests());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests() == std::vector<std::string>{LOOK});
        arm.TellData("[5,5,0]");
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("One that another has replaced is of no interest")
    {
        arm.TellData(MOTOR_ON_SAMPLE);
        arm.actions.clear();
        arm.RefuseMonitor("/project/robot/motor_on_state");
        CHECK(arm.TakeErrors() == "?");
    }
}

TEST_CASE("The counters' MONITOR that is refused in mid-job is asked for again, and shows the job's end")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    arm.RefuseMonitor("/project/plc/m/val_s32");
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    CHECK(arm.TakeErrors() == "ARM-monitorRefused");
    arm.Fire(ArmFixture::RETRY_TIMER);
    arm.ShowLook("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    CHECK(arm.TakeErrors().empty());
}

TEST_CASE("Relays that the controller does not have are told with what to look at")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    arm.TellData(MOTOR_ON_SAMPLE);
    arm.actions.clear();
    arm.TellData("[5]");
    CHECK(arm.TakeErrors() == "?");
    arm.Fire(ArmFixture::RETRY_TIMER);
    const auto states = arm.TakeEvents<Planning::StateChanged>();
    REQUIRE(states.size() == 1);
    CHECK(states.front().errors.at(0).message.find("arm.monitor_url") != std::string::npos);
    CHECK(arm.TakeErrors() == "ARM-countersMissing");
}

TEST_CASE("A controller that takes the MONITOR of a glance and shows nothing is not glanced at again")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    REQUIRE(arm.LookAround() == std::vector<std::string>{LOOK_AT_MOTOR});
    SECTION("It was taken")
    {
        arm.AcknowledgeMonitor();
        CHECK(arm.LookAround() == std::vector<std::string>{LOOK});
        arm.TellData("[5,5,0]");
        CHECK(arm.LookAround().empty());
    }
    SECTION("It is slow")
    {
        CHECK(arm.LookAround() == std::vector<std::string>{LOOK});
        arm.TellData("[5,5,0]");
        CHECK(arm.LookAround() == std::vector<std::string>{LOOK_AT_MOTOR});
    }
    SECTION("A job comes in between")
    {
        arm.Command("J");
        arm.Accept();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
}

TEST_CASE("The robot's state is told with its coming into reach, as its base may tell the next one much later")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.Tell(OpenStream::ClientLost{});
    arm.actions.clear();
    arm.BringUp();
    CHECK(arm.TakeErrors() == "?");
    arm.Tell(OpenStream::ClientLost{});
    arm.Tell(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.TellData(MOTOR_ON_SAMPLE);
    arm.actions.clear();
    arm.TellData("[5,5,0]");
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
    CHECK(arm.TakeErrors().empty());
}

} // namespace ACS::Acsd::Test
