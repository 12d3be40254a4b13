#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <optional>

namespace ACS::Acsd
{

/// How long a process that could not use the store does not take the lease again. Pure.
class TakeoverPause final
{
public:
    /// The longest pause.
    static constexpr std::chrono::seconds LONGEST{30};

    /// A fault this time after the one before counts as the first.
    static constexpr std::chrono::minutes MEMORY{2};

private:
    std::optional<Core::SteadyTime> _lastFault;
    Core::Duration _pause{};

public:
    /// The store could not be used by this process while it had the lease. Returns the pause: none after the first fault, because a
    /// lost connection may be the reason, then the duration of a lease, doubled by each further fault.
    [[nodiscard]] Core::Duration OnFault(Core::SteadyTime now, Core::Duration lease);
};

} // namespace ACS::Acsd
