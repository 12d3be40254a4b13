#include "StateSchedule.hpp"

#include <utility>

namespace ACS::VDA5050
{

StateSchedule::StateSchedule(const VehicleOptions& options)
    : _options(options)
{
}

void StateSchedule::OnLinkUp()
{
    _bLinkUp = true;
    Request();
}

void StateSchedule::OnLinkDown(VehicleActions& out)
{
    _bLinkUp = false;
    OnMinimumTimer();
    for (const EVehicleTimer timer :
         {EVehicleTimer::MinimumStateInterval, EVehicleTimer::MaximumStateInterval, EVehicleTimer::Visualization})
    {
        out.emplace_back(CancelVehicleTimer{timer});
    }
}

void StateSchedule::OnMinimumTimer()
{
    if (_due == EDue::WhenTimerEnds)
    {
        _due = EDue::Yes;
    }
}

void StateSchedule::Request()
{
    if (_due == EDue::No)
    {
        _due = EDue::Yes;
    }
}

bool StateSchedule::ShouldPublish(Core::Now now, VehicleActions& out)
{
    if (_due == EDue::No || !_bLinkUp)
    {
        return false;
    }
    const Core::SteadyTime earliest =
        _lastStateTime.has_value() ? *_lastStateTime + _options.minimumStateInterval : now.steady;
    if (now.steady >= earliest)
    {
        return true;
    }
    if (std::exchange(_due, EDue::WhenTimerEnds) != EDue::WhenTimerEnds)
    {
        out.emplace_back(StartVehicleTimer{EVehicleTimer::MinimumStateInterval, earliest - now.steady});
    }
    return false;
}

void StateSchedule::OnPublished(Core::Now now, VehicleActions& out)
{
    if (std::exchange(_due, EDue::No) == EDue::WhenTimerEnds)
    {
        out.emplace_back(CancelVehicleTimer{EVehicleTimer::MinimumStateInterval});
    }
    _lastStateTime = now.steady;
    out.emplace_back(StartVehicleTimer{EVehicleTimer::MaximumStateInterval, _options.maximumStateInterval});
}

bool StateSchedule::IsLinkUp() const noexcept
{
    return _bLinkUp;
}

} // namespace ACS::VDA5050
