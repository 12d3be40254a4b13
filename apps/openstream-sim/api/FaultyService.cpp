#include "api/FaultyService.hpp"

#include <optional>
#include <utility>

namespace ACS::OpenStreamSim
{

FaultyService::FaultyService(VirtualController& controller, ControllerFaults& faults, EFaultSide side)
    : _controller(controller),
      _faults(faults),
      _side(side)
{
}

void FaultyService::Call(const OpenStream::ApiRequest& request, Core::Now now, OpenStream::ApiResponse& response)
{
    _faults.Advance(now);
    const bool bStream = _side == EFaultSide::Stream;
    const bool bSample = bStream && request.method == OpenStream::EApiMethod::Get;
    std::optional<OpenStream::ApiResponse> refusal =
        bStream && !bSample ? _faults.UseRefusalOrNull() : std::optional<OpenStream::ApiResponse>();
    if (refusal.has_value())
    {
        response = std::move(*refusal);
    }
    else
    {
        _controller.Call(request, now, response);
        _faults.ScheduleWakeUp();
    }
    response.delay = _faults.GetDelay(_side);
    response.bNoSample = bSample && _faults.IsSilent();
}

void FaultyService::StopControl(Core::Now now)
{
    _faults.Advance(now);
    _controller.StopControl(now);
    _faults.ScheduleWakeUp();
}

} // namespace ACS::OpenStreamSim
