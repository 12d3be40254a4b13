#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The operator's decision about an unresolved job (ResolveJob).
enum class EJobResolution : std::uint8_t
{
    Done,   ///< It was done.
    Failed, ///< It was not done, or not completely: the plan fails.
    Again,  ///< It was not done and nothing was moved: it is commanded again.
};

/// "Done"
[[nodiscard]] ACS_API std::string_view GetText(EJobResolution value) noexcept;

} // namespace ACS::Planning
