#include "control/TscControl.hpp"

#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Planning
{

TscControl::TscControl(EngineState& engine)
    : _options(engine.options),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _startup(engine.startup),
      _hold(engine.hold)
{
}

void TscControl::SwitchTSC(const ControlTSC& command)
{
    const bool bAuto = _tscState == ETscState::Auto;
    if (command.bPause && bAuto)
    {
        ChangeTSC(ETscState::Pausing);
        FinishTscPause();
    }
    else if (!command.bPause && !bAuto)
    {
        ReleaseHold();
        ChangeTSC(ETscState::Auto);
    }
    _transaction.Reply(command.replyToken, true, fmt::format("The TSC is {}.", GetText(_tscState)));
}

void TscControl::ChangeTSC(ETscState state)
{
    assert(CanChange(_tscState, state));
    const ETscState from = std::exchange(_tscState, state);
    _transaction.Store(TscChanged{state});
    _transaction.RequestDispatch();
    if (GetTscState() == state)
    {
        PublishTscState(from);
    }
}

void TscControl::ReleaseHold()
{
    if (!_hold.IsActive())
    {
        return;
    }
    _hold.Release();
    for (Robot& robot : _fleet)
    {
        if (robot.control.pause.IsResuming())
        {
            _transaction.Command(robot, Resume{});
        }
    }
}

void TscControl::PublishTscState(ETscState from)
{
    _transaction.PublishTscState(_tscState, from);
}

void TscControl::FinishTscPause()
{
    const auto isBusy = [](const Robot& robot) {
        const bool bPlanPaused =
            robot.planOrNull != nullptr && robot.planOrNull->record.progress.state == EPlanState::Paused;
        return !bPlanPaused && (robot.drive.has_value() || robot.job.IsOverdue());
    };
    if (_tscState == ETscState::Pausing && !_plans.IsAnyRunning() && std::ranges::none_of(_fleet, isBusy))
    {
        ChangeTSC(ETscState::Paused);
    }
}

bool TscControl::CanDriveHome() const
{
    return _tscState == ETscState::Auto || (_tscState == ETscState::Pausing && _plans.IsAnyRunning());
}

void TscControl::RestoreTSC(ETscState stored)
{
    _tscState = ETscState::Auto;
    if (_options.bTscStartsPaused || stored != ETscState::Auto)
    {
        _tscState = _plans.IsAnyRunning() ? ETscState::Pausing : ETscState::Paused;
    }
    if (_hold.IsActive())
    {
        _tscState = ETscState::Paused;
    }
    if (_tscState != stored)
    {
        _transaction.Store(TscChanged{_tscState});
    }
}

ETscState TscControl::GetTscState() const noexcept
{
    return IsHeldByStartup() ? ETscState::Paused : _tscState;
}

std::string_view TscControl::GetReason() const noexcept
{
    return IsHeldByStartup() ? std::string_view(StartupBarrier::REASON) : _hold.GetReason();
}

ETscState TscControl::GetState() const noexcept
{
    return _tscState;
}

bool TscControl::IsHeldByStartup() const noexcept
{
    return _startup.IsHoldingWork() && _tscState == ETscState::Auto;
}

} // namespace ACS::Planning
