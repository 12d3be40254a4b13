#pragma once

#include "arm/Arm.hpp"
#include "arm/MoveStatement.hpp"
#include "programs/RelayMemory.hpp"
#include "programs/RelayName.hpp"
#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::OpenStreamSim
{

/// Until the relay is not 0.
struct WaitStatement
{
    RelayName relay;
};

struct EndStatement
{
};

/// The program that `rl.` commands of the console put together in the base task, statement by statement, and run. While it
/// waits, trajectories may move the arm. Times are simulated.
class ConsoleProgram
{
    enum class EPhase : std::uint8_t
    {
        AtBeginning,
        Running,
        Halted,
    };

    using Statement = std::variant<WaitStatement, MoveStatement, EndStatement>;

    std::vector<Statement> _statements;
    std::size_t _next = 0;
    bool _bMoving = false; ///< The move at _next has begun.
    EPhase _phase = EPhase::AtBeginning;

public:
    /// Appends "wait di1", "move …" or "end"; false where it is none of them or the program is full.
    [[nodiscard]] bool TryAdd(std::string_view text);

    /// No statements any more.
    void Clear();

    /// Begins or goes on; a move that was stopped begins anew from where the arm is.
    void Start();
    /// Nothing happens where it does not run.
    void Stop();
    /// Back to the beginning.
    void Reset();

    /// Leaves the wait at which it stands; false where it stands at none.
    [[nodiscard]] bool TryReleaseWait();

    /// What happens between the two times. The arm stops at its end.
    void Advance(Core::Duration from, Core::Duration until, Arm& arm, const RelayMemory& relays);

    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool IsRunning() const noexcept;
    [[nodiscard]] bool IsHalted() const noexcept;
    /// Runs, and stands at a wait.
    [[nodiscard]] bool IsWaiting() const noexcept;
};

} // namespace ACS::OpenStreamSim
