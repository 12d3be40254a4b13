#include "Catch.hpp"
#include "fixtures/HostTest.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <chrono>

// Timers that expire while the disk works.

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;

namespace
{

EngineOptions MakeJobTimeoutOptions()
{
    EngineOptions options = MakeTestOptions(false);
    options.actions["TrayLoad"].timeout = 1min;
    return options;
}

class JobTimeoutHostTest : public HostTest
{
protected:
    JobTimeoutHostTest()
        : HostTest(MakeJobTimeoutOptions())
    {
    }
};

} // namespace

TEST_CASE_METHOD(HostTest, "Plans that arrive without end do not keep the dispatch from the plans before them")
{
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    _host.Push(RobotInput{"LR01", state});
    REQUIRE(TryStoreAll());
    Submit("P1", 1);
    Submit("P2", 2);
    _host.OnStored({}); // now P2 is being stored
    _host.Push(EngineTimer{EEngineTimer::Dispatch, {}});
    Submit("P3", 3);
    _host.OnStored({});
    CHECK(ListAdded(_batches.back()).empty()); // the assignment of P1
    REQUIRE(TryStoreAll());
    CHECK(_engine.GetRobotStatuses().front().planID == "P1");
}

TEST_CASE_METHOD(
    JobTimeoutHostTest,
    "A timer that expired while the disk worked has no effect once an input before it has cancelled or restarted it")
{
    StateChanged state;
    state.lastNodeID = "D-A01.CP01"; // where the plan begins
    _host.Push(SubmitPlan{MakeControlPlan("P1"), 1});
    _host.Push(RobotInput{"CR01", LinkChanged{true}});
    _host.Push(RobotInput{"CR01", state});
    REQUIRE(TryStoreAll());
    _host.Push(EngineTimer{EEngineTimer::Dispatch, {}});
    REQUIRE(TryStoreAll());
    REQUIRE(_jobs.size() == 1);
    const EngineTimer timeout{EEngineTimer::JobTimeout, "CR01"};
    REQUIRE(std::ranges::count(_timers, timeout) == 1);
    _host.Push(PlanCommand(SetMaintenance{"LR01", true, 2}));
    REQUIRE(_host.IsStoring());
    _host.Push(RobotInput{"CR01", JobFinished{"P1-cd"}});
    _host.Push(timeout);
    REQUIRE(TryStoreAll());
    CHECK(_jobs.size() == 2);
    CHECK(_engine.GetPlanOrNull("P1")->state == EPlanState::InProgress);
    _host.Push(timeout); // of the second job
    REQUIRE(TryStoreAll());
    CHECK(_engine.GetPlanOrNull("P1")->state == EPlanState::Failed);
}

} // namespace ACS::Testing
