#pragma once

#include <cstdint>

namespace ACS::Acsctl
{

enum class ECommand : std::uint8_t
{
    Status,
    Plans,
    Plan,
    Why,
    Robots,
    Robot,
    Actions,
    Alarms,
    Links,
    Queue,
    Site,
    Events,
    Trace,
    Audit,
    TscPause,
    TscResume,
    Block,
    Unblock,
    Maintenance,
    Resolve,
    Skip,
    Cancel,
    Abort,
    Pause,
    Resume,
    Priority,
    Carriers,
    Clear,
    Action,
    Bundle,
    Completion,
    ContextList,
    ContextUse,
    ContextSet,
    ContextRemove,
};

} // namespace ACS::Acsctl
