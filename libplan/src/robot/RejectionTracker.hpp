#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ACS::Planning
{

enum class ERejection : std::uint8_t
{
    None,      ///< The robot may be sent a command.
    Delayed,   ///< It rejected its last command, and is sent one again after a delay.
    Exhausted, ///< It rejected too many in a row, and is sent none until something about it changes.
};

/// Counts the drives and jobs that a robot rejected in a row, that is, without progress between them.
class RejectionTracker
{
    ERejection _state = ERejection::None;
    std::size_t _count = 0;
    std::string _reason;

public:
    /// The robot rejected a command. limit: the number in a row after which it is Exhausted; at least 1.
    void Add(std::string reason, std::size_t limit);
    /// The robot may be sent a command again. The row continues: a robot that was Exhausted is so again after one more rejection.
    /// False: it already may.
    [[nodiscard]] bool TryRetry();
    /// The row has ended. False: there was none.
    [[nodiscard]] bool TryReset();

    [[nodiscard]] ERejection GetState() const noexcept;
    [[nodiscard]] std::size_t GetCount() const noexcept;
    /// Of the last rejection.
    [[nodiscard]] const std::string& GetReason() const noexcept;
};

} // namespace ACS::Planning
