#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// Counts the members that the specification requires (sections 2, 4.3 and 5) and that a message of the ACS lacks, although the
/// codec reads it. What the codec refuses is not counted. Pure.
class MemberJudge
{
    std::set<std::string> _reported; ///< "RobotStatusUpdate payload.position"
    std::uint64_t _count = 0;

public:
    /// Any text of the ACS. Returns a line for people per member that was not missed before.
    [[nodiscard]] std::vector<std::string> OnText(std::string_view text);

    [[nodiscard]] std::uint64_t GetCount() const noexcept;
};

} // namespace ACS::McsSim
