#include "engine/PlanEngine.Impl.hpp"

#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::Dispatch()
{
    // What one part frees or ends may be what an earlier part waited for.
    while (std::exchange(_bDispatchNeeded, false))
    {
        // Not what could not be stored as begun.
        if (_tscState == ETscState::Auto && !_backlog.IsFailing())
        {
            AssignPlans();
        }
        MoveWaiting();
        if (CanDriveHome())
        {
            SendIdleHome();
        }
        ResolveDeadlocks();
        ChargeIdle();
    }
}

} // namespace ACS::Planning
