#pragma once

#include "controller/ControllerFaults.hpp"
#include "controller/VirtualController.hpp"
#include <acs/openstream/IOpenApiService.hpp>

namespace ACS::OpenStreamSim
{

/// The controller with its active faults, for one of its interfaces. Pure. Both outlive it.
class FaultyService final : public OpenStream::IOpenApiService
{
    VirtualController& _controller;
    ControllerFaults& _faults;
    EFaultSide _side;

public:
    /// The side: Stream or Http.
    FaultyService(VirtualController& controller, ControllerFaults& faults, EFaultSide side);

    void Call(const OpenStream::ApiRequest& request, Core::Now now, OpenStream::ApiResponse& response) override;
    void StopControl(Core::Now now) override;
};

} // namespace ACS::OpenStreamSim
