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

/// Waits until the relay is not 0.
struct WaitStatement
{
    RelayName relay;
};

struct EndStatement
{
};

/// The program that `rl.` commands of the console compose in the base task, statement by statement, and run. While it waits,
/// trajectories may move the arm. Times are simulated.
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
    /// Appends "wait di1", "move …" or "end"; false if the text is another one or the program is full.
    [[nodiscard]] bool TryAdd(std::string_view text);

    /// Removes all statements.
    void Clear();

    /// Begins or continues; a move that was stopped begins again from the arm's position.
    void Start();
    /// No effect if it does not run.
    void Stop();
    /// Back to the beginning.
    void Reset();

    /// Ends the current wait; false if the program does not wait.
    [[nodiscard]] bool TryReleaseWait();

    /// Runs the program between the two times. The arm stops at the end of the program.
    void Advance(Core::Duration from, Core::Duration until, Arm& arm, const RelayMemory& relays);

    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool IsRunning() const noexcept;
    [[nodiscard]] bool IsHalted() const noexcept;
    /// Runs and waits for a relay.
    [[nodiscard]] bool IsWaiting() const noexcept;
};

} // namespace ACS::OpenStreamSim
