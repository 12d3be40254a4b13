#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::ProtocolBeast
{

/// Headers of an upgrade request or its answer, as pairs of name and value.
using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// Checks what AcsClient::Create would reject, and an UpgradeRefusal leave out: line ends, which would inject another
/// header, and headers that the upgrade sets itself (Host has its own option). The error's path is "headers" and the name;
/// the error never shows a value, which may be a password.
[[nodiscard]] Core::Result<void> CheckHttpHeaders(const HttpHeaders& headers);

/// The value of a header; upper and lower case of the name do not differ. nullptr: the header is missing or repeated. Valid
/// while the headers are.
[[nodiscard]] const std::string* FindHeaderOrNull(const HttpHeaders& headers, std::string_view name);

/// Whether the text is valid in a Host header.
[[nodiscard]] Core::Result<void> CheckHostHeader(std::string_view host);

} // namespace ACS::ProtocolBeast
