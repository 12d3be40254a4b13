#pragma once

#include "config/Connection.hpp"

#include <boost/asio/ssl/context.hpp>
#include <tl/expected.hpp>

#include <memory>
#include <string>

namespace ACS::Acsctl
{

/// A TLS client (1.2 or newer) that verifies the certificate and the name of acsd; null for http. An error names the file.
[[nodiscard]] tl::expected<std::shared_ptr<boost::asio::ssl::context>, std::string> MakeClientTLS(
    const Connection& connection);

/// The name for the extension SNI; empty for an address.
[[nodiscard]] std::string GetRequestedName(const std::string& host);

} // namespace ACS::Acsctl
