#pragma once

#include <string>

namespace ACS::Planning
{

/// After a start with a store that may be out of date: no robot is commanded to move or work until the operator resumes the
/// TSC. Robots are still asked what became of their jobs, stopped and paused.
class RestartHold
{
    std::string _reason; ///< Empty: not active.

public:
    /// The reason as stored; empty: there is no hold.
    void Restore(std::string reason);
    void Release() noexcept;

    [[nodiscard]] bool IsActive() const noexcept;
    /// Empty if not active.
    [[nodiscard]] const std::string& GetReason() const noexcept;
};

} // namespace ACS::Planning
