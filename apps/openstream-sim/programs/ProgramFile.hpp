#pragma once

#include "programs/ProgramSpec.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStreamSim
{

/// The file of --programs, which describes the programs of a controller.
struct ProgramFile
{
    std::map<int, ProgramSpec> programs; ///< Valid only without errors.
    std::vector<std::string> errors;     ///< "FILE:LINE: 11.from: what is wrong and what is allowed"

    [[nodiscard]] static ProgramFile Read(const std::string& fileName);
    [[nodiscard]] static ProgramFile ReadText(std::string_view text, const std::string& fileName);

    /// Whether a program needs the name of the robot.
    [[nodiscard]] bool HasRobotName() const;
};

} // namespace ACS::OpenStreamSim
