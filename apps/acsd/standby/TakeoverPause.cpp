#include "standby/TakeoverPause.hpp"

#include <algorithm>

namespace ACS::Acsd
{

Core::Duration TakeoverPause::OnFault(Core::SteadyTime now, Core::Duration lease)
{
    if (!_lastFault.has_value() || now - *_lastFault >= MEMORY)
    {
        _pause = Core::Duration(0);
    }
    else
    {
        _pause = std::min<Core::Duration>(std::max(2 * _pause, lease), std::max<Core::Duration>(LONGEST, lease));
    }
    _lastFault = now;
    return _pause;
}

} // namespace ACS::Acsd
