#include "StateRoom.hpp"

#include <numeric>

namespace ACS::VDA5050
{

namespace
{

constexpr std::size_t QUOTES = 2;
constexpr std::size_t LONGEST_ESCAPE = 6;
constexpr unsigned char FIRST_UNESCAPED = 0x20;

std::size_t MeasureLetter(char letter)
{
    if (static_cast<unsigned char>(letter) < FIRST_UNESCAPED)
    {
        return LONGEST_ESCAPE;
    }
    return letter == '"' || letter == '\\' ? 2 : 1;
}

} // namespace

std::size_t MeasureText(std::string_view text)
{
    return std::accumulate(text.begin(), text.end(), QUOTES, [](std::size_t sum, char letter) {
        return sum + MeasureLetter(letter);
    });
}

std::size_t MeasureTrajectory(const std::optional<Trajectory>& trajectoryOrNull)
{
    constexpr std::size_t FIXED = 64;
    constexpr std::size_t NUMBER = 26;
    constexpr std::size_t POINT = 3 * NUMBER + 24;
    return trajectoryOrNull.has_value()
        ? FIXED + NUMBER * trajectoryOrNull->knotVector.size() + POINT * trajectoryOrNull->controlPoints.size()
        : 0;
}

void DropTextsForPeople(StateMessage& state)
{
    state.information.clear();
    for (ActionState& action : state.actionStates)
    {
        action.actionDescription.clear();
        action.resultDescription.clear();
    }
    for (VehicleError& error : state.errors)
    {
        error.errorDescription.clear();
        error.errorHint.clear();
    }
}

} // namespace ACS::VDA5050
