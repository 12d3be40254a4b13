#include "robots/ArmFixture.hpp"

#include <string>
#include <string_view>
#include <vector>

// The selection of an arm's program: what it needs, how it is verified, what its refusal means.

namespace ACS::Acsd::Test
{

TEST_CASE("A selection that is refused for the program counter is repeated once after set_cur_pc_idx")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    static_cast<void>(arm.TakeRequests());
    const std::string body = GENERATE(R"({"err_code":-1245280})", R"({"err_code":"-1245280"})");
    const bool bLate = GENERATE(false, true);
    if (bLate)
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        static_cast<void>(arm.TakeRequests());
        arm.Deliver(OpenStream::ClientControlFault{403, Core::JsonText::FromTrusted(body), "late"});
    }
    else
    {
        arm.RefuseWith(403, body);
    }
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{REWIND});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{SELECT});
    SECTION("Then it is accepted")
    {
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.ShowVerification();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("It is refused again: the job fails")
    {
        arm.RefuseWith(403, body);
        REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
        arm.DeliverData(MOTOR_ON_SAMPLE);
        const auto failed = arm.TakeEvents<Planning::JobFailed>();
        REQUIRE(failed.size() == 1);
        CHECK(failed.front().reason.find("-1245280") != std::string::npos);
    }
}

TEST_CASE("A selection is started when the controller shows it, however slow it is")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
    arm.AcknowledgeMonitor();
    arm.DeliverData("[5,5,0]"); // of the MONITOR before
    arm.DeliverData(R"({"is_playback":0,"cur_prog_no":12,"cur_step_no":0})");
    arm.DeliverData(R"({"is_playback":0,"cur_prog_no":11,"cur_step_no":7})");
    CHECK(arm.TakeRequests().empty());
    SECTION("It is shown")
    {
        arm.DeliverData(SELECTED);
        arm.ShowVerification();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("It is not shown, nor refused")
    {
        arm.Fire(ArmFixture::EFFECT_TIMER);
        arm.ShowVerification();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The controller does not show its general state")
    {
        arm.RefuseMonitor("/project/rgen");
        arm.ShowVerification();
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("The connection is lost")
    {
        arm.Deliver(OpenStream::ClientLost{});
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
        arm.BringUp();
        CHECK(arm.TakeRequests().empty());
    }
}

TEST_CASE("A controller that never shows what it has selected is not waited for again and again")
{
    ArmFixture arm;
    arm.BringUp();
    for (int job = 0; job < 3; ++job)
    {
        arm.Command("J");
        static_cast<void>(arm.TakeRequests());
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
        arm.Fire(ArmFixture::EFFECT_TIMER);
        REQUIRE(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
        arm.Deliver(OpenStream::ClientControlFault{403, std::nullopt, "late"});
        arm.AcknowledgeMonitor();
        arm.DeliverData("[5,5,0]");
    }
    arm.Command("J");
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
}

TEST_CASE("A selection that abandoned another program does not fail this job: it is commanded again")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.Command("J");
    arm.Accept("[5,5,1]"); // a program that was stopped in the middle
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::StateChanged>().back().restartEvidence.progressToken == "5 5 1");
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.Command("J");
    arm.Accept("[5,5,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("After a start the program counter is set before the next selection, which shows whether that was needed")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    arm.Accept("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    arm.Command("K");
    REQUIRE(arm.TakeRequests() == std::vector<std::string>{REWIND});
    SECTION("The controller takes it, or does not know it")
    {
        const bool bTaken = GENERATE(false, true);
        arm.Settle(bTaken ? OpenStream::EControlOutcome::Accepted : OpenStream::EControlOutcome::Refused, 404);
        CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
        CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    }
    SECTION("The job is cancelled meanwhile: nothing is selected")
    {
        arm.adapter.Handle(Planning::CancelJob{"K"}, arm.clock.GetNow(), arm.actions);
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        CHECK(arm.TakeRequests().empty());
    }
}

TEST_CASE("A selection's refusal that comes with the start does not fail a job whose program begins")
{
    ArmFixture arm;
    arm.BringUp();
    arm.Command("J");
    arm.Accept();
    static_cast<void>(arm.TakeRequests());
    arm.actions.clear();
    arm.RefuseWith(403, R"({"err_code":-1245280})");
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.IsStartWatched());
    arm.ShowVerification();
    const bool bBegins = GENERATE(false, true);
    if (bBegins)
    {
        arm.DeliverData("[6,5,0]");
    }
    arm.Fire(ArmFixture::START_TIMER);
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty() == bBegins);
}

TEST_CASE("A program that ran after the selection and before the start is not taken for the job's own")
{
    ArmFixture arm;
    arm.BringUp();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Command("J");
    arm.Accept();
    arm.DeliverData("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
}

TEST_CASE("A program that was selected before the connection broke is selected again, and not just started")
{
    ArmFixture arm;
    arm.BringUp();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.Command("J");
    arm.Accept();
    arm.Deliver(OpenStream::ClientLost{});
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    arm.BringUp();
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests().empty());
}

} // namespace ACS::Acsd::Test
