#pragma once

#include "api/ApiTypes.hpp"
#include "view/TextTable.hpp"

#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// The messages on one time line: time, link, direction, robot and contents; also the program if a line is not of acsd.
[[nodiscard]] std::string PrintTrace(const std::vector<TraceLine>& lines, const Screen& screen);

[[nodiscard]] std::string PrintAudit(const std::vector<AuditLine>& lines, const Screen& screen);

/// One line for an event; within the screen.
[[nodiscard]] std::string PrintEntry(const EntryEvent& entry, const Screen& screen);

/// What a message is about: the command of the MCS with its plan, the kind of an MQTT message with its order, else its text.
[[nodiscard]] std::string Summarize(const TraceLine& line);

} // namespace ACS::Acsctl
