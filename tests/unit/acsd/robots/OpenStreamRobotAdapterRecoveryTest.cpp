#include "robots/ArmFixture.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// acsd was restarted and the adapter asked for the job J, which was commanded when the counters were these.
void RecoverJob(ArmFixture& arm, const std::string& progressToken = "5 5 0")
{
    Planning::RecoverJob recover;
    recover.job.jobID = "J";
    recover.job.action = "TrayLoad";
    recover.job.progressToken = progressToken;
    arm.adapter.Handle(recover, arm.clock.GetNow(), arm.actions);
}

/// The same, with a connected arm that shows these counters.
struct ArmRecoveryFixture : ArmFixture
{
    explicit ArmRecoveryFixture(std::string_view counters, const std::string& progressToken = "5 5 0")
    {
        RecoverJob(*this, progressToken);
        CHECK(actions.empty());
        Deliver(OpenStream::ClientReady{});
        Settle(OpenStream::EControlOutcome::Accepted); // motor_on
        DeliverData(R"({"_type":"JObject","val":0})");
        static_cast<void>(TakeRequests());
        DeliverData(counters);
    }

    void EndWait()
    {
        adapter.OnTimer(101, clock.GetNow(), actions);
    }
};

} // namespace

TEST_CASE("After a restart the counters prove that a job has ended, or that it runs")
{
    ArmRecoveryFixture done("[6,6,0]");
    CHECK(done.TakeEvents<Planning::JobStarted>().size() == 1);
    CHECK(done.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    ArmRecoveryFixture failed("[6,5,1]");
    CHECK(failed.TakeEvents<Planning::JobFailed>().size() == 1);
    ArmRecoveryFixture running("[6,5,0]");
    CHECK(running.TakeEvents<Planning::JobStarted>().size() == 1);
    CHECK(running.TakeEvents<Planning::JobFinished>().empty());
    running.EndWait();
    running.DeliverData("[6,6,0]");
    CHECK(running.TakeEvents<Planning::JobFinished>().size() == 1);
    CHECK(running.TakeRequests().empty()); // nothing was started
}

TEST_CASE("After a restart a program whose first counter does not rise in time was never started; one in time runs")
{
    ArmRecoveryFixture never("[5,5,0]");
    CHECK(never.TakeEvents<Planning::JobUnknown>().empty());
    never.EndWait();
    CHECK(never.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    never.EndWait();
    CHECK(never.TakeEvents<Planning::JobUnknown>().size() == 1);
    ArmRecoveryFixture late("[5,5,0]");
    late.DeliverData("[6,5,0]");
    late.EndWait();
    CHECK(late.TakeEvents<Planning::JobUnknown>().empty());
    CHECK(late.TakeEvents<Planning::JobStarted>().size() == 1);
    CHECK(late.TakeRequests().empty());
}

TEST_CASE("After a restart counters that are all 0, have fallen or have risen too far prove nothing of a job")
{
    for (const char* counters : {"[0,0,0]", "[4,4,0]", "[7,7,0]", "[6,6,1]", "[5,6,0]"})
    {
        INFO(counters);
        ArmRecoveryFixture arm(counters);
        CHECK(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
        arm.EndWait();
        arm.DeliverData("[6,6,0]"); // later evidence is none
        CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
        CHECK(arm.TakeEvents<Planning::JobUnknown>().empty());
    }
    ArmRecoveryFixture zero("[0,0,0]", "0 0 0"); // a controller that was restarted shows the same
    CHECK(zero.TakeEvents<Planning::JobUnresolved>().size() == 1);
    ArmRecoveryFixture unchanged("[5,5,0]", "");
    CHECK(unchanged.TakeEvents<Planning::JobUnresolved>().size() == 1);
}

TEST_CASE(
    "After a restart a job that is cancelled during a pause resets its program, also before its counters are known")
{
    ArmFixture arm;
    RecoverJob(arm);
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    arm.Deliver(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Accepted); // motor_on
    arm.DeliverData(R"({"_type":"JObject","val":0})");
    static_cast<void>(arm.TakeRequests());
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Accept("[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{RESET});
    arm.AcceptReset("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
}

TEST_CASE(
    "After a restart a program that may have been paused is stopped, probed and resumed; any other is not touched")
{
    ArmRecoveryFixture alone("[6,5,0]");
    CHECK(alone.TakeRequests().empty());

    ArmRecoveryFixture arm("[6,5,0]");
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    SECTION("It was stopped")
    {
        arm.Accept("[6,5,0]");
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
        arm.Accept("[6,5,0]");
    }
    SECTION("It has ended meanwhile")
    {
        arm.Accept("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("It stands for a reason of its own")
    {
        arm.Accept("[6,5,0]");
        arm.Settle(OpenStream::EControlOutcome::Refused, 403);
        static_cast<void>(arm.TakeRequests());
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    }
    CHECK(arm.TakeRequests().empty());
}

TEST_CASE("After a restart a program is not started while its vehicle is paused and no resume was commanded")
{
    ArmRecoveryFixture arm("[6,5,0]");
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    arm.ShowBase(true);
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Accept("[6,5,0]");
    CHECK(arm.TakeRequests().empty());
    const bool bCommanded = GENERATE(false, true);
    if (bCommanded)
    {
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    }
    else
    {
        arm.ShowBase(false);
        arm.DeliverData("[6,5,0]");
    }
    arm.ShowProbe(STOPPED_STATE, "[6,5,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("After a restart a paused vehicle is not paused before the arm's program is known to be stopped")
{
    ArmFixture arm;
    RecoverJob(arm);
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    arm.ShowBase(true);
    arm.Deliver(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Accepted); // motor_on
    arm.DeliverData(MOTOR_ON_SAMPLE);
    static_cast<void>(arm.TakeRequests());
    arm.DeliverData("[6,5,0]");
    const auto states = arm.TakeEvents<Planning::StateChanged>();
    CHECK_FALSE(states.empty());
    CHECK(std::ranges::none_of(states, &Planning::StateChanged::bPaused));
    arm.actions.clear();
    CHECK(arm.TakeRequests() == std::vector<std::string>{STOP});
    arm.Accept("[6,5,0]");
    CHECK(arm.IsReportedPaused());
}

TEST_CASE("After a restart a robot is occupied from its first state to the end of the program of a resolved job")
{
    ArmFixture arm;
    RecoverJob(arm);
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    const auto areAllOccupied = [&arm] {
        const auto states = arm.TakeEvents<Planning::StateChanged>();
        return !states.empty() && std::ranges::all_of(states, &Planning::StateChanged::bOccupied);
    };
    const bool bBaseFirst = GENERATE(true, false);
    if (bBaseFirst)
    {
        arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
        arm.ShowBase(false);
        CHECK(areAllOccupied());
    }
    arm.Deliver(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Refused, 400); // motor_on: the robot is online with an error
    arm.DeliverData(MOTOR_OFF_SAMPLE);
    if (!bBaseFirst)
    {
        arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
        arm.ShowBase(false);
    }
    arm.outputs.messages.clear();
    arm.adapter.Handle(Planning::Drive{"D", {}, 2}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.outputs.messages.empty());
    CHECK(arm.TakeEvents<Planning::DriveRejected>().size() == 1);
    arm.Command("K");
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"K"}});
    arm.DeliverData(MOTOR_ON_SAMPLE);
    arm.DeliverData("[6,5,0]");
    CHECK(areAllOccupied());
    arm.ShowBase(false);
    CHECK(areAllOccupied());
    arm.actions.clear();
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK_FALSE(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE("After a restart a resolved job that the counters do not prove leaves its robot free")
{
    const std::string counters = GENERATE("[7,7,0]", "[0,0,0]", "[5,5,0]");
    ArmFixture arm;
    RecoverJob(arm);
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    arm.ShowBase(false);
    arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
    arm.Deliver(OpenStream::ClientReady{});
    arm.Settle(OpenStream::EControlOutcome::Accepted); // motor_on
    arm.DeliverData(MOTOR_ON_SAMPLE);
    arm.DeliverData(counters);
    if (counters == "[5,5,0]") // it may not have begun yet
    {
        CHECK(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
        arm.Fire(ArmFixture::START_TIMER);
        CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    }
    else
    {
        CHECK(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
    }
    CHECK_FALSE(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE("Counters that are all 0 after a reconnect do not prove that a program did not begin")
{
    ArmFixture arm;
    arm.BringUp("[0,0,0]");
    arm.Command("J");
    arm.Accept("[0,0,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(OpenStream::EControlOutcome::Unknown);
    arm.Deliver(OpenStream::ClientLost{});
    arm.BringUp("[0,0,0]");
    arm.Fire(ArmFixture::START_TIMER);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
}

} // namespace ACS::Acsd::Test
