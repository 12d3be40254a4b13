#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ACS::Net
{

/// Carries out what a session returns, in order, also where that runs the session again.
template <typename TAction>
class ActionPump
{
    std::vector<TAction> _actions;
    std::size_t _done = 0;
    bool _bActing = false;

public:
    /// call(out) runs the session, act(action) carries one action out.
    template <typename TCall, typename TAct>
    void Run(TCall call, TAct act)
    {
        call(_actions);
        if (_bActing)
        {
            return;
        }
        _bActing = true;
        for (; _done < _actions.size(); ++_done)
        {
            // Taken out: what follows may make the vector grow.
            const TAction action = std::exchange(_actions[_done], {});
            act(action);
        }
        _actions.clear();
        _done = 0;
        _bActing = false;
    }
};

} // namespace ACS::Net
