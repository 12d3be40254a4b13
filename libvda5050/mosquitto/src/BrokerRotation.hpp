#pragma once

#include <cstddef>

namespace ACS::VDA5050
{

/// Which of several brokers is used: the first one at the start, after each failure (a lost connection or an attempt in vain) the
/// next one, and after the last one the first one again. The brokers are numbered from 0.
class BrokerRotation
{
    std::size_t _count;
    std::size_t _current = 0;
    std::size_t _failures = 0; ///< Since the round began.

public:
    /// At least one broker.
    explicit BrokerRotation(std::size_t count);

    [[nodiscard]] std::size_t GetCurrent() const noexcept;
    /// The broker that a failure of the current one leads to: the same one if it is the only one.
    [[nodiscard]] std::size_t GetNext() const noexcept;

    /// The current broker has failed: the next one is the current one from now on.
    void MoveOn() noexcept;
    /// After MoveOn: whether each broker has failed once more since the round began, so that the next attempt begins another round
    /// and must wait longer.
    [[nodiscard]] bool IsRoundOver() const noexcept;
    /// The connection to the current broker has proved stable: the next failure is the first one of a new round.
    void BeginRound() noexcept;
};

} // namespace ACS::VDA5050
