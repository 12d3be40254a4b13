#include "BoundLine.hpp"

#include <fmt/format.h>

namespace ACS::Load
{

void PrintBound(std::string_view what, std::string_view measured, bool bKept, std::string_view bound)
{
    fmt::print("{:<46}{:<52}{} {}\n", what, measured, bKept ? "within" : "BEYOND", bound);
}

void PrintValue(std::string_view what, std::string_view measured)
{
    fmt::print("{:<46}{}\n", what, measured);
}

} // namespace ACS::Load
