#include "robots/ArmInputFixture.hpp"

#include <string>
#include <vector>

// The number of its job that an arm's program echoes.

namespace ACS::Acsd::Test
{

TEST_CASE("Counters that change under another job's number are no evidence: after two samples the outcome is unknown")
{
    ArmInputFixture arm;
    arm.StartWithInputs();
    arm.DeliverData("[6,5,0,11,17]");
    CHECK(arm.TakeEvents<Planning::JobStarted>().empty());
    SECTION("The words of one sample were of two moments")
    {
        arm.DeliverData(BEGUN);
        CHECK(arm.TakeEvents<Planning::JobStarted>().size() == 1);
        CHECK(arm.TakeEvents<Planning::JobUnresolved>().empty());
    }
    SECTION("It was another program")
    {
        arm.DeliverData("[6,6,0,11,17]");
        const auto uncertain = arm.TakeEvents<Planning::JobUnresolved>();
        REQUIRE(uncertain.size() == 1);
        CHECK(uncertain.front().reason.find("4711") != std::string::npos);
        CHECK(uncertain.front().reason.find("17") != std::string::npos);
    }
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("A job whose number is unknown, from before an update, counts any change for its own")
{
    ArmInputFixture arm([](const Planning::StartJob&) { return std::vector<ArmInput>{}; });
    arm.Command(ArmInputFixture::MakeJob(0));
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowVerification(BEFORE);
    arm.Accept(BEFORE);
    arm.DeliverData("[6,6,0,11,17]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("A program that gets no number of its job cannot echo one: any change counts for it")
{
    ArmInputFixture arm([](const Planning::StartJob&) { return std::vector<ArmInput>{{*ParseArmRelay("ml105"), 3}}; });
    SECTION("Of a job that was commanded before a restart")
    {
        arm.DeliverData("[6,5,0,11,17]");
        arm.adapter.Handle(Planning::RecoverJob{ArmInputFixture::MakeJob(), {}}, arm.clock.GetNow(), arm.actions);
    }
    SECTION("Of another one")
    {
        arm.Command(ArmInputFixture::MakeJob());
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        static_cast<void>(arm.TakeRequests());
        arm.ShowEffect(SELECTED);
        arm.ShowVerification(BEFORE);
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.AcknowledgeMonitor();
        static_cast<void>(arm.TakeRequests());
        arm.DeliverData("[3]");
        arm.ShowVerification(BEFORE);
        arm.Settle(OpenStream::EControlOutcome::Accepted);
    }
    arm.DeliverData("[6,6,0,11,17]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("After a restart the echo shows whether the program that ran was this job's")
{
    ArmFixture arm(ArmOptions{}, ResolveInputs);
    arm.adapter.Handle(Planning::RecoverJob{ArmInputFixture::MakeJob(), {}}, arm.clock.GetNow(), arm.actions);
    SECTION("It was, and has finished")
    {
        arm.BringUp("[5,5,0,0,4711]");
        arm.DeliverData(DONE);
        CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
    }
    SECTION("Another one ran")
    {
        arm.Deliver(OpenStream::ClientReady{});
        arm.DeliverData(MOTOR_ON_SAMPLE);
        arm.DeliverData("[6,6,0,11,17]");
        CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
        REQUIRE(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
        CHECK(arm.TakeEvents<Planning::JobUnresolved>().front().reason.find("4711") != std::string::npos);
    }
    SECTION("It echoed its number and raised no counter: it is not commanded again")
    {
        arm.BringUp("[5,5,0,0,4711]");
        arm.Fire(ArmFixture::START_TIMER);
        CHECK(arm.TakeEvents<Planning::JobUnknown>().empty());
        CHECK(arm.TakeEvents<Planning::JobUnresolved>().size() == 1);
    }
    SECTION("It was not started")
    {
        arm.BringUp(BEFORE);
        arm.Fire(ArmFixture::START_TIMER);
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    }
    for (const std::string& request : arm.TakeRequests())
    {
        CHECK(request != START);
        CHECK(request != SELECT);
    }
}

} // namespace ACS::Acsd::Test
