#pragma once

#include <string_view>

namespace ACS::Load
{

/// Prints a line of a load program's report: the measured value and whether it is within its bound.
void PrintBound(std::string_view what, std::string_view measured, bool bKept, std::string_view bound);

/// Prints a value without a bound.
void PrintValue(std::string_view what, std::string_view measured);

} // namespace ACS::Load
