#include "TlsFailure.hpp"

#include <boost/asio/ssl/error.hpp>
#include <boost/beast/core/error.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/sslerr.h>
#include <openssl/x509_vfy.h>

#include <memory>
#include <string_view>

namespace ACS::ProtocolBeast
{

namespace
{

struct FreeText
{
    void operator()(char* text) const
    {
        OPENSSL_free(text);
    }
};

/// The name or address that the certificate of the other side must be for.
std::string GetExpectedName(SSL* stream)
{
    X509_VERIFY_PARAM* const rules = SSL_get0_param(stream);
    const char* const hostOrNull = X509_VERIFY_PARAM_get0_host(rules, 0);
    if (hostOrNull != nullptr)
    {
        return hostOrNull;
    }
    const std::unique_ptr<char, FreeText> address(X509_VERIFY_PARAM_get1_ip_asc(rules));
    return address == nullptr ? std::string() : address.get();
}

/// Continues "the server's certificate ".
std::string DescribeCertificateFault(SSL* stream, long result)
{
    switch (result)
    {
        case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
            return "is self-signed and is not itself in the CA file";
        case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
        case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
        case X509_V_ERR_CERT_UNTRUSTED:
            return "comes from an unknown CA: name the right CA file";
        case X509_V_ERR_CERT_SIGNATURE_FAILURE:
            return "is not signed by the CA that it names: name the right CA file";
        case X509_V_ERR_CERT_HAS_EXPIRED:
            return "has expired (or this machine's clock is wrong)";
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return "is not valid yet (or this machine's clock is wrong)";
        case X509_V_ERR_HOSTNAME_MISMATCH:
        case X509_V_ERR_IP_ADDRESS_MISMATCH:
            return "is for another name than " + GetExpectedName(stream);
        case X509_V_ERR_INVALID_PURPOSE:
            return "is not meant for this use (extendedKeyUsage)";
        default:
            return std::string("is refused: ") + X509_verify_cert_error_string(result);
    }
}

/// A failure of the library itself; empty if its own text is clear.
std::string_view GetSentence(int reason)
{
    switch (reason)
    {
        case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
            return "the client shows no certificate";
        case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
            return "the other side demands a client certificate";
        case SSL_R_SSLV3_ALERT_HANDSHAKE_FAILURE: // TLS 1.2: a certificate is missing
            return "the other side refuses the handshake (it may demand a client certificate)";
        case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
            return "the other side does not know the CA of our certificate";
        case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
            return "the other side reports that our certificate has expired";
        case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
        case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
        case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
            return "the other side refuses our certificate";
        case SSL_R_WRONG_VERSION_NUMBER:
        case SSL_R_HTTP_REQUEST:
        case SSL_R_UNEXPECTED_MESSAGE:
            return "the other side does not speak TLS (ws instead of wss?)";
        case SSL_R_UNSUPPORTED_PROTOCOL:
        case SSL_R_VERSION_TOO_LOW:
        case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
            return "the other side speaks only versions of TLS before 1.2";
        default:
            return {};
    }
}

} // namespace

std::string DescribeTlsFailure(SSL* stream, const boost::system::error_code& error)
{
    if (error == boost::beast::error::timeout)
    {
        return "the other side did not answer in time";
    }
    if (error == boost::asio::ssl::error::stream_truncated || error == boost::asio::error::eof)
    {
        return "the other side hung up";
    }
    if (error.category() != boost::asio::error::get_ssl_category())
    {
        return error.message();
    }
    const int reason = ERR_GET_REASON(static_cast<unsigned long>(error.value()));
    const long verified = SSL_get_verify_result(stream);
    if (reason == SSL_R_CERTIFICATE_VERIFY_FAILED && verified != X509_V_OK)
    {
        const std::string owner = SSL_is_server(stream) != 0 ? "the client's" : "the server's";
        return owner + " certificate " + DescribeCertificateFault(stream, verified);
    }
    const std::string_view sentence = GetSentence(reason);
    return sentence.empty() ? error.message() : std::string(sentence);
}

} // namespace ACS::ProtocolBeast
