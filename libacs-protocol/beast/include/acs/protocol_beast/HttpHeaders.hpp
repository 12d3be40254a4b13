#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::ProtocolBeast
{

/// Extra headers of an upgrade request: name and value, in that order.
using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// Whether AcsClient::Create would take them: a line end in one would smuggle in another, and those that the upgrade
/// makes itself (Host has an option of its own) are not to be replaced. The error's path is "headers" and the name; it
/// never shows a value, which may be a password.
[[nodiscard]] Core::Result<void> CheckHttpHeaders(const HttpHeaders& headers);

/// Whether the text may stand in a Host header.
[[nodiscard]] Core::Result<void> CheckHostHeader(std::string_view host);

} // namespace ACS::ProtocolBeast
