#pragma once

#include <acs/protocol/SessionEvent.hpp>

#include <string>

namespace ACS::Acsd
{

/// Why acsd is not registered with the MCS, from the events of the session. Pure.
class RegistrationWatch
{
    std::string _reason; ///< Empty: unknown.
    bool _bRefused = false;
    bool _bRefusedNow = false; ///< On this connection: its end does not replace the reason.

public:
    void OnSessionEvent(const Protocol::SessionEvent& event);

    /// The line of /readyz while acsd is not registered. A refusal stays the reason during further attempts.
    [[nodiscard]] std::string GetObstacle(bool bConnected) const;
    /// The MCS was reached and has refused the registration, or has not answered it.
    [[nodiscard]] bool IsRefused() const noexcept;
};

} // namespace ACS::Acsd
