#pragma once

#include "config/Connection.hpp"

#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// The word with which the completion scripts call acsctl.
constexpr const char* COMPLETE_WORD = "__complete";

/// The candidates for the last of the words, one a line. Names come from acsd within 2 s; without it there are none.
[[nodiscard]] std::string RunCompletion(const std::vector<std::string>& words, const Environment& environment);

} // namespace ACS::Acsctl
