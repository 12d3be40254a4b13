#include "console/RobotBoard.hpp"

#include "Catch.hpp"

#include <string>
#include <vector>

using ACS::McsSim::RobotBoard;

TEST_CASE("An ACS that invents robots fills the board up to its limit, which is reported once")
{
    RobotBoard board;
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < RobotBoard::MAX_ROBOTS + 2; ++i)
    {
        board.OnPosition({{{"R" + std::to_string(i), 1.0, 2.0, 3.0, 4.0}}}, lines);
    }
    ACS::Protocol::RobotStatusUpdate status;
    status.robotID = "one more";
    board.OnStatus(status, lines);
    CHECK(board.GetRobots().size() == RobotBoard::MAX_ROBOTS);
    CHECK(lines == std::vector<std::string>{"ACS has more than 1000 robots: nothing is kept of the others"});
    board.OnPosition({{{"R7", 5.0, 6.0, 7.0, 8.0}}}, lines);
    CHECK(board.GetRobots().at("R7").position->x == Approx(5.0));
}
