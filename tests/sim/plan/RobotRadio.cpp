#include "RobotRadio.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

RobotRadio::RobotRadio(Timeline& timeline, MemoryRobot& robot, const ChanceSeed& seed)
    : _timeline(timeline),
      _robot(robot),
      _chance(seed)
{
    _robot.SetListener([this](const RobotSnapshot& snapshot) {
        if (_bUp && _listenerOrNull != nullptr)
        {
            Post(_toListener, [this, snapshot] {
                if (_listenerOrNull != nullptr)
                {
                    _listenerOrNull->OnSnapshot(snapshot);
                }
            });
        }
    });
}

void RobotRadio::Post(Way& way, Timeline::Task task)
{
    const Core::SteadyTime now = _timeline.GetNow().steady;
    way.lastArrival = std::max(way.lastArrival, now + _chance.GetBetween(0ms, _chance.IsHit(100) ? 800ms : 10ms));
    way.underWay.push_back(_timeline.Post(way.lastArrival - now, [&way, task = std::move(task)] {
        way.underWay.pop_front();
        task();
    }));
}

void RobotRadio::Lose(Way& way)
{
    for (std::size_t lost = _chance.GetBetween(0, way.underWay.size()); lost > 0; --lost)
    {
        _timeline.Withdraw(way.underWay.back());
        way.underWay.pop_back();
    }
}

void RobotRadio::Attach(IRadioListener& listener)
{
    _listenerOrNull = &listener;
    _bListenerUp = false;
    NotifyLink(_chance.GetBetween(1ms, 300ms));
}

void RobotRadio::Detach(const IRadioListener& listener)
{
    if (_listenerOrNull != &listener)
    {
        return; // a later process has attached
    }
    _listenerOrNull = nullptr;
    ++_epoch;
    Lose(_toRobot);
    for (const Timeline::Ticket& ticket : std::exchange(_toListener.underWay, {}))
    {
        _timeline.Withdraw(ticket);
    }
}

void RobotRadio::Send(const RobotMessage& message)
{
    if (_bUp)
    {
        Post(_toRobot, [this, message] { _robot.Receive(message); });
    }
}

void RobotRadio::SetUp(bool bUp)
{
    if (std::exchange(_bUp, bUp) == bUp)
    {
        return;
    }
    if (!bUp)
    {
        Lose(_toRobot);
        Lose(_toListener);
    }
    NotifyLink(_chance.GetBetween(1ms, 3s));
}

/// At its own time. An outage that is over by then is reported all the same, because messages were lost.
void RobotRadio::NotifyLink(Core::Duration delay)
{
    _timeline.Post(delay, [this, epoch = ++_epoch] {
        if (epoch != _epoch || _listenerOrNull == nullptr)
        {
            return;
        }
        if (std::exchange(_bListenerUp, false))
        {
            _listenerOrNull->OnRadioDown();
        }
        if (_bUp && _listenerOrNull != nullptr)
        {
            _bListenerUp = true;
            _listenerOrNull->OnRadioUp();
        }
    });
}

bool RobotRadio::IsUp() const noexcept
{
    return _bUp;
}

} // namespace ACS::Simulation
