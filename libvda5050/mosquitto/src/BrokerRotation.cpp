#include "BrokerRotation.hpp"

#include <cassert>

namespace ACS::VDA5050
{

BrokerRotation::BrokerRotation(std::size_t count)
    : _count(count)
{
    assert(count > 0);
}

std::size_t BrokerRotation::GetCurrent() const noexcept
{
    return _current;
}

std::size_t BrokerRotation::GetNext() const noexcept
{
    return (_current + 1) % _count;
}

void BrokerRotation::MoveOn() noexcept
{
    _current = GetNext();
    _failures = _failures % _count + 1;
}

bool BrokerRotation::IsRoundOver() const noexcept
{
    return _failures == _count;
}

void BrokerRotation::BeginRound() noexcept
{
    _failures = 0;
}

} // namespace ACS::VDA5050
