#include "robots/ArmFixture.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

TEST_CASE("After the handshake the motor is switched on, and only then the counters are observed")
{
    ArmFixture arm;
    arm.Deliver(OpenStream::ClientReady{});
    CHECK(
        arm.TakeRequests()
        == std::vector<std::string>{"MONITOR /project/robot/motor_on_state", "CONTROL /project/robot/motor_on {}"});
    arm.DeliverData(R"({"val":2})");
    arm.DeliverData(R"({"val":1})");
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData(R"({"val":0})");
    CHECK(arm.TakeRequests() == std::vector<std::string>{"MONITOR /project/plc/m/val_s32"});
}

TEST_CASE("A job selects its program, starts it, and is done when the finished counter has changed")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Accept();
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.DeliverData("[5,5,0]");
    CHECK(arm.TakeEvents<Planning::JobStarted>().empty());
    arm.DeliverData("[6,5,0]");
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::JobStarted>() == std::vector<Planning::JobStarted>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
    arm.DeliverData("[6,6,0]");
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("A counter that wraps around has changed, too")
{
    ArmFixture arm;
    arm.BringUp("[2147483647,2147483647,0]");
    arm.Command("J");
    arm.Accept("[2147483647,2147483647,0]");
    arm.DeliverData("[-2147483648,-2147483648,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("A program that raises the failed counter fails its job")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.DeliverData("[6,5,1]");
    REQUIRE(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    arm.DeliverData("[6,6,1]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
}

TEST_CASE("A refused CONTROL fails the job with the controller's status")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Settle(OpenStream::EControlOutcome::Refused, 403);
    arm.DeliverData(R"({"val":0})"); // the motor is not the reason
    const auto failed = arm.TakeEvents<Planning::JobFailed>();
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().reason.find("403") != std::string::npos);
}

TEST_CASE("A start whose fate is not known is never sent again: the counters decide")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Unknown);
    arm.Deliver(OpenStream::ClientLost{});
    arm.Deliver(OpenStream::ClientReady{});
    arm.DeliverData(R"({"val":0})");
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    for (const std::string& request : arm.TakeRequests())
    {
        CHECK(request != START);
        CHECK(request != SELECT);
    }
}

TEST_CASE("A start that got lost with the connection fails its job when the program does not begin")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Settle(OpenStream::EControlOutcome::Unknown);
    arm.Deliver(OpenStream::ClientLost{});
    arm.Deliver(OpenStream::ClientReady{});
    arm.DeliverData(R"({"val":0})");
    arm.actions.clear();
    arm.DeliverData("[5,5,0]");
    REQUIRE(arm.IsStartWatched());
    SECTION("It does not begin")
    {
        arm.Fire(ArmFixture::START_TIMER);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
    }
    SECTION("It has begun")
    {
        arm.DeliverData("[6,5,0]");
        arm.Fire(ArmFixture::START_TIMER);
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
        arm.DeliverData("[6,6,0]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
}

TEST_CASE("Counters that begin again are the result of a restart: the job is unresolved")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Accept("[6,5,0]");
    arm.Deliver(OpenStream::ClientLost{});
    arm.Deliver(OpenStream::ClientReady{});
    arm.DeliverData(R"({"val":0})");
    arm.DeliverData("[0,0,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    REQUIRE(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
    CHECK(arm.TakeEvents<Planning::JobUnresolved>().front().reason.find("restarted") != std::string::npos);
}

TEST_CASE("A start that was answered by silence and got lost fails its job when the program does not begin")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Settle(OpenStream::EControlOutcome::Accepted); // it did not arrive
    arm.Deliver(OpenStream::ClientLost{});
    arm.Deliver(OpenStream::ClientReady{});
    arm.DeliverData(R"({"val":0})");
    arm.actions.clear();
    arm.DeliverData("[5,5,0]");
    CHECK(arm.IsStartWatched());
    arm.adapter.OnTimer(101, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
}

TEST_CASE("A refusal that comes after the silence fails the job whose program it did not let begin")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    SECTION("Of the selection: nothing is started")
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT, MONITOR_PLAYBACK});
        arm.Deliver(OpenStream::ClientControlFault{403, std::nullopt, "a task is playing"});
    }
    SECTION("Of the start")
    {
        arm.Accept();
        arm.Accept();
        arm.actions.clear();
        arm.Deliver(OpenStream::ClientControlFault{403, std::nullopt, "a task is playing"});
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
        CHECK(arm.IsStartWatched());
        arm.Fire(ArmFixture::START_TIMER);
    }
    const auto failed = arm.TakeEvents<Planning::JobFailed>();
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().reason.find("a task is playing") != std::string::npos);
    CHECK(arm.TakeRequests().empty());
}

TEST_CASE("A late refusal is not of the program that begins after it")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Accept();
    arm.Deliver(OpenStream::ClientControlFault{403, std::nullopt, "late"});
    arm.DeliverData("[6,5,0]");
    arm.Fire(ArmFixture::START_TIMER);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("A job of an action without a program fails with a reason")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J2", "CassetteLoad");
    const auto failed = arm.TakeEvents<Planning::JobFailed>();
    REQUIRE(failed.size() == 1);
    CHECK(failed.front().jobID == "J2");
    CHECK(failed.front().reason.find("CassetteLoad") != std::string::npos);
    CHECK(arm.TakeRequests().empty());
}

TEST_CASE("A job that comes while the arm is away was not begun: it waits for the arm instead of failing its plan")
{
    ArmFixture arm;
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    SECTION("The arm has gone")
    {
        arm.BringUp();
        arm.ShowBase(false);
        arm.actions.clear();
        arm.Deliver(OpenStream::ClientLost{});
        // Reported before the job is returned: the engine does not command it again at once.
        CHECK(arm.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{false}});
    }
    SECTION("Its motor is not on yet")
    {
        arm.Deliver(OpenStream::ClientReady{});
        static_cast<void>(arm.TakeRequests());
    }
    Planning::StartJob job;
    job.jobID = "J";
    job.action = "TrayLoad";
    job.progressToken = "5 5 0";
    arm.adapter.Handle(job, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeRequests().empty());

    arm.BringUp();
    arm.adapter.Handle(job, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
}

TEST_CASE("While the base is offline its earlier reports are not repeated, whatever the arm shows")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.adapter.OnLinkDown(arm.clock.GetNow(), arm.actions);
    arm.actions.clear();
    arm.DeliverData("[6,5,0]");
    CHECK(arm.TakeEvents<Planning::StateChanged>().empty());
    arm.adapter.OnLinkUp(arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::StateChanged>().empty());
    arm.ShowBase(false);
    const auto states = arm.TakeEvents<Planning::StateChanged>();
    REQUIRE_FALSE(states.empty());
    CHECK(states.back().restartEvidence.progressToken == "6 5 0");
}

TEST_CASE("A program that was surely not started is not the job's failure, whatever got lost on the way")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    SECTION("Its selection never left")
    {
        arm.Settle(OpenStream::EControlOutcome::NotSent);
    }
    SECTION("It is unknown whether it was selected")
    {
        arm.Settle(OpenStream::EControlOutcome::Unknown);
    }
    SECTION("Its start never left")
    {
        arm.Accept();
        arm.Settle(OpenStream::EControlOutcome::NotSent);
    }
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    static_cast<void>(arm.TakeRequests());
    arm.Command("J");
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
}

TEST_CASE("The settling of motor_on is not taken for that of a job's CONTROL")
{
    ArmFixture arm;
    arm.Deliver(OpenStream::ClientReady{});
    arm.DeliverData(R"({"val":0})");
    arm.DeliverData("[5,5,0]");
    static_cast<void>(arm.TakeRequests());
    arm.Command("J");
    arm.Settle(OpenStream::EControlOutcome::Accepted); // motor_on, late
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Accept();
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("Answers that are no counters are passed over")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    for (const std::string_view nonsense : {"[]", "[6]", R"(["a","b","c"])", R"({"val":0})", "null", "[6,6.5,0]"})
    {
        arm.DeliverData(nonsense);
    }
    CHECK(arm.TakeEvents<Planning::JobStarted>().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
}

TEST_CASE("The counters are the progress token of the robot; a job with another token is not begun")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().restartEvidence.progressToken == "5 5 0");
    arm.DeliverData("[6,6,0]"); // a program that was run at the controller
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().restartEvidence.progressToken == "6 6 0");
    Planning::StartJob job;
    job.jobID = "J";
    job.action = "TrayLoad";
    job.progressToken = "5 5 0";
    arm.adapter.Handle(job, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    CHECK(arm.TakeRequests().empty());
    job.progressToken = "6 6 0";
    arm.adapter.Handle(job, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
}

TEST_CASE("A robot is occupied while its arm runs the program of a cancelled job")
{
    const std::string end = GENERATE("[6,6,0]", "[6,5,1]", "[0,0,0]"); // done, failed, controller restarted
    const bool bRecovered = GENERATE(false, true);
    ArmFixture arm;
    const auto cancel = [&arm] {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
    };
    if (bRecovered)
    {
        Planning::RecoverJob recover;
        recover.job.jobID = "J";
        recover.job.action = "TrayLoad";
        recover.job.progressToken = "5 5 0";
        arm.adapter.Handle(recover, arm.clock.GetNow(), arm.actions);
        cancel();
        arm.ConnectWithBase();
        arm.Settle(OpenStream::EControlOutcome::Accepted); // motor_on
        arm.DeliverData(MOTOR_ON_SAMPLE);
        arm.DeliverData("[6,5,0]");
    }
    else
    {
        arm.StartRunning();
        arm.actions.clear();
        cancel();
    }
    REQUIRE_FALSE(arm.TakeEvents<Planning::StateChanged>().empty());
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
    arm.ShowBase(false);
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.DeliverData(end);
    CHECK_FALSE(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE(
    "A job that was resolved while the arm was away keeps the robot from driving and from other jobs until its end")
{
    ArmFixture arm;
    arm.StartRunning();
    arm.Deliver(OpenStream::ClientLost{});
    arm.ComeBack();
    arm.actions.clear();
    arm.outputs.messages.clear();
    arm.adapter.Handle(Planning::Drive{"D", {}, 2}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.outputs.messages.empty());
    CHECK(arm.TakeEvents<Planning::DriveRejected>().size() == 1);
    REQUIRE(arm.TakeEvents<Planning::StateChanged>().size() == 1);
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
    arm.Command("K");
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"K"}});
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK_FALSE(arm.TakeEvents<Planning::StateChanged>().back().bOccupied);
    arm.Command("K");
    CHECK(arm.TakeRequests() == std::vector<std::string>{REWIND});
}

} // namespace ACS::Acsd::Test
