#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// Finds the plan of a simulator's lines, which a simulator does not know: the plan that the robot had in acsd's latest line.
class TracePlans final
{
    std::map<std::string, std::string, std::less<>> _plans; ///< By robot, of the robots that have one.

public:
    /// The plan of the next line of the merged trace: the one that it states, or that of its robot. Empty: none.
    [[nodiscard]] std::string FindPlan(std::string_view line);
};

} // namespace ACS::Acsctl
