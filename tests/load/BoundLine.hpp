#pragma once

#include <string_view>

namespace ACS::Load
{

/// A line of a load program's report: what was measured, and whether it kept its bound.
void PrintBound(std::string_view what, std::string_view measured, bool bKept, std::string_view bound);

/// One that is bound by nothing.
void PrintFigure(std::string_view what, std::string_view measured);

} // namespace ACS::Load
