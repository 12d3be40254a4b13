#pragma once

#include <acs/c/acs_protocol.h>
#include <acs/protocol/SessionAction.hpp>

#include <string>

namespace ACS::CInterface
{

/// The JSON of the message that an action delivers; empty if it delivers none.
[[nodiscard]] std::string EncodeDelivered(const Protocol::SessionAction& action);

/// Writes all fields but struct_size. The texts are those of the action and of EncodeDelivered.
void ShowAction(const Protocol::SessionAction& action, const std::string& delivered, acs_action& out);

} // namespace ACS::CInterface
