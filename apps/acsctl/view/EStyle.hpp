#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// What a text means, shown as its colour.
enum class EStyle : std::uint8_t
{
    Plain,
    Title,
    Good,
    Warning,
    Bad,
    Quiet,
};

/// The text between the codes of the terminal for this style; without colours the text itself.
[[nodiscard]] std::string Paint(std::string_view text, EStyle style, bool bColored);

/// The style of a status of a plan, a step, a job, a robot or the TSC, or of the level of an alarm.
[[nodiscard]] EStyle GetStyle(std::string_view status);

} // namespace ACS::Acsctl
