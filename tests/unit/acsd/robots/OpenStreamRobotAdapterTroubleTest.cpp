#include "robots/ArmFixture.hpp"

// Errors that keep an arm from its work while its session is ready: detected, reported, and cleared.

namespace ACS::Acsd::Test
{

namespace
{

/// Shows one probe of the program, then the counters.
void ShowPlayback(ArmFixture& arm, std::string_view sample, std::string_view counters = "[6,5,0]")
{
    CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.DeliverData(sample);
    arm.ShowVerification(counters);
}

} // namespace

TEST_CASE("A motor that goes off between jobs is detected, reported, and switched on before the next job")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    REQUIRE(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
    arm.DeliverData("[5,5,0]"); // of the MONITOR before
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR, MOTOR_ON});
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    SECTION("It is on again")
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.DeliverData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeErrors() == "?");
        arm.DeliverData("[5,5,0]");
        CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It stays off: the reason is reported, and it is switched on again")
    {
        arm.Settle(OpenStream::EControlOutcome::Refused, 403);
        arm.Fire(ArmFixture::RETRY_TIMER);
        const auto states = arm.TakeEvents<Planning::StateChanged>();
        REQUIRE(states.size() == 1);
        CHECK(states.front().errors.at(0).message.find("403") != std::string::npos);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MOTOR_ON});
    }
    SECTION("It was switched on at the controller: the earlier reason is not reported the next time")
    {
        arm.Settle(OpenStream::EControlOutcome::Refused, 403);
        arm.DeliverData(MOTOR_ON_SAMPLE);
        arm.DeliverData("[5,5,0]");
        arm.actions.clear();
        REQUIRE(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
        arm.DeliverData("[5,5,0]");
        arm.DeliverData(MOTOR_OFF_SAMPLE);
        const auto states = arm.TakeEvents<Planning::StateChanged>();
        REQUIRE_FALSE(states.empty());
        CHECK(states.back().errors.at(0).message.find("403") == std::string::npos);
    }
}

TEST_CASE("A probe of a motor that is on takes one sample, after which the counters are shown again")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    REQUIRE(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
    arm.DeliverData(MOTOR_ON_SAMPLE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    CHECK(arm.TakeErrors() == "?");
    CHECK(arm.TakeProbe().empty()); // not before the counters were there
    arm.DeliverData("[5,5,0]");
    CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
}

TEST_CASE("A motor that stays off after the connection is reported, and the robot is online")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    arm.DeliverData(MOTOR_OFF_SAMPLE);
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    arm.Fire(ArmFixture::RETRY_TIMER);
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
    CHECK(arm.TakeErrors() == "ARM-motorOff");
    arm.Deliver(OpenStream::ClientLost{});
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{false}});
}

TEST_CASE("A job that is refused because the motor is off has not failed: it is commanded again when the motor is on")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.actions.clear();
    arm.Command("J");
    arm.Accept();
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
    SECTION("The motor is off")
    {
        arm.DeliverData(MOTOR_OFF_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
        CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
        // Reported first, so that the job is not commanded again at once.
        const auto isUnknown = [](const Planning::AdapterAction& action) {
            const auto* const raiseOrNull = std::get_if<Planning::RaiseEvent>(&action);
            return raiseOrNull != nullptr && std::holds_alternative<Planning::JobUnknown>(raiseOrNull->event);
        };
        arm.actions.erase(std::ranges::find_if(arm.actions, isUnknown), arm.actions.end());
        CHECK(arm.TakeErrors() == "ARM-motorOff");
    }
    SECTION("It is on")
    {
        arm.DeliverData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    }
    SECTION("The controller does not show it")
    {
        arm.RefuseMonitor("/project/robot/motor_on_state");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        arm.ShowVerification();
        CHECK(arm.TakeProbe().empty());
    }
    SECTION("It is cancelled meanwhile")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        arm.DeliverData(MOTOR_ON_SAMPLE);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    }
    SECTION("The connection is lost meanwhile")
    {
        arm.Deliver(OpenStream::ClientLost{});
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    }
}

TEST_CASE("A program that was halted at the controller is reported after two probes, until it runs again")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    ShowPlayback(arm, RUNNING_STATE);
    ShowPlayback(arm, STOPPED_STATE);
    CHECK(arm.TakeErrors() == "?");
    ShowPlayback(arm, STOPPED_STATE);
    CHECK(arm.TakeErrors() == "ARM-programHalted");
    SECTION("It runs again")
    {
        ShowPlayback(arm, RUNNING_STATE);
        CHECK(arm.TakeErrors().empty());
        ShowPlayback(arm, STOPPED_STATE);
        CHECK(arm.TakeErrors() == "?");
    }
    SECTION("It is abandoned at the controller")
    {
        arm.DeliverData("[6,5,1]");
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("It is paused")
    {
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeProbe().empty());
        CHECK(arm.TakeErrors().empty());
    }
}

TEST_CASE("A program that has just come to its end was not halted")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    ShowPlayback(arm, STOPPED_STATE);
    ShowPlayback(arm, STOPPED_STATE, "[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    for (const Planning::StateChanged& state : arm.TakeEvents<Planning::StateChanged>())
    {
        CHECK(state.errors.empty());
    }
    arm.Command("K");
    arm.Accept("[6,6,0]");
    arm.Accept("[7,6,0]");
    arm.actions.clear();
    ShowPlayback(arm, STOPPED_STATE, "[7,6,0]");
    CHECK(arm.TakeErrors() == "?");
}

TEST_CASE("A refused MONITOR is reported, and requested again")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    SECTION("The one of the motor")
    {
        arm.RefuseMonitor("/project/robot/motor_on_state");
        CHECK(arm.TakeErrors() == "ARM-monitorRefused");
        static_cast<void>(arm.TakeRequests());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR, MOTOR_ON});
    }
    SECTION("The one of the counters")
    {
        arm.DeliverData(MOTOR_ON_SAMPLE);
        arm.RefuseMonitor("/project/plc/m/val_s32");
        CHECK(arm.TakeErrors() == "ARM-monitorRefused");
        static_cast<void>(arm.TakeRequests());
        arm.Fire(ArmFixture::RETRY_TIMER);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
        arm.DeliverData("[5,5,0]");
        CHECK(arm.TakeErrors().empty());
    }
    SECTION("One that another has replaced is of no interest")
    {
        arm.DeliverData(MOTOR_ON_SAMPLE);
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
    arm.ShowVerification("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    CHECK(arm.TakeErrors().empty());
}

TEST_CASE("Relays that the controller does not have are reported with the keys to check")
{
    ArmFixture arm;
    arm.ConnectWithBase();
    arm.DeliverData(MOTOR_ON_SAMPLE);
    arm.actions.clear();
    arm.DeliverData("[5]");
    CHECK(arm.TakeErrors() == "?");
    arm.Fire(ArmFixture::RETRY_TIMER);
    const auto states = arm.TakeEvents<Planning::StateChanged>();
    REQUIRE(states.size() == 1);
    CHECK(states.front().errors.at(0).message.find("arm.monitor_url") != std::string::npos);
    CHECK(arm.TakeErrors() == "ARM-countersMissing");
}

TEST_CASE("A controller that accepts the MONITOR of a probe and shows nothing is not probed again")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    REQUIRE(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
    SECTION("It was taken")
    {
        arm.AcknowledgeMonitor();
        CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_COUNTERS});
        arm.DeliverData("[5,5,0]");
        CHECK(arm.TakeProbe().empty());
    }
    SECTION("It is slow")
    {
        CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_COUNTERS});
        arm.DeliverData("[5,5,0]");
        CHECK(arm.TakeProbe() == std::vector<std::string>{MONITOR_MOTOR});
    }
    SECTION("A job comes in between")
    {
        arm.Command("J");
        arm.Accept();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
}

TEST_CASE("A robot with an arm is online when the factsheet of its base is here, or does not come")
{
    VDA5050::MasterOptions base = MakeBaseOptions();
    base.bFactsheetRequested = true;
    ArmFixture arm(MakeArmOptions(), {}, base);
    arm.BringUpWithBase();
    CHECK(arm.TakeEvents<Planning::LinkChanged>().empty());
    SECTION("it arrives")
    {
        VDA5050::FactsheetMessage factsheet;
        factsheet.header = {1, arm.clock.GetNow().wall, "2.0.0", "ACS", "CR01"};
        std::string payload;
        VDA5050::Vda5050Codec().Encode(factsheet, VDA5050::EVda5050Version::Version200, payload);
        arm.adapter.OnMqttMessage({"uagv/v2/ACS/CR01/factsheet", payload, 0, true}, arm.clock.GetNow(), arm.actions);
    }
    SECTION("it is not sent")
    {
        constexpr Planning::AdapterTimerID FACTSHEET_TIMER = 51;
        arm.adapter.OnTimer(FACTSHEET_TIMER, arm.clock.GetNow(), arm.actions);
    }
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
}

TEST_CASE("The robot's state is reported when it comes online, because its base may report the next one much later")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.Deliver(OpenStream::ClientLost{});
    arm.actions.clear();
    arm.BringUp();
    CHECK(arm.TakeErrors() == "?");
    arm.Deliver(OpenStream::ClientLost{});
    arm.Deliver(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.DeliverData(MOTOR_ON_SAMPLE);
    arm.actions.clear();
    arm.DeliverData("[5,5,0]");
    CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
    CHECK(arm.TakeErrors().empty());
}

TEST_CASE("Counters that disappear from the samples are reported, and read again when they are back")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.actions.clear();
    for (int probe = 0; probe < 5; ++probe)
    {
        arm.DeliverData(probe == 0 ? "[6,5,0]" : "[5]");
        static_cast<void>(arm.TakeProbe());
        arm.DeliverData(RUNNING_STATE);
    }
    CHECK(arm.TakeErrors() == "?");
    static_cast<void>(arm.TakeRequests());
    arm.Fire(ArmFixture::PROBE_TIMER);
    CHECK(arm.TakeErrors() == "ARM-countersMissing");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeErrors().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty()); // taken above
}

} // namespace ACS::Acsd::Test
