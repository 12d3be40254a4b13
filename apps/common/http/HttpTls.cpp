#include "common/http/HttpTls.hpp"

#include "common/config/TextFile.hpp"

#include <boost/asio/buffer.hpp>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509err.h>

#include <cstddef>
#include <string_view>
#include <system_error>

namespace ACS::Apps
{

namespace
{

namespace Ssl = boost::asio::ssl;
using ErrorCode = boost::system::error_code;

constexpr std::size_t LARGEST_FILE = 1024U * 1024U;

tl::unexpected<Core::Error> FailForFile(std::string_view key, const std::string& file, const std::string& reason)
{
    return Core::Fail(
        std::make_error_code(std::errc::invalid_argument),
        std::string(key),
        key == "key" ? "a PEM file with the private key of the certificate, without a passphrase"
                     : "a PEM file with certificates",
        file.empty() ? "none" : file + ": " + reason);
}

/// Passes the content of the file to OpenSSL.
template <typename TLoad>
Core::Result<void> Load(std::string_view key, const std::string& file, TLoad load)
{
    const tl::expected<std::string, std::string> text = ReadTextFileUpTo(file, LARGEST_FILE);
    if (!text.has_value())
    {
        return FailForFile(key, file, text.error());
    }
    ErrorCode error;
    load(boost::asio::buffer(*text), error);
    if (error.failed())
    {
        return FailForFile(key, file, error.message());
    }
    return {};
}

void Harden(Ssl::context& context)
{
    SSL_CTX* const handle = context.native_handle();
    SSL_CTX_set_min_proto_version(handle, TLS1_2_VERSION);
    SSL_CTX_set_options(handle, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET);
    // No resumption: the certificate of a client is verified at each connection.
    SSL_CTX_set_session_cache_mode(handle, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_num_tickets(handle, 0);
    // OpenSSL would ask on the terminal.
    ErrorCode ignored;
    static_cast<void>(context.set_password_callback(
        [](std::size_t /*size*/, Ssl::context::password_purpose /*purpose*/) { return std::string(); },
        ignored));
}

Core::Result<void> LoadFiles(const HttpTlsFiles& files, Ssl::context& context)
{
    Core::Result<void> loaded = Load("certificate", files.certificate, [&](const auto& buffer, ErrorCode& error) {
        static_cast<void>(context.use_certificate_chain(buffer, error));
    });
    if (loaded.has_value())
    {
        loaded = Load("key", files.key, [&](const auto& buffer, ErrorCode& error) {
            static_cast<void>(context.use_private_key(buffer, Ssl::context::pem, error));
            if (error.failed()
                && ERR_GET_REASON(static_cast<unsigned long>(error.value())) == X509_R_KEY_VALUES_MISMATCH)
            {
                error.clear(); // reported below
            }
        });
    }
    // Only this finds the key of another kind.
    if (loaded.has_value() && SSL_CTX_check_private_key(context.native_handle()) != 1)
    {
        return FailForFile("key", files.key, "the key of another certificate than " + files.certificate);
    }
    if (loaded.has_value() && !files.clientCA.empty())
    {
        loaded = Load("client_ca", files.clientCA, [&](const auto& buffer, ErrorCode& error) {
            static_cast<void>(context.add_certificate_authority(buffer, error));
        });
        ErrorCode ignored;
        static_cast<void>(context.set_verify_mode(Ssl::verify_peer, ignored));
    }
    return loaded;
}

} // namespace

Core::Result<std::shared_ptr<Ssl::context>> MakeHttpTlsContext(const HttpTlsFiles& files)
{
    auto context = std::make_shared<Ssl::context>(Ssl::context::tls_server);
    Harden(*context);
    Core::Result<void> loaded = LoadFiles(files, *context);
    if (!loaded.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(loaded.error()));
    }
    return context;
}

std::string GetClientName(SSL* stream)
{
    const X509* const certificateOrNull = SSL_get0_peer_certificate(stream);
    if (certificateOrNull == nullptr || SSL_get_verify_result(stream) != X509_V_OK)
    {
        return {};
    }
    const X509_NAME* const subject = X509_get_subject_name(certificateOrNull);
    const int index = X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
    if (index < 0 || X509_NAME_get_index_by_NID(subject, NID_commonName, index) >= 0)
    {
        return {};
    }
    unsigned char* text = nullptr;
    const int length = ASN1_STRING_to_UTF8(&text, X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, index)));
    if (length < 0)
    {
        return {};
    }
    std::string name(text, text + length);
    OPENSSL_free(text);
    return name;
}

} // namespace ACS::Apps
