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

/// The faults of one controller: which are active, and what they do to it and to its answers. Pure: the time comes with
/// each call, and what was due since the last one happens first, at its own time. Begin and end of each are logged. Asks the
/// host for the time of what comes next, of the faults and of the controller itself.
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
    /// Both outlive it, and the controller must not be asked any more when it is gone.
    ControllerFaults(VirtualController& controller, IFaultHost& host, Core::Logger logger, Core::Now now);
    ControllerFaults(const ControllerFaults&) = delete;
    ControllerFaults& operator=(const ControllerFaults&) = delete;
    ~ControllerFaults() = default;

    /// False where there are too many already.
    [[nodiscard]] bool TryAdd(const Fault& fault, Core::Now now);

    /// Ends those of the kind (absent: all), also those that have not begun; how many.
    std::size_t End(std::optional<EFaultKind> kindOrNull, Core::Now now);

    void Advance(Core::Now now);

    /// The host was asked to wake it: what faults and controller have to do by now.
    void OnTimer(Core::Now now);

    /// After each call of the controller: what comes next may have changed.
    void ScheduleWakeUp();

    /// What the service that stands before the controller does with a call, after Advance.
    [[nodiscard]] bool IsSilent() const;
    /// Uses a refusal up.
    [[nodiscard]] std::optional<OpenStream::ApiResponse> TakeRefusalOrNull();
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
