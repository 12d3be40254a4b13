#pragma once

#include "api/ApiTypes.hpp"

#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// The text with a full stop at its end.
[[nodiscard]] std::string MakeSentence(std::string text);

/// The word for the begin of a sentence.
[[nodiscard]] std::string Capitalize(std::string word);

/// Whether the status of a plan is final.
[[nodiscard]] bool IsFinalStatus(std::string_view status);

/// Whether a robot with this status cannot be used.
[[nodiscard]] bool IsUnusableStatus(std::string_view status);

/// Whether the plan waits or is paused.
[[nodiscard]] bool IsStopped(const PlanInfo& plan);

} // namespace ACS::Acsctl
