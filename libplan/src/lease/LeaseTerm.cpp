#include <acs/plan/LeaseTerm.hpp>

#include <algorithm>

namespace ACS::Planning
{

namespace
{

/// Renewals during one lease: some may fail or be late.
constexpr int RENEWALS = 6;

} // namespace

LeaseTerm::LeaseTerm(Core::Duration duration, Core::SteadyTime askedAt) noexcept
    : _duration(duration),
      _renewedAt(askedAt)
{
}

void LeaseTerm::OnRenewed(Core::SteadyTime askedAt) noexcept
{
    _renewedAt = std::max(_renewedAt, askedAt);
}

bool LeaseTerm::IsHeld(Core::SteadyTime now) const noexcept
{
    return now < GetEnd();
}

Core::SteadyTime LeaseTerm::GetEnd() const noexcept
{
    return _renewedAt + _duration - MARGIN;
}

Core::Duration LeaseTerm::GetRenewInterval() const noexcept
{
    return _duration / RENEWALS;
}

} // namespace ACS::Planning
