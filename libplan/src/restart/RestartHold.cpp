#include "restart/RestartHold.hpp"

#include <utility>

namespace ACS::Planning
{

void RestartHold::Restore(std::string reason)
{
    _reason = std::move(reason);
}

void RestartHold::Release() noexcept
{
    _reason.clear();
}

bool RestartHold::IsActive() const noexcept
{
    return !_reason.empty();
}

const std::string& RestartHold::GetReason() const noexcept
{
    return _reason;
}

} // namespace ACS::Planning
