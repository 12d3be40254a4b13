#pragma once

#include "programs/ProgramSpec.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStreamSim
{

/// A file with what the programs of a controller do (--programs).
struct ProgramFile
{
    std::map<int, ProgramSpec> programs; ///< Without mistakes only.
    std::vector<std::string> mistakes;   ///< "FILE:LINE: 11.from: what is wrong and what is allowed"

    [[nodiscard]] static ProgramFile Read(const std::string& fileName);
    [[nodiscard]] static ProgramFile ReadText(std::string_view text, const std::string& fileName);

    /// Whether a program needs the name of the robot.
    [[nodiscard]] bool HasRobotName() const;
};

} // namespace ACS::OpenStreamSim
