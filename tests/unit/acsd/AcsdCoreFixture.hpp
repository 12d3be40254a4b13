#pragma once

#include "AcsdCore.hpp"
#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

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

inline AcsdConfig MakeCoreConfig()
{
    AcsdConfig config;
    config.engine = Testing::MakeTestOptions(false);
    config.site = Testing::MakeTestSite();
    config.localOffset = Apps::LocalOffset(std::chrono::minutes(0));
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
    std::vector<RefusedOffer> _refused;
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

    /// The transaction that is under way fails.
    void FailDisk()
    {
        _batch.reset();
        _core->OnStored(
            Core::Fail(make_error_code(Planning::EPlanningError::StoreFailed), "store", "room", "disk full"));
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

    void OnOperatorRefused(const RefusedOffer& refused) override
    {
        _refused.push_back(refused);
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

} // namespace ACS::Acsd::Test
