#include "AcsdCore.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

using namespace std::chrono_literals;

namespace
{

AcsdConfig MakeCoreConfig()
{
    AcsdConfig config;
    config.engine = Testing::MakeTestOptions(false);
    config.site = Testing::MakeTestSite();
    config.localOffset = Apps::LocalOffset(0min);
    return config;
}

/// AcsdCore in virtual time with a disk, links and an MCS that the test controls.
class AcsdCoreFixture : private IAcsdOutput, private IMcsOutput
{
    std::map<AcsdTimer, Core::SteadyTime> _timers;
    std::optional<Planning::StoreBatch> _batch; ///< Waits for the disk.

protected:
    AcsdConfig _config = MakeCoreConfig();
    Testing::ManualClock _clock;
    Testing::SeededRandom _random{1};
    bool _bDiskHangs = false;
    bool _bRegistered = false;
    std::vector<Protocol::AcsRequest> _reports;
    std::vector<bool> _working;         ///< Values of isConnected, in order.
    std::vector<std::string> _statuses; ///< Robots whose state was sent, in order.
    std::vector<Protocol::AcsAck> _answers;
    std::vector<Core::Duration> _ackWaits;
    std::size_t _commits = 0;
    std::size_t _checks = 0;
    std::size_t _closes = 0;
    std::size_t _stops = 0;
    std::size_t _takenStores = 0;
    AcsdCore::ActionFilter _filter;
    std::optional<AcsdCore> _core;

    void Begin(Planning::StoredState state = {})
    {
        _core.emplace(AcsdCore::Dependencies{_clock, _random, {}, *this, *this, _filter}, _config);
        _core->Restore(std::move(state));
        _core->Start();
        ServeDisk();
    }

    /// The outcomes of all transactions that are under way or follow from them.
    void ServeDisk()
    {
        while (!_bDiskHangs && _batch.has_value())
        {
            _batch.reset();
            _core->OnStored({});
        }
    }

    /// Lets the time pass, with every timer at its time.
    void Advance(std::chrono::milliseconds span)
    {
        const Core::SteadyTime end = _clock.GetNow().steady + span;
        while (!_timers.empty())
        {
            const auto next = std::ranges::min_element(_timers, {}, [](const auto& entry) { return entry.second; });
            if (next->second > end)
            {
                break;
            }
            const AcsdTimer timer = next->first;
            _clock.Advance(
                std::chrono::duration_cast<std::chrono::milliseconds>(next->second - _clock.GetNow().steady));
            _timers.erase(next);
            _core->OnTimer(timer);
            ServeDisk();
        }
        _clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(end - _clock.GetNow().steady));
    }

    void Register()
    {
        _bRegistered = true;
        _core->OnSessionEvent(Protocol::Registered{});
    }

    void Submit(const std::string& planID)
    {
        Protocol::ExecutionPlan plan;
        plan.planID = planID;
        plan.steps = {{1, "CassetteLoad", "A01.CP01", {}, {{"J", "A01.CP01", "AMR.CP01"}}}};
        _core->OnSessionEvent(Protocol::RequestReceived{{"T-" + planID, {}, std::move(plan)}, false});
        ServeDisk();
    }

    void BringRobotUp()
    {
        _core->OnRobotEvent("LR01", Planning::LinkChanged{true});
        Planning::StateChanged state;
        state.lastNodeID = "D-CHG01";
        _core->OnRobotEvent("LR01", state);
        ServeDisk();
    }

    /// A report that is stored and that the MCS has not acknowledged.
    [[nodiscard]] static Planning::StoredState MakeStateWithReport(const Core::IClock& clock)
    {
        Planning::StoredState state;
        state.outbox.push_back(
            {7, "T7", clock.GetNow().wall, Planning::PlanReport{"P0", Planning::EPlanState::Completed, {}}});
        state.lastReportSequence = 7;
        return state;
    }

    void Acknowledge(const std::string& transactionID)
    {
        _core->OnSessionEvent(
            Protocol::Acked{Protocol::EAcsCommand::PlanReport, transactionID, Protocol::EAckResult::Success, {}});
        ServeDisk();
    }

private:
    void Store(const Planning::StoreBatch& batch) override
    {
        _batch = batch;
    }

    void CheckStore() override
    {
        ++_checks;
    }

    void CommandRobot(const Planning::CommandRobot& /*command*/) override
    {
    }

    void StartTimer(const AcsdTimer& timer, Core::Duration delay) override
    {
        _timers[timer] = _clock.GetNow().steady + delay;
    }

    void CancelTimer(const AcsdTimer& timer) override
    {
        _timers.erase(timer);
    }

    void CancelTimers() override
    {
        _timers.clear();
    }

    void CloseLinks() override
    {
        ++_closes;
    }

    void OnStopped() override
    {
        ++_stops;
    }

    void OnStoreTaken(const std::string& /*reason*/) override
    {
        ++_takenStores;
    }

    void ObserveCommit(Core::Duration /*duration*/) override
    {
        ++_commits;
    }

    void ObserveAckWait(Core::Duration wait) override
    {
        _ackWaits.push_back(wait);
    }

    [[nodiscard]] bool IsRegistered() const override
    {
        return _bRegistered;
    }

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override
    {
        _reports.push_back(request);
        return true;
    }

    void ReplayDone() override
    {
    }

    void SendStatus(const Protocol::AcsPayload& status) override
    {
        if (const auto* const commOrNull = std::get_if<Protocol::AcsCommStateUpdate>(&status))
        {
            _working.push_back(commOrNull->bConnected);
        }
        if (const auto* const robotOrNull = std::get_if<Protocol::RobotStatusUpdate>(&status))
        {
            _statuses.push_back(robotOrNull->robotID);
        }
    }

    void SendPosition(const Protocol::RobotPositionUpdate& /*positions*/) override
    {
    }

    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override
    {
        _answers.push_back({command, std::string(transactionID), {}, result, std::string(message), payload, false});
    }

    void SetSiteOffset(std::chrono::minutes /*offset*/) override
    {
    }
};

} // namespace

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "The inability to accept work is reported after the grace time, and ends with broker and robot")
{
    Begin();
    Advance(_config.operations.workGrace - 1ms);
    CHECK(_working.empty());
    Advance(1ms);
    CHECK(_working == std::vector{false});

    _core->OnMqttUp();
    CHECK(_core->IsMqttUp());
    CHECK(_working == std::vector{false});
    BringRobotUp();
    CHECK(_working == std::vector{false, true});

    _core->OnMqttDown();
    Advance(_config.operations.workGrace - 1ms);
    _core->OnMqttUp();
    Advance(_config.operations.workGrace);
    CHECK(_working == std::vector{false, true, true});
    _core->OnMqttDown();
    Advance(_config.operations.workGrace);
    CHECK(_working.back() == false);
}

TEST_CASE_METHOD(AcsdCoreFixture, "The states of the robots are repeated at the interval of the configuration")
{
    Begin();
    _statuses.clear();
    Advance(1h);
    CHECK(_statuses.empty());

    _config.operations.statusInterval = 5s;
    _core->Reload(_config);
    Advance(10s);
    CHECK(_statuses == std::vector<std::string>{"LR01", "CR01", "LR01", "CR01"});
    _config.operations.statusInterval = 0s;
    _core->Reload(_config);
    Advance(10s);
    CHECK(_statuses.size() == 4);
}

TEST_CASE_METHOD(AcsdCoreFixture, "A plan is acknowledged after it was stored; the commit is measured")
{
    Begin();
    Register();
    const std::size_t before = _commits;
    _bDiskHangs = true;
    Submit("P1");
    CHECK(_answers.empty());
    Advance(1s);
    _bDiskHangs = false;
    ServeDisk();
    REQUIRE(_answers.size() == 1);
    CHECK(_answers.front().result == Protocol::EAckResult::Success);
    CHECK(_commits > before);
    CHECK(_core->GetEngine().GetActivePlans().size() == 1);
}

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
    "4.1 While the disk hangs, plans beyond queue.max_plans are answered with Fail at once")
{
    _config.engine.maximumPlans = 3;
    Begin();
    Register();
    _bDiskHangs = true;
    for (const char* planID : {"P1", "P2", "P3", "P4", "P5", "P6"})
    {
        Submit(planID); // P1 is being stored, three wait
    }
    REQUIRE(_answers.size() == 2);
    CHECK(_answers[0].transactionID == "T-P5");
    CHECK(_answers[0].result == Protocol::EAckResult::Fail);
    CHECK(_answers[0].message == "The ACS has not stored earlier requests yet. Send the request again later.");
    CHECK(_answers[1].transactionID == "T-P6");
    _bDiskHangs = false;
    ServeDisk();
    CHECK(_answers.size() == 6);
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

TEST_CASE_METHOD(AcsdCoreFixture, "A store that hangs or fails is a not-ready reason; an idle store is checked")
{
    Begin();
    Advance(10s);
    CHECK(_checks == 6);

    _core->OnStoreLost({Core::ECoreError::OutOfRange, "acsd.db", "the file", "nothing"});
    CHECK(_core->GetNotReadyReasons().size() == 1);
    CHECK(_core->GetStoreFaultOrNull() == _core->GetNotReadyReasons().front());
    Advance(500ms);
    CHECK(_checks == 6);
    Advance(10s); // the engine has tried to write meanwhile
    CHECK_FALSE(_core->GetStoreFaultOrNull().has_value());
    CHECK(_checks > 6);

    _bDiskHangs = true;
    Register();
    Submit("P1");
    Advance(StoreWatch::LIMIT - 1ms);
    CHECK_FALSE(_core->GetStoreFaultOrNull().has_value());
    const std::size_t checks = _checks;
    Advance(10s);
    CHECK(_core->GetStoreFaultOrNull() == "the store does not answer");
    CHECK(_checks == checks);
    _bDiskHangs = false;
    ServeDisk();
    CHECK(_core->GetNotReadyReasons().empty());
}

TEST_CASE_METHOD(
    AcsdCoreFixture,
    "A log of the store that cannot be merged is an alarm, also while a transaction is under way")
{
    Begin();
    Register();
    _bDiskHangs = true;
    Submit("P1");
    const std::size_t checks = _checks;
    Advance(2s);
    CHECK(_checks > checks); // a store that is always written is checked too
    _core->OnStoreLog({"acsd.db", std::uint64_t{1} << 30U, 0, "another program reads the database"});
    CHECK(_core->GetEngine().GetActiveAlarms().empty());
    _bDiskHangs = false;
    ServeDisk();
    REQUIRE(_core->GetEngine().GetActiveAlarms().size() == 1);
    CHECK(_core->GetEngine().GetActiveAlarms().front().errorCode == "ACS-1021");
    CHECK(_core->GetNotReadyReasons().empty());
}

TEST_CASE_METHOD(AcsdCoreFixture, "acsd ends at once, without further actions, if another program has taken its store")
{
    const Core::Error taken{Planning::EPlanningError::StoreTaken, "store", "a store of this program", "a lock"};
    Begin();
    Register();
    SECTION("A check reports it")
    {
        _core->OnStoreLost(taken);
    }
    SECTION("A transaction reports it")
    {
        _bDiskHangs = true;
        Submit("P1");
        _core->OnStored(tl::unexpected(taken));
    }
    CHECK(_takenStores == 1);
    _core->OnStoreLost(taken);
    Advance(1h);
    CHECK(_takenStores == 1);
    CHECK(_stops == 0);
    CHECK(_answers.empty());
    CHECK(_core->IsClosed());
}

TEST_CASE_METHOD(AcsdCoreFixture, "A filter decides which actions of the engine are executed")
{
    std::size_t replies = 0;
    _filter = [&replies](const Planning::EngineAction& action, const AcsdCore::ActionHandler& execute) {
        if (std::holds_alternative<Planning::ReplyCommand>(action))
        {
            ++replies;
            return;
        }
        execute(action);
    };
    Begin();
    Register();
    Submit("P1");
    CHECK(replies == 1);
    CHECK(_answers.empty());
}

} // namespace ACS::Acsd::Test
