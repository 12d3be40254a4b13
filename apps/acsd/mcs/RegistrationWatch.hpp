#pragma once

#include <acs/protocol/SessionEvent.hpp>

#include <string>

namespace ACS::Acsd
{

/// Why the MCS is not there, as far as its session has told. Pure.
class RegistrationWatch
{
    std::string _reason; ///< Empty: none is known.
    bool _bRefused = false;
    bool _bRefusedNow = false; ///< On this connection, whose end is nothing new.

public:
    void OnSessionEvent(const Protocol::SessionEvent& event);

    /// Of a session that is not registered, as a line of /readyz. Where the MCS refuses, this stays while it is tried again.
    [[nodiscard]] std::string GetObstacle(bool bConnected) const;
};

} // namespace ACS::Acsd
