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

} // namespace ACS::Acsd::Test
