#pragma once

#include "completion/CompletionNeed.hpp"
#include "options/AcsctlOptions.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// What can be the last of these words, which may be empty. The words follow the name of the program.
[[nodiscard]] CompletionNeed FindCompletion(const std::vector<std::string>& words);

/// The connection that the words name: --url, --context and others.
[[nodiscard]] ConnectionOptions ReadConnectionOptions(const std::vector<std::string>& words);

/// Names that begin with "-" become "--", after which they can be written.
void ReplaceDashedNames(std::vector<std::string>& names);

/// The candidates that begin with the text, each once, sorted. Names that a shell would not read as one word are left out.
[[nodiscard]] std::vector<std::string> SelectCandidates(std::vector<std::string> candidates, std::string_view begin);

} // namespace ACS::Acsctl
