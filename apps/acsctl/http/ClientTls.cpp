#include "http/ClientTls.hpp"

#include "common/config/TextFile.hpp"
#include "common/config/Url.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/format.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <cstddef>
#include <sys/stat.h>

namespace ACS::Acsctl
{

namespace
{

namespace Ssl = boost::asio::ssl;
using ErrorCode = boost::system::error_code;

constexpr std::size_t LARGEST_PEM = 1024U * 1024U;

/// Passes the content of the file to OpenSSL; returns an error, or an empty text.
template <typename TLoad>
std::string Load(const std::string& file, TLoad load)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(file, LARGEST_PEM);
    if (!text.has_value())
    {
        return fmt::format("{}: {}", file, text.error());
    }
    ErrorCode error;
    load(boost::asio::buffer(*text), error);
    return error.failed() ? fmt::format("{}: {}", file, error.message()) : std::string();
}

std::string CheckKeyMode(const std::string& file)
{
    struct stat status = {};
    const bool bOpen = ::stat(file.c_str(), &status) == 0 && (status.st_mode & S_IRWXO) != 0;
    return bOpen ? fmt::format("every user of this machine can access {}; run chmod o-rwx {}", file, file)
                 : std::string();
}

std::string LoadIdentity(const Connection& connection, Ssl::context& context)
{
    std::string error = Load(connection.certificate, [&context](const auto& buffer, ErrorCode& code) {
        static_cast<void>(context.use_certificate_chain(buffer, code));
    });
    if (error.empty())
    {
        error = CheckKeyMode(connection.key);
    }
    if (error.empty())
    {
        error = Load(connection.key, [&context](const auto& buffer, ErrorCode& code) {
            static_cast<void>(context.use_private_key(buffer, Ssl::context::pem, code));
        });
    }
    if (error.empty() && SSL_CTX_check_private_key(context.native_handle()) != 1)
    {
        error = fmt::format("{} is the key of another certificate than {}", connection.key, connection.certificate);
    }
    return error;
}

bool TryDemandName(Ssl::context& context, const std::string& host)
{
    X509_VERIFY_PARAM* const rules = SSL_CTX_get0_param(context.native_handle());
    X509_VERIFY_PARAM_set_hostflags(rules, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
    const int set = GetRequestedName(host).empty() ? X509_VERIFY_PARAM_set1_ip_asc(rules, host.c_str())
                                                   : X509_VERIFY_PARAM_set1_host(rules, host.data(), host.size());
    return set == 1;
}

} // namespace

tl::expected<std::shared_ptr<Ssl::context>, std::string> MakeClientTLS(const Connection& connection)
{
    if (!Apps::IsSecure(connection.url.scheme))
    {
        return std::shared_ptr<Ssl::context>();
    }
    auto context = std::make_shared<Ssl::context>(Ssl::context::tls_client);
    SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
    SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION);
    ErrorCode error;
    // OpenSSL would ask on the terminal.
    static_cast<void>(context->set_password_callback(
        [](std::size_t /*size*/, Ssl::context::password_purpose /*purpose*/) { return std::string(); },
        error));
    static_cast<void>(context->set_verify_mode(Ssl::verify_peer, error));
    std::string text;
    if (!TryDemandName(*context, connection.url.peer.host))
    {
        text = fmt::format("{} is not a name that a certificate can have", connection.url.peer.host);
    }
    else if (connection.ca.empty())
    {
        static_cast<void>(context->set_default_verify_paths(error));
    }
    else
    {
        text = Load(connection.ca, [&context](const auto& buffer, ErrorCode& code) {
            static_cast<void>(context->add_certificate_authority(buffer, code));
        });
    }
    if (text.empty() && !connection.certificate.empty())
    {
        text = LoadIdentity(connection, *context);
    }
    if (!text.empty())
    {
        return tl::make_unexpected(text);
    }
    return context;
}

std::string GetRequestedName(const std::string& host)
{
    ErrorCode error;
    static_cast<void>(boost::asio::ip::make_address(host, error));
    return error.failed() ? host : std::string();
}

} // namespace ACS::Acsctl
