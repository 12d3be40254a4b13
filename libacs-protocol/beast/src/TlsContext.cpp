#include "TlsContext.hpp"

#include <boost/asio/ip/address.hpp>
#include <openssl/ssl.h>
#include <openssl/x509err.h>
#include <openssl/x509v3.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

namespace ssl = boost::asio::ssl;

using ErrorCode = boost::system::error_code;

constexpr const char* CA_KEY = "tls.ca";
constexpr const char* CERTIFICATE_KEY = "tls.certificate";
constexpr const char* KEY_KEY = "tls.key";
constexpr const char* NAME_KEY = "tls.server_name";

constexpr const char* CA_EXPECTED = "a PEM file with the certificates of the CA";
constexpr const char* CERTIFICATE_EXPECTED = "a PEM file with a certificate";
constexpr const char* KEY_EXPECTED = "a PEM file with the private key of the certificate, without a passphrase";

tl::unexpected<Core::Error> Refuse(const char* key, const char* expected, const std::string& found)
{
    return Core::Fail(std::make_error_code(std::errc::invalid_argument), key, expected, found);
}

/// Why the file cannot be read, more clearly than OpenSSL reports it.
std::optional<std::string> FindFileFaultOrNull(const std::string& name)
{
    std::error_code unknown;
    if (const std::filesystem::file_status status = std::filesystem::status(name, unknown);
        std::filesystem::is_other(status))
    {
        return "it is no regular file"; // opening a pipe would block until it has a writer
    }
    errno = 0;
    std::ifstream file(name, std::ios::binary);
    if (file.is_open() && file.peek() != std::ifstream::traits_type::eof())
    {
        return std::nullopt;
    }
    return errno == 0 ? "it is empty" : std::generic_category().message(errno);
}

/// Lets OpenSSL load the file; what is wrong with it otherwise.
template <typename TLoad>
Core::Result<void> Load(const char* key, const char* expected, const std::string& name, TLoad load)
{
    const std::optional<std::string> fault = FindFileFaultOrNull(name);
    if (fault.has_value())
    {
        return Refuse(key, expected, name + ": " + *fault);
    }
    ErrorCode error;
    load(error);
    if (error)
    {
        return Refuse(key, expected, name + ": " + error.message());
    }
    return {};
}

Core::Result<void> LoadKey(ssl::context& context, const TlsOptions& options)
{
    Core::Result<void> loaded = Load(KEY_KEY, KEY_EXPECTED, options.keyFile, [&](ErrorCode& error) {
        static_cast<void>(context.use_private_key_file(options.keyFile, ssl::context::pem, error));
        if (error && ERR_GET_REASON(static_cast<unsigned long>(error.value())) == X509_R_KEY_VALUES_MISMATCH)
        {
            error.clear(); // reported below
        }
    });
    if (!loaded.has_value())
    {
        return loaded;
    }
    // Only this finds the key of another kind.
    if (SSL_CTX_check_private_key(context.native_handle()) != 1)
    {
        return Refuse(
            KEY_KEY,
            KEY_EXPECTED,
            options.keyFile + ", which is the key of another certificate than " + options.certificateFile);
    }
    return {};
}

Core::Result<void> LoadIdentity(ssl::context& context, const TlsOptions& options)
{
    Core::Result<void> loaded =
        Load(CERTIFICATE_KEY, CERTIFICATE_EXPECTED, options.certificateFile, [&](ErrorCode& error) {
            static_cast<void>(context.use_certificate_chain_file(options.certificateFile, error));
        });
    return loaded.has_value() ? LoadKey(context, options) : loaded;
}

Core::Result<void> LoadCA(ssl::context& context, const TlsOptions& options)
{
    return Load(CA_KEY, CA_EXPECTED, options.caFile, [&](ErrorCode& error) {
        static_cast<void>(context.load_verify_file(options.caFile, error));
    });
}

/// What both sides have in common.
void Harden(ssl::context& context)
{
    SSL_CTX* const handle = context.native_handle();
    SSL_CTX_set_min_proto_version(handle, TLS1_2_VERSION);
    SSL_CTX_set_options(handle, SSL_OP_NO_RENEGOTIATION);
    // OpenSSL would ask on the terminal.
    ErrorCode ignored;
    static_cast<void>(context.set_password_callback(
        [](std::size_t /*size*/, ssl::context::password_purpose /*purpose*/) { return std::string(); },
        ignored));
}

bool IsAddress(const std::string& name)
{
    ErrorCode error;
    static_cast<void>(boost::asio::ip::make_address(name, error));
    return !error;
}

std::string GetExpectedName(const TlsOptions& options, std::string_view host)
{
    return options.serverName.empty() ? std::string(host) : options.serverName;
}

Core::Result<void> DemandName(ssl::context& context, const std::string& name)
{
    X509_VERIFY_PARAM* const rules = SSL_CTX_get0_param(context.native_handle());
    X509_VERIFY_PARAM_set_hostflags(rules, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
    const bool bSet = !name.empty()
        && (IsAddress(name) ? X509_VERIFY_PARAM_set1_ip_asc(rules, name.c_str())
                            : X509_VERIFY_PARAM_set1_host(rules, name.data(), name.size()))
            == 1;
    if (!bSet)
    {
        return Refuse(NAME_KEY, "a host name or an address without a zone", Core::QuoteForError(name));
    }
    return {};
}

} // namespace

Core::Result<ssl::context> MakeClientContext(const TlsOptions& options, std::string_view host)
{
    ssl::context context(ssl::context::tls_client);
    Harden(context);
    ErrorCode error;
    static_cast<void>(context.set_verify_mode(ssl::verify_peer, error));
    Core::Result<void> done = DemandName(context, GetExpectedName(options, host));
    if (done.has_value() && !options.caFile.empty())
    {
        done = LoadCA(context, options);
    }
    else if (done.has_value())
    {
        // A system without any CA is detected at the handshake.
        static_cast<void>(context.set_default_verify_paths(error));
    }
    if (done.has_value() && options.certificateFile.empty() != options.keyFile.empty())
    {
        done = options.keyFile.empty() ? Refuse(KEY_KEY, KEY_EXPECTED, "a certificate alone")
                                       : Refuse(CERTIFICATE_KEY, CERTIFICATE_EXPECTED, "a key alone");
    }
    else if (done.has_value() && !options.certificateFile.empty())
    {
        done = LoadIdentity(context, options);
    }
    if (!done.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(done.error()));
    }
    return context;
}

Core::Result<ssl::context> MakeServerContext(const TlsOptions& options)
{
    ssl::context context(ssl::context::tls_server);
    Harden(context);
    // No session cache: clients connect rarely, and their certificate is checked each time.
    SSL_CTX* const handle = context.native_handle();
    SSL_CTX_set_session_cache_mode(handle, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_options(handle, SSL_OP_NO_TICKET);
    SSL_CTX_set_num_tickets(handle, 0);
    Core::Result<void> done = LoadIdentity(context, options);
    if (done.has_value() && !options.caFile.empty())
    {
        done = LoadCA(context, options);
        ErrorCode error;
        static_cast<void>(context.set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert, error));
    }
    if (!done.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(done.error()));
    }
    return context;
}

std::string GetRequestedName(const TlsOptions& options, std::string_view host)
{
    std::string name = GetExpectedName(options, host);
    return IsAddress(name) ? std::string() : name;
}

void SetRequestedName(SSL* stream, const std::string& name)
{
    if (!name.empty())
    {
        static_cast<void>(SSL_ctrl(
            stream,
            SSL_CTRL_SET_TLSEXT_HOSTNAME,
            TLSEXT_NAMETYPE_host_name,
            const_cast<char*>(name.c_str()))); // NOLINT(cppcoreguidelines-pro-type-const-cast): it is copied
    }
}

std::string GetPeerSubject(SSL* stream)
{
    const std::unique_ptr<X509, decltype(&X509_free)> certificate(SSL_get1_peer_certificate(stream), &X509_free);
    const std::unique_ptr<BIO, decltype(&BIO_free)> text(BIO_new(BIO_s_mem()), &BIO_free);
    const bool bPrinted = certificate != nullptr && text != nullptr && SSL_get_verify_result(stream) == X509_V_OK
        && X509_NAME_print_ex(text.get(), X509_get_subject_name(certificate.get()), 0, XN_FLAG_RFC2253) >= 0;
    if (!bPrinted)
    {
        return {};
    }
    char* begin = nullptr;
    const long size = BIO_get_mem_data(text.get(), &begin);
    return {begin, static_cast<std::size_t>(size)};
}

Core::Result<void> CheckClientTLS(const TlsOptions& options, std::string_view host)
{
    Core::Result<ssl::context> context = MakeClientContext(options, host);
    if (!context.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(context.error()));
    }
    return {};
}

} // namespace ACS::ProtocolBeast
