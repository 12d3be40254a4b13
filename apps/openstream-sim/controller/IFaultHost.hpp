#pragma once

#include <acs/core/Now.hpp>

#include <optional>

namespace ACS::OpenStreamSim
{

/// What the faults of a controller need of who runs it.
class IFaultHost
{
public:
    IFaultHost() = default;
    IFaultHost(const IFaultHost&) = delete;
    IFaultHost& operator=(const IFaultHost&) = delete;
    virtual ~IFaultHost() = default;

    /// Close every Open Stream connection without a line.
    virtual void DropSessions() = 0;

    /// Call ControllerFaults::OnTimer then; nothing: no more. Replaces what was asked for before.
    virtual void WakeAt(std::optional<Core::SteadyTime> timeOrNull) = 0;
};

} // namespace ACS::OpenStreamSim
