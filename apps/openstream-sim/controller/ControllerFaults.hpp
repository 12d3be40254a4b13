#pragma once

#include "controller/Fault.hpp"
#include "controller/IFaultHost.hpp"
#include "controller/VirtualController.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>

#include <cstddef>
#include <optional>

namespace ACS::OpenStreamSim
{

/// The faults of one controller and their effect on it and on its answers. Pure: time is a parameter, and what was due since
/// the last call happens first, at its own time. Logs begin and end of each fault. Asks the host for a timer for the next
/// event of the faults and of the controller.
class ControllerFaults final
{
    VirtualController& _controller;
    IFaultHost& _host;
    Core::Logger _logger;
    FaultBoard _board;
    FaultChanges _changes;
    Core::SteadyTime _silentUntil; ///< After a turn of the mode switch.
    std::optional<Core::SteadyTime> _wakeAt;
    Core::Now _now;

public:
    /// Both outlive it; the controller must not be called after its destruction.
    ControllerFaults(VirtualController& controller, IFaultHost& host, Core::Logger logger, Core::Now now);
    ControllerFaults(const ControllerFaults&) = delete;
    ControllerFaults& operator=(const ControllerFaults&) = delete;
    ~ControllerFaults() = default;

    /// False if the controller has the maximum number of faults.
    [[nodiscard]] bool TryAdd(const Fault& fault, Core::Now now);

    /// Ends the faults of the kind (absent: all), those that have not begun included. Returns the number of them.
    std::size_t End(std::optional<EFaultKind> kindOrNull, Core::Now now);

    void Advance(Core::Now now);

    /// The timer of the host has expired.
    void OnTimer(Core::Now now);

    /// Call after each call of the controller, which may have changed the next event.
    void ScheduleWakeUp();

    /// Whether the data lines of the stream are suppressed; after Advance.
    [[nodiscard]] bool IsSilent() const;
    /// The answer of a refusal, which is used up; nullopt: execute the call.
    [[nodiscard]] std::optional<OpenStream::ApiResponse> UseRefusalOrNull();
    [[nodiscard]] Core::Duration GetDelay(EFaultSide side) const;

private:
    void AdvanceAll(Core::Now now);
    void ApplyChanges();
    void Apply(const FaultChange& change);
    void TurnModeSwitch(const Fault& fault);
    [[nodiscard]] bool ShouldFail(int number, bool bAtStart);
    [[nodiscard]] bool ShouldStoreWrongValue();
    void Finish();
};

} // namespace ACS::OpenStreamSim
