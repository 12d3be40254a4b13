#include "AcsdCoreFixture.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

using namespace std::chrono_literals;

TEST_CASE_METHOD(AcsdCoreFixture, "A stop refuses plans and waits for the Acks of all reports")
{
    Begin(MakeStateWithReport(_clock));
    Register();
    REQUIRE(_reports.size() == 1);

    _core->Stop();
    CHECK(_core->GetNotReadyReasons() == std::vector<std::string>{"acsd draining for shutdown"});
    CHECK(_working == std::vector{false});
    Submit("P1");
    REQUIRE(_answers.size() == 1);
    CHECK(_answers.front().result == Protocol::EAckResult::Fail);
    CHECK(_answers.front().message == "acsd draining for shutdown");
    CHECK(_core->Offer(Planning::ControlTSC{true, 0}) == Planning::EInputAdmission::Closed);
    CHECK(_core->IsStopping());

    Advance(1s);
    CHECK_FALSE(_core->IsClosed());
    Acknowledge("T7");
    CHECK(_ackWaits == std::vector<Core::Duration>{1s});
    Advance(AcsdCore::SETTLE_TIME - 1ms);
    CHECK_FALSE(_core->IsClosed());
    Advance(1ms);
    CHECK(_core->IsClosed());
    CHECK(_closes == 1);
    CHECK(_stops == 0);
    _core->OnLinksClosed();
    CHECK(_stops == 1);
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "A command of the operator that is refused after it has waited for the disk is reported")
{
    Begin();
    BringRobotUp();
    Register();
    Submit("P1");
    _bDiskHangs = true;
    Submit("P2");
    const Planning::CommandReceipt receipt{"lee", "k", "accepted", _clock.GetNow().wall};
    const Planning::ControlPlan
        abort{Planning::EPlanControl::Abort, "P1", {}, 0, {}, Planning::EControlOrigin::Operator};
    CHECK(_core->Offer(abort, receipt) == Planning::EInputAdmission::Accepted);
    CHECK(_core->Offer(Planning::SetMaintenance{"LR01", true, 0}) == Planning::EInputAdmission::Accepted);
    CHECK(_refused.empty());
    FailDisk();
    REQUIRE(_refused.size() == 1);
    CHECK(_refused.front().command == "Abort of plan P1");
    CHECK(_refused.front().receipt == receipt);
    CHECK_FALSE(_refused.front().reason.empty());
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "A stop does not wait for Acks without an MCS, and no longer than the drain timeout with one")
{
    const bool bRegistered = GENERATE(false, true);
    Begin(MakeStateWithReport(_clock));
    if (bRegistered)
    {
        Register();
    }
    const std::chrono::milliseconds limit =
        bRegistered ? _config.operations.drainTimeout : std::chrono::milliseconds(AcsdCore::SETTLE_TIME);
    _core->Stop();
    Advance(limit - 1ms);
    CHECK(_closes == 0);
    Advance(1ms);
    CHECK(_closes == 1);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A stop that loses the MCS waits no longer for Acks")
{
    Begin(MakeStateWithReport(_clock));
    Register();
    _core->Stop();
    Advance(1s);
    REQUIRE_FALSE(_core->IsClosed());
    _bRegistered = false;
    _core->OnSessionEvent(Protocol::LinkLost{"reset", true});
    Advance(AcsdCore::SETTLE_TIME - 1ms);
    CHECK_FALSE(_core->IsClosed());
    Advance(1ms);
    CHECK(_core->IsClosed());
}

TEST_CASE_METHOD(AcsdCoreFixture, "A transaction that ends after the stop has no effect")
{
    Begin();
    Register();
    _bDiskHangs = true;
    Submit("P1");
    _core->Stop();
    Advance(_config.operations.drainTimeout + AcsdCore::STOP_LIMIT);
    REQUIRE(_stops == 1);
    const std::size_t commits = _commits;
    _bDiskHangs = false;
    ServeDisk();
    CHECK(_commits == commits);
    CHECK(_answers.empty());
    CHECK(_closes == 0);
    CHECK(_stops == 1);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A stop completes the transaction under way before it closes the links")
{
    Begin();
    Register();
    _bDiskHangs = true;
    Submit("P1");
    _core->Stop();
    Advance(_config.operations.drainTimeout);
    CHECK(_core->IsClosed());
    CHECK(_closes == 0);
    CHECK(_answers.empty());

    _bDiskHangs = false;
    ServeDisk();
    REQUIRE(_answers.size() == 1);
    CHECK(_answers.front().result == Protocol::EAckResult::Success);
    CHECK(_closes == 1);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A stop ends once, also if the links do not close in time")
{
    Begin();
    _core->Stop();
    Advance(AcsdCore::SETTLE_TIME);
    REQUIRE(_closes == 1);
    Advance(AcsdCore::STOP_LIMIT - 1ms);
    CHECK(_stops == 0);
    Advance(1ms);
    CHECK(_stops == 1);
    _core->OnLinksClosed();
    Advance(1h);
    CHECK(_stops == 1);
}

} // namespace ACS::Acsd::Test
