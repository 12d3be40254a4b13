#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>

#include <functional>

namespace ACS::AdapterTest
{

/// The virtual time of a scenario. It advances only from task to task.
class ACS_API IVirtualTime : public Core::IClock
{
public:
    /// What the robot, its link or the adapter does at a time.
    using Task = std::function<void()>;

    /// Runs the task after the delay, and never within this call. Tasks that are left at the end of the scenario are dropped.
    virtual void Post(Core::Duration delay, Task task) = 0;
};

} // namespace ACS::AdapterTest
