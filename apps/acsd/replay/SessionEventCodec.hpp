#pragma once

#include <acs/core/Result.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// JSON of an event of the session with the MCS; of those without effect on acsd only the name.
[[nodiscard]] std::string EncodeSessionEvent(const Protocol::SessionEvent& event);

/// Reads what EncodeSessionEvent wrote. Accepts any text.
[[nodiscard]] Core::Result<Protocol::SessionEvent> DecodeSessionEvent(std::string_view text);

/// Of the request or the report that the event is about; empty: none.
[[nodiscard]] std::string FindTransactionID(const Protocol::SessionEvent& event);

/// Of the plan that a request of the MCS is about; empty: none.
[[nodiscard]] std::string FindPlanID(const Protocol::SessionEvent& event);

/// Of the plan that the payload is about; empty: none.
[[nodiscard]] std::string FindPlanID(const Protocol::AcsPayload& payload);

/// Of the robot that the payload is about; empty: none.
[[nodiscard]] std::string FindRobotID(const Protocol::AcsPayload& payload);

} // namespace ACS::Acsd
