#pragma once

#include "events/SseParser.hpp"
#include "view/TextTable.hpp"
#include <acs/core/Result.hpp>

#include <string>

namespace ACS::Acsctl
{

/// The line for an event `entry` or `changes`.
[[nodiscard]] Core::Result<std::string> MakeEventLine(const SseEvent& event, const Screen& screen);

/// The event as one line of JSON: `{"id":7,"type":"entry","data":{…}}`
[[nodiscard]] Core::Result<std::string> MakeEventJSON(const SseEvent& event);

} // namespace ACS::Acsctl
