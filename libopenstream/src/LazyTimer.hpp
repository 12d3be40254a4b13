#pragma once

#include <acs/core/Now.hpp>

namespace ACS::OpenStream
{

/// Whether a timer has to be started. Its deadline mostly moves back: the timer is started for an earlier deadline only, and
/// again if it fires early. Thus moving the deadline back costs nothing at each sample.
class LazyTimer
{
    Core::SteadyTime _firesAt = Core::SteadyTime::max(); ///< max: not running.

public:
    /// Whether the timer has to be started for this deadline; it is then expected to run. max: there is no deadline.
    [[nodiscard]] bool ShouldStart(Core::SteadyTime deadline) noexcept
    {
        const bool bStart = deadline < _firesAt;
        _firesAt = bStart ? deadline : _firesAt;
        return bStart;
    }

    /// The timer fired or was cancelled.
    void Reset() noexcept
    {
        _firesAt = Core::SteadyTime::max();
    }
};

} // namespace ACS::OpenStream
