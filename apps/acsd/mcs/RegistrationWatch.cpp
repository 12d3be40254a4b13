#include "mcs/RegistrationWatch.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>

#include <utility>
#include <variant>

namespace ACS::Acsd
{

void RegistrationWatch::OnSessionEvent(const Protocol::SessionEvent& event)
{
    const auto refuse = [this](std::string reason) {
        _reason = std::move(reason);
        _bRefused = true;
        _bRefusedNow = true;
    };
    std::visit(
        Core::Overloaded{
            [this](const Protocol::Registered&) { *this = {}; },
            [&refuse](const Protocol::RegistrationRefused& refused) {
                refuse(
                    "registration refused"
                    + (refused.message.empty() ? "" : ": " + Core::QuoteForError(refused.message)));
            },
            [&refuse](const Protocol::ProtocolNoted& noted) {
                if (noted.what == Protocol::EProtocolNote::RegistrationUnanswered)
                {
                    refuse("registration not answered");
                }
            },
            [this](const Protocol::LinkLost& lost) {
                if (!std::exchange(_bRefusedNow, false))
                {
                    _reason = lost.reason;
                    _bRefused = false;
                }
            },
            [](const auto&) { /* not about the registration */ }},
        event);
}

bool RegistrationWatch::IsRefused() const noexcept
{
    return _bRefused;
}

std::string RegistrationWatch::GetObstacle(bool bConnected) const
{
    if (_bRefused)
    {
        return "connected, not registered: mcs: " + _reason;
    }
    if (bConnected)
    {
        return "connected, not registered: mcs: registration not answered yet";
    }
    return _reason.empty() ? "no connection: mcs" : "no connection: mcs: " + _reason;
}

} // namespace ACS::Acsd
