#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::ProtocolBeast
{

/// Additional headers of an upgrade request, as pairs of name and value.
using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// Checks what AcsClient::Create would reject: line ends, which would inject another header, and headers that the upgrade
/// sets itself (Host has its own option). The error's path is "headers" and the name; the error never shows a value, which
/// may be a password.
[[nodiscard]] Core::Result<void> CheckHttpHeaders(const HttpHeaders& headers);

/// Whether the text is valid in a Host header.
[[nodiscard]] Core::Result<void> CheckHostHeader(std::string_view host);

} // namespace ACS::ProtocolBeast
