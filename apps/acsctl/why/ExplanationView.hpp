#pragma once

#include "view/TextTable.hpp"
#include "why/Explanation.hpp"

#include <string>

namespace ACS::Acsctl
{

/// The findings as indented sentences.
[[nodiscard]] std::string PrintExplanation(const Explanation& explanation, const Screen& screen);

/// The findings as one JSON document on one line:
/// `{"needsAttention":true,"findings":[{"subject":"plan","id":"P1","text":"…","needsAttention":true,
/// "causes":[{"depth":0,"text":"…","cause":null,"remedy":["…"]}]}]}`
[[nodiscard]] std::string MakeExplanationText(const Explanation& explanation);

} // namespace ACS::Acsctl
