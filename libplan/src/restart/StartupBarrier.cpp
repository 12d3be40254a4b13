#include "restart/StartupBarrier.hpp"

#include <utility>

namespace ACS::Planning
{

void StartupBarrier::Begin(bool bHasWork) noexcept
{
    _state = bHasWork ? EState::HoldingWork : EState::Waiting;
}

bool StartupBarrier::TryRelease() noexcept
{
    return std::exchange(_state, EState::Passed) == EState::HoldingWork;
}

bool StartupBarrier::IsWaiting() const noexcept
{
    return _state != EState::Passed;
}

bool StartupBarrier::IsHoldingWork() const noexcept
{
    return _state == EState::HoldingWork;
}

} // namespace ACS::Planning
