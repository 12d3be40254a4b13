#pragma once

#include "controller/ControllerVersion.hpp"
#include "programs/ProgramSpec.hpp"
#include "world/IWorld.hpp"

#include <chrono>
#include <map>
#include <string>

namespace ACS::OpenStreamSim
{

struct ControllerOptions
{
    double timeScale = 1.0;                       ///< Simulated seconds per second; above 0.
    bool bMotorOn = false;                        ///< At the start.
    bool bWaiting = false;                        ///< At the start the motor is on and a program waits for di1.
    std::chrono::milliseconds motorOnTime{1'000}; ///< Simulated, from the command to motor on.
    std::map<int, ProgramSpec> programs;          ///< By number, FIRST_PROGRAM to LAST_PROGRAM.
    ProgramSpec otherPrograms;                    ///< Every number that is not in `programs`.
    ControllerVersion version;
    std::string robotModel = "HA006B-01"; ///< As in rgen; clients refuse unknown models.
    std::string robotID;                  ///< Of the robot that carries the arm: {robot} in the places of programs.
    Sim::IWorld* world = nullptr;         ///< The floor on which programs work; outlives the controller. Null: none.
};

} // namespace ACS::OpenStreamSim
