#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// What the operator says of a job of which the robot cannot tell what became.
enum class EJobResolution : std::uint8_t
{
    Done,   ///< It was done.
    Failed, ///< It was not done, or not well: the plan fails.
    Again,  ///< It was not done, and nothing was moved: it is commanded once more.
};

/// "Done"
[[nodiscard]] std::string_view GetText(EJobResolution value) noexcept;

} // namespace ACS::Planning
