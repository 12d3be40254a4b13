#pragma once

#include <acs/core/Result.hpp>

#include <boost/asio/ssl/context.hpp>

#include <memory>
#include <string>

namespace ACS::Apps
{

/// PEM files of an HTTPS server; empty: none.
struct HttpTlsFiles
{
    std::string certificate; ///< Followed by the intermediate certificates up to its CA.
    std::string key;         ///< Of the certificate, without a passphrase.
    std::string clientCA;    ///< Clients may present a certificate of this CA; another one is refused.

    bool operator==(const HttpTlsFiles&) const = default;
};

/// Reads the files. TLS 1.2 or newer. The path of an error is "certificate", "key" or "client_ca"; the error names the file.
[[nodiscard]] Core::Result<std::shared_ptr<boost::asio::ssl::context>> MakeHttpTlsContext(const HttpTlsFiles& files);

/// The CN of the certificate that the client has presented and that was verified; empty without one, or if it does not have
/// exactly one CN.
[[nodiscard]] std::string GetClientName(SSL* stream);

} // namespace ACS::Apps
