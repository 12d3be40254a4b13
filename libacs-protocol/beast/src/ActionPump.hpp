#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <cstddef>
#include <utility>

namespace ACS::ProtocolBeast
{

/// Carries out what a session returns, in order, also where that runs the session again.
class ActionPump
{
    Protocol::SessionActions _actions;
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
            const Protocol::SessionAction action = std::exchange(_actions[_done], {});
            act(action);
        }
        _actions.clear();
        _done = 0;
        _bActing = false;
    }
};

} // namespace ACS::ProtocolBeast
