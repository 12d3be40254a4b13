#pragma once

#include "console/RobotBoard.hpp"
#include "console/StyledLine.hpp"
#include "plans/PlanTracker.hpp"

#include <chrono>
#include <cstddef>
#include <string>

namespace ACS::McsSim
{

/// The heading above the robots and plans.
struct ViewHeading
{
    std::string address; ///< ws://127.0.0.1:9001/acs/
    bool bRegistered = false;
    bool bKept = false; ///< Everything is done, and the program waits for a signal.
    std::chrono::milliseconds elapsed{0};
};

/// The run at one moment as lines: a line per robot, a line per plan. Pure: what they are drawn with is the Screen's.
class LiveView
{
public:
    /// More plans than this are never shown at a time: those that are being worked on come first.
    static constexpr std::size_t MAX_PLANS = 12;

private:
    std::size_t _columns;
    std::size_t _rows;

public:
    /// The size of the terminal. At least 40 columns and 8 rows are used.
    LiveView(std::size_t columns, std::size_t rows);

    [[nodiscard]] StyledLines Render(const PlanTracker& tracker, const RobotBoard& board, const ViewHeading& heading)
        const;

private:
    static void AddRobots(const PlanTracker& tracker, const RobotBoard& board, std::size_t most, StyledLines& out);
    void AddPlans(const PlanTracker& tracker, std::size_t most, StyledLines& out) const;
    [[nodiscard]] StyledLine MakePlanLine(const TrackedPlan& plan, std::size_t idColumns) const;
};

/// "########......" in block characters, of this number of columns.
[[nodiscard]] std::string MakeBar(double fraction, std::size_t columns);

} // namespace ACS::McsSim
