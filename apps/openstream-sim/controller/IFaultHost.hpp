#pragma once

#include <acs/core/Now.hpp>

#include <optional>

namespace ACS::OpenStreamSim
{

/// What the faults of a controller need from its owner.
class IFaultHost
{
public:
    IFaultHost() = default;
    IFaultHost(const IFaultHost&) = delete;
    IFaultHost& operator=(const IFaultHost&) = delete;
    virtual ~IFaultHost() = default;

    /// Close every Open Stream connection without a last message.
    virtual void DropSessions() = 0;

    /// Call ControllerFaults::OnTimer at this time; nullopt: cancel. Replaces the previous time.
    virtual void WakeAt(std::optional<Core::SteadyTime> timeOrNull) = 0;
};

} // namespace ACS::OpenStreamSim
