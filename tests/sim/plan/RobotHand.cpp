#include "RobotHand.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

RobotHand::RobotHand(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler)
    : _timeline(timeline),
      _radio(radio),
      _handler(std::move(handler)),
      _timers(timeline),
      _adapter(number, [this](const RobotMessage& message) { _radio.Send(message); })
{
    _radio.Attach(*this);
}

RobotHand::~RobotHand()
{
    _radio.Detach();
}

template <typename TCall>
void RobotHand::Call(TCall call)
{
    Planning::AdapterActions wanted;
    call(_timeline.GetNow(), wanted);
    std::ranges::move(wanted, std::back_inserter(_actions));
    if (std::exchange(_bExecuting, true))
    {
        return;
    }
    while (!_actions.empty())
    {
        const Planning::AdapterAction action = std::move(_actions.front());
        _actions.pop_front();
        Execute(action);
    }
    _bExecuting = false;
}

void RobotHand::Execute(const Planning::AdapterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::RaiseEvent& raise) { _handler(raise.event); },
            [this](const Planning::StartAdapterTimer& start) {
                const Planning::AdapterTimerID timer = start.timer;
                _timers.Start(timer, start.delay, [this, timer] {
                    Call([this, timer](Core::Now now, auto& out) { _adapter.OnTimer(timer, now, out); });
                });
            },
            [this](const Planning::CancelAdapterTimer& cancel) {
                _timers.Cancel(cancel.timer);
            }},
        action);
}

void RobotHand::Handle(const Planning::RobotCommand& command)
{
    Call([this, &command](Core::Now now, auto& out) { _adapter.Handle(command, now, out); });
}

void RobotHand::OnRadioUp()
{
    Call([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkUp(out); });
}

void RobotHand::OnRadioDown()
{
    Call([this](Core::Now /*now*/, auto& out) { _adapter.OnLinkDown(out); });
}

void RobotHand::OnSnapshot(const RobotSnapshot& snapshot)
{
    Call([this, &snapshot](Core::Now /*now*/, auto& out) { _adapter.OnSnapshot(snapshot, out); });
}

} // namespace ACS::Simulation
