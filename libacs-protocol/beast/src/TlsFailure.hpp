#pragma once

#include <boost/asio/ssl/detail/openssl_types.hpp>
#include <boost/system/error_code.hpp>

#include <string>

namespace ACS::ProtocolBeast
{

/// Why a TLS stream failed, in a few words for an operator: which certificate is invalid and why, or
/// otherwise the text of the library.
[[nodiscard]] std::string DescribeTlsFailure(SSL* stream, const boost::system::error_code& error);

} // namespace ACS::ProtocolBeast
