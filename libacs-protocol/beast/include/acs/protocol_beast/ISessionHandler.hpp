#pragma once

#include <acs/protocol/SessionEvent.hpp>

namespace ACS::ProtocolBeast
{

/// Who uses an AcsClient or an McsServer. Called on the executor, never from within a call of the user's own, so that it
/// may call the client or server freely; not after their destruction.
class ISessionHandler
{
public:
    ISessionHandler() = default;
    ISessionHandler(const ISessionHandler&) = delete;
    ISessionHandler& operator=(const ISessionHandler&) = delete;
    virtual ~ISessionHandler() = default;

    virtual void OnSessionEvent(const Protocol::SessionEvent& event) = 0;
};

} // namespace ACS::ProtocolBeast
