#pragma once

#include "controller/ControllerMachine.hpp"
#include <acs/core/Logger.hpp>
#include <acs/openstream/IOpenApiService.hpp>

#include <optional>

namespace ACS::OpenStreamSim
{

/// A simulated Hi6 controller with its six-axis arm: the Open API over a ControllerMachine, for Open Stream and HTTP. Pure:
/// time is a parameter, and what was due since the last call happens first.
class VirtualController final : public OpenStream::IOpenApiService
{
    ControllerMachine _machine;

public:
    VirtualController(const ControllerOptions& options, Core::Now now, Core::Logger logger);

    void Call(const OpenStream::ApiRequest& request, Core::Now now, OpenStream::ApiResponse& response) override;

    /// Ends a trajectory at the arm's position and empties its buffer; a program continues.
    void StopControl(Core::Now now) override;

    /// Action of the operator: leaves remote mode, which stops the program, or returns to it.
    void TurnModeSwitch(bool bRemote, Core::Now now);

    /// The next event without a call: GetMachine then. Nullopt if there is none.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// The machine, advanced to the present, for direct changes.
    [[nodiscard]] ControllerMachine& GetMachine(Core::Now now);
};

} // namespace ACS::OpenStreamSim
