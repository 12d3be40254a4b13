#include "robots/ArmInputFixture.hpp"

#include <string>
#include <string_view>
#include <vector>

// The inputs of an arm's program.

namespace ACS::Acsd::Test
{

TEST_CASE("Inputs are written after the selection, read back, and only then the program is started")
{
    ArmInputFixture arm;
    arm.StartWithInputs();
    arm.DeliverData(BEGUN);
    CHECK(arm.TakeEvents<Planning::JobStarted>().size() == 1);
    arm.DeliverData(DONE);
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("Inputs that read back late are waited for; those of before the writing are not taken for them")
{
    ArmInputFixture arm;
    arm.SelectWithInputs();
    arm.WriteAll();
    arm.DeliverData("[4711,0]");
    arm.DeliverData("[17,1]");
    arm.DeliverData("[4711]");
    arm.DeliverData(R"({"val":0})");
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData("[4711,1]");
    arm.ShowVerification(BEFORE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("Samples that were on their way before the inputs are read are still those of the counters")
{
    ArmInputFixture arm([](const Planning::StartJob&) {
        return std::vector<ArmInput>{{*ParseArmRelay("ml105"), 5}, {*ParseArmRelay("ml106"), 5}};
    });
    arm.SelectWithInputs();
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    static_cast<void>(arm.TakeRequests());
    arm.DeliverData(BEFORE); // [5,5,…], before the MONITOR of the inputs was taken
    CHECK(arm.TakeRequests().empty());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[5,5]");
    arm.ShowVerification(BEFORE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("Samples of the inputs that come after the counters are asked for again are not taken for the counters")
{
    ArmInputFixture arm([](const Planning::StartJob& job) {
        std::vector<ArmInput> inputs{{*ParseArmRelay("ml105"), job.jobNumber}};
        for (const char* const relay : {"ml106", "ml107", "ml108", "ml109"})
        {
            inputs.push_back({*ParseArmRelay(relay), 1});
        }
        return inputs;
    });
    arm.WriteInputs(5);
    arm.DeliverData("[4711,1,1,1,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    for (int late = 0; late < 3; ++late)
    {
        arm.DeliverData("[4711,1,1,1,1]");
        arm.AcknowledgeMonitor(1);
    }
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobUnknown>().empty());
    arm.AcknowledgeMonitor();
    arm.DeliverData(BEFORE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowVerification(BEFORE);
    arm.DeliverData(BEGUN);
    arm.DeliverData(DONE);
    CHECK(arm.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
}

TEST_CASE(
    "Inputs that differ are written again, and then the job fails with relay, written and read; nothing was started")
{
    ArmInputFixture arm;
    arm.WriteInputs();
    for (int retry = 0; retry < 2; ++retry)
    {
        arm.DeliverData("[4711,2]");
        arm.Fire(ArmFixture::INPUT_TIMER);
        CHECK(arm.TakeRequests() == std::vector<std::string>{WRITE_NUMBER, MONITOR_COUNTERS});
        static_cast<void>(arm.TakeRequests());
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(arm.TakeRequests() == std::vector<std::string>{WRITE_AREA, MONITOR_COUNTERS});
        arm.AcknowledgeMonitor();
    }
    arm.DeliverData("[4711,2]");
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    arm.Fire(ArmFixture::INPUT_TIMER);
    CHECK(arm.TakeFailure().find("relay ml106 was written as 1 and reads 2") != std::string::npos);
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.Fire(ArmFixture::INPUT_TIMER);
    CHECK(arm.TakeRequests().empty());
    arm.DeliverData(BEFORE);
    CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
}

TEST_CASE("Relays that the controller refuses or does not show fail the job; nothing was started")
{
    ArmInputFixture arm;
    SECTION("It refuses to write one")
    {
        arm.SelectWithInputs();
        static_cast<void>(arm.TakeRequests());
        arm.Settle(OpenStream::EControlOutcome::Refused, 400);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_MOTOR});
        arm.DeliverData(MOTOR_ON_SAMPLE);
        const std::string reason = arm.TakeFailure();
        CHECK(reason.find("ml105") != std::string::npos);
        CHECK(reason.find("400") != std::string::npos);
    }
    SECTION("It refuses to show them")
    {
        arm.WriteInputs();
        arm.RefuseMonitor("/project/plc/m/val_s32");
        CHECK(arm.TakeFailure().find("/project/plc/m/val_s32") != std::string::npos);
        CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    }
    SECTION("It shows nothing")
    {
        arm.WriteInputs();
        for (int retry = 0; retry < 3; ++retry)
        {
            arm.Fire(ArmFixture::INPUT_TIMER);
            arm.Settle(OpenStream::EControlOutcome::Accepted);
            arm.Settle(OpenStream::EControlOutcome::Accepted);
        }
        CHECK(arm.TakeFailure().find("not shown") != std::string::npos);
    }
    const std::vector<std::string> requests = arm.TakeRequests();
    CHECK(std::ranges::find(requests, START) == requests.end());
}

TEST_CASE("Inputs of several areas are read one after the other, and all again until they are right")
{
    ArmInputFixture arm([](const Planning::StartJob&) {
        return std::vector<ArmInput>{{*ParseArmRelay("do3"), 1}, {*ParseArmRelay("ml105"), 7}};
    });
    arm.SelectWithInputs();
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    static_cast<void>(arm.TakeRequests());
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    CHECK(arm.TakeRequests() == std::vector<std::string>{READ_OUTPUTS});
    arm.AcknowledgeMonitor();
    arm.DeliverData("[8]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.DeliverData("[8]"); // of the range before
    CHECK(arm.TakeRequests().empty());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[6]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{READ_OUTPUTS});
    arm.AcknowledgeMonitor();
    arm.DeliverData("[8]");
    arm.AcknowledgeMonitor();
    static_cast<void>(arm.TakeRequests());
    arm.DeliverData("[7]");
    arm.ShowVerification(BEFORE);
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
}

TEST_CASE("Late samples of one range of inputs are not taken for the next one, nor its acknowledgement for another")
{
    ArmInputFixture arm([](const Planning::StartJob& job) {
        return std::vector<ArmInput>{
            {*ParseArmRelay("ml105"), job.jobNumber},
            {*ParseArmRelay("ml110"), 1},
            {*ParseArmRelay("ml2000"), job.jobNumber},
            {*ParseArmRelay("ml2005"), 2}};
    });
    arm.WriteInputs(4);
    arm.DeliverData("[4711,0,0,0,0,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS}); // of the second range
    for (int late = 0; late < 2; ++late)
    {
        arm.DeliverData("[4711,0,0,0,0,1]");
        arm.AcknowledgeMonitor(1);
    }
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobUnknown>().empty());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[4711,0,0,0,0,3]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS}); // of the first range again
    arm.AcknowledgeMonitor();
    arm.DeliverData("[4711,0,0,0,0,1]");
    static_cast<void>(arm.TakeRequests());
    arm.AcknowledgeMonitor();
    arm.DeliverData("[4711,0,0,0,0,2]");
    arm.ShowVerification(BEFORE); // no range again
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    CHECK(arm.TakeEvents<Planning::JobUnknown>().empty());
}

TEST_CASE("A program that was run after the inputs were read back is not taken for the job's: nothing is started")
{
    const bool bEcho = GENERATE(false, true);
    ArmInputFixture arm(
        [](const Planning::StartJob& job) {
            return std::vector<ArmInput>{{*ParseArmRelay("ml105"), job.jobNumber}, {*ParseArmRelay("ml106"), 1}};
        },
        bEcho ? ArmOptions{} : MakeArmOptions());
    arm.WriteInputs();
    arm.DeliverData("[4711,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.AcknowledgeMonitor();
    const std::string_view counters = GENERATE(
        std::string_view("[6,5,0,11,17]"),
        std::string_view("[6,6,0,11,17]"),
        std::string_view("[6,5,1,11,17]"),
        std::string_view("[0,0,0,0,0]"));
    arm.DeliverData(counters);
    CHECK(arm.TakeRequests().empty());
    CHECK(arm.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    CHECK(arm.TakeEvents<Planning::JobStarted>().empty());
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
    CHECK(arm.TakeEvents<Planning::JobFailed>().empty());
    CHECK(arm.TakeEvents<Planning::JobUnresolved>().empty());
}

TEST_CASE("A job that was sent again has the counters of after the program that another one ran for its own base")
{
    ArmInputFixture arm(ResolveInputs, MakeArmOptions());
    arm.WriteInputs();
    arm.DeliverData("[4711,1]");
    arm.ShowVerification("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    Planning::StartJob again = ArmInputFixture::MakeJob();
    again.progressToken = "6 6 0";
    arm.Command(again);
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowVerification("[6,6,0]");
    arm.WriteAll();
    arm.DeliverData("[4711,1]");
    arm.ShowVerification("[6,6,0]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowVerification("[6,6,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().empty());
    arm.DeliverData("[7,7,0]");
    CHECK(arm.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("Between the inputs and the start a pause, a cancellation and a loss are as before it")
{
    ArmInputFixture arm;
    arm.WriteInputs();
    arm.DeliverData("[4711,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    SECTION("Paused: the program is selected again after it, and the inputs are written again")
    {
        arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
        arm.AcknowledgeMonitor();
        arm.DeliverData(BEFORE);
        CHECK(arm.TakeRequests().empty());
        arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
        arm.Settle(OpenStream::EControlOutcome::Accepted);
        arm.ShowVerification(BEFORE);
        arm.WriteAll();
        arm.DeliverData("[4711,1]");
        arm.ShowVerification(BEFORE);
        CHECK(arm.TakeRequests() == std::vector<std::string>{START});
    }
    SECTION("Cancelled")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        arm.AcknowledgeMonitor();
        arm.DeliverData(BEFORE);
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("Lost")
    {
        arm.Deliver(OpenStream::ClientLost{});
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("A refusal of the selection that came late")
    {
        arm.Deliver(OpenStream::ClientControlFault{403, Core::JsonText::FromTrusted(R"({"err_code":-1245280})"), ""});
        CHECK(arm.TakeRequests() == std::vector<std::string>{REWIND});
    }
}

TEST_CASE("Inputs that cannot be derived from the job, or do not fit into their relay, fail it before anything is sent")
{
    SECTION("They cannot be derived")
    {
        ArmInputFixture arm;
        Planning::StartJob job = ArmInputFixture::MakeJob();
        job.from.reset();
        arm.Command(job);
        CHECK(arm.TakeFailure().find("{from.area}") != std::string::npos);
        CHECK(arm.TakeRequests().empty());
    }
    SECTION("One does not fit")
    {
        ArmInputFixture arm([](const Planning::StartJob&) {
            return std::vector<ArmInput>{{*ParseArmRelay("mb5"), 300}};
        });
        arm.Command(ArmInputFixture::MakeJob());
        CHECK(arm.TakeFailure().find("mb5") != std::string::npos);
        CHECK(arm.TakeRequests().empty());
    }
}

TEST_CASE("A pause while inputs are written holds the start; they are written again after it")
{
    ArmInputFixture arm;
    arm.WriteInputs();
    arm.adapter.Handle(Planning::Pause{}, arm.clock.GetNow(), arm.actions);
    arm.DeliverData("[4711,1]");
    CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
    arm.AcknowledgeMonitor();
    arm.DeliverData(BEFORE);
    CHECK(arm.TakeRequests().empty());
    arm.adapter.Handle(Planning::Resume{}, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeRequests() == std::vector<std::string>{SELECT});
    arm.Settle(OpenStream::EControlOutcome::Accepted);
    arm.ShowVerification(BEFORE);
    arm.WriteAll();
    arm.DeliverData("[4711,9]");
    CHECK(arm.TakeRequests().empty());
    arm.Fire(ArmFixture::INPUT_TIMER);
    CHECK(arm.TakeRequests().front() == WRITE_NUMBER);
}

TEST_CASE("A job that is cancelled, or whose connection is lost, while its inputs are written was not started")
{
    ArmInputFixture arm;
    const bool bRead = GENERATE(false, true);
    if (bRead)
    {
        arm.WriteInputs();
    }
    else
    {
        arm.SelectWithInputs();
        static_cast<void>(arm.TakeRequests());
    }
    SECTION("Cancelled")
    {
        arm.adapter.Handle(Planning::CancelJob{"J"}, arm.clock.GetNow(), arm.actions);
        CHECK(arm.TakeEvents<Planning::JobFailed>().size() == 1);
        if (bRead)
        {
            CHECK(arm.TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
        }
        arm.Settle(OpenStream::EControlOutcome::Accepted);
    }
    SECTION("Lost")
    {
        arm.Deliver(OpenStream::ClientLost{});
        CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    }
    SECTION("A program was run at the controller")
    {
        if (!bRead)
        {
            arm.DeliverData("[6,5,0,0,17]");
            CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
        }
    }
    for (const std::string& request : arm.TakeRequests())
    {
        CHECK(request != START);
    }
}

} // namespace ACS::Acsd::Test
