#pragma once

#include <acs/core/Api.hpp>
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
[[nodiscard]] ACS_API Core::Result<void> CheckHttpHeaders(const HttpHeaders& headers);

/// The value of a header; upper and lower case of the name do not differ. nullptr: the header is missing or repeated. Valid
/// while the headers are.
[[nodiscard]] ACS_API const std::string* FindHeaderOrNull(const HttpHeaders& headers, std::string_view name);

/// Whether the text is valid in a Host header.
[[nodiscard]] ACS_API Core::Result<void> CheckHostHeader(std::string_view host);

} // namespace ACS::ProtocolBeast
