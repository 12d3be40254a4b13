#pragma once

#include <acs/core/Api.hpp>
#include <acs/protocol/SessionEvent.hpp>

namespace ACS::ProtocolBeast
{

/// Receives the events of an AcsClient or an McsServer. Called on the executor and never during a call of the client or
/// server, so that it may call them; not called after their destruction.
class ACS_API ISessionHandler
{
public:
    ISessionHandler() = default;
    ISessionHandler(const ISessionHandler&) = delete;
    ISessionHandler& operator=(const ISessionHandler&) = delete;
    virtual ~ISessionHandler() = default;

    /// Each event once, in order. The reference is valid during the call only.
    virtual void OnSessionEvent(const Protocol::SessionEvent& event) = 0;
};

} // namespace ACS::ProtocolBeast
