#pragma once

#include "console/LiveView.hpp"
#include "console/RobotBoard.hpp"
#include "console/Screen.hpp"
#include "console/StyledLine.hpp"
#include "plans/PlanTracker.hpp"
#include <acs/core/Now.hpp>

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>

namespace ACS::McsSim
{

/// What a run prints: a live view where there is a screen, otherwise a line for each event; tables at the end.
class RunOutput final
{
    const Core::IClock& _clock;
    std::ostream& _out;
    Screen* _screenOrNull;
    LiveView _view;
    ViewHeading _heading;
    PlanTracker::Lines _lines;
    bool _bBegun = false;
    Core::SteadyTime _started;
    std::optional<Core::SteadyTime> _finished; ///< When all was done; the elapsed time does not increase after it.

public:
    /// What is referred to outlives the output.
    RunOutput(
        const Core::IClock& clock,
        std::ostream& out,
        Screen* screenOrNull,
        std::size_t columns,
        std::size_t rows);

    /// The live view is drawn from now on.
    void Begin() noexcept;

    /// Lines for people, which the next Flush prints.
    [[nodiscard]] PlanTracker::Lines& GetLines() noexcept;

    void SetAddress(std::string address);
    void SetRegistered(bool bRegistered) noexcept;

    /// Everything is done, and the program waits for a signal.
    void SetKept() noexcept;
    void SetFinished() noexcept;

    /// The end of the elapsed time, which is now until SetFinished.
    [[nodiscard]] Core::SteadyTime GetEnd() const;
    [[nodiscard]] bool IsFinished() const noexcept;

    /// Prints the lines that were added since the last time, where no live view shows what happened.
    void Flush();

    /// Without effect where there is no screen.
    void Draw(const PlanTracker& tracker, const RobotBoard& board);

    /// The last frame of the screen stays.
    void Leave();
    void PrintTable(const StyledLines& lines);
    void PrintLine(const std::string& line);
};

} // namespace ACS::McsSim
