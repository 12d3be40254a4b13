#pragma once

#include "controller/ControllerMachine.hpp"
#include <acs/core/Logger.hpp>
#include <acs/openstream/IOpenApiService.hpp>

#include <optional>

namespace ACS::OpenStreamSim
{

/// A Hi6 controller with its six-axis arm that exists in memory only: the Open API over a ControllerMachine, for Open
/// Stream and HTTP alike. Pure: the time comes with each call, and what was due since the last one happens first.
class VirtualController final : public OpenStream::IOpenApiService
{
    ControllerMachine _machine;

public:
    VirtualController(const ControllerOptions& options, Core::Now now, Core::Logger logger);

    void Call(const OpenStream::ApiRequest& request, Core::Now now, OpenStream::ApiResponse& response) override;

    /// A trajectory ends where the arm is, and its buffer is empty; a program runs on.
    void StopControl(Core::Now now) override;

    /// By the operator's hand: out of remote mode, which stops the program, or into it.
    void TurnModeSwitch(bool bRemote, Core::Now now);

    /// When it has something to do by itself; GetMachine then. Nullopt: nothing before the next call.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// For what happens to the machine itself; brought to the present.
    [[nodiscard]] ControllerMachine& GetMachine(Core::Now now);
};

} // namespace ACS::OpenStreamSim
