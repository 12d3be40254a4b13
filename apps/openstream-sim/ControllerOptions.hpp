#pragma once

#include "ControllerVersion.hpp"

#include <chrono>
#include <map>
#include <string>

namespace ACS::OpenStreamSim
{

inline constexpr int FIRST_PROGRAM = 1;
inline constexpr int LAST_PROGRAM = 9999;

/// What a program of the controller does, as far as the simulator knows: it takes its time and ends, well or not.
struct ProgramSpec
{
    std::chrono::milliseconds duration{2'000}; ///< Simulated.
    bool bFails = false;                       ///< Gives up at its end.

    bool operator==(const ProgramSpec&) const = default;
};

struct ControllerOptions
{
    double timeScale = 1.0;                       ///< Simulated seconds in a real one; above 0.
    bool bMotorOn = false;                        ///< At the start.
    bool bWaiting = false;                        ///< At the start the motor is on and a program waits for di1.
    std::chrono::milliseconds motorOnTime{1'000}; ///< Simulated, from the command to motor on.
    std::map<int, ProgramSpec> programs;          ///< By number, FIRST_PROGRAM to LAST_PROGRAM.
    ProgramSpec otherPrograms;                    ///< Every number that is not in `programs`.
    ControllerVersion version;
    std::string robotModel = "HA006B-01"; ///< As rgen shows it; clients refuse models that they do not know.
};

} // namespace ACS::OpenStreamSim
