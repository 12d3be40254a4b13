#include "config/Connection.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsctl
{

namespace
{

const std::optional<std::string>& PickFirst(
    const std::optional<std::string>& firstOrNull,
    const std::optional<std::string>& secondOrNull)
{
    return firstOrNull.has_value() ? firstOrNull : secondOrNull;
}

void SetIfAny(std::string& target, const std::optional<std::string>& valueOrNull)
{
    if (valueOrNull.has_value())
    {
        target = *valueOrNull;
    }
}

} // namespace

tl::expected<Apps::Url, std::string> ParseHttpURL(const std::string& text)
{
    if (text.find_first_of("?#") != std::string::npos)
    {
        // It is not shown: a query may have a secret.
        return tl::make_unexpected(std::string("expected a URL without ? and #"));
    }
    Core::Result<Apps::Url> url = Apps::ParseURL(text, {Apps::EUrlScheme::Http, Apps::EUrlScheme::Https});
    if (!url.has_value())
    {
        return tl::make_unexpected(Core::Describe(url.error()));
    }
    return std::move(*url);
}

tl::expected<Connection, std::string> ResolveConnection(
    const ConnectionOptions& options,
    const Environment& environment,
    const Contexts& contexts)
{
    Connection connection;
    const std::optional<std::string>& named = PickFirst(options.context, environment.context);
    // A context that an option names is not combined with the address of the environment: its token would be sent to that address.
    const std::optional<std::string>& url =
        options.context.has_value() ? options.url : PickFirst(options.url, environment.url);
    const std::string name = named.has_value() ? *named : url.has_value() ? std::string() : contexts.current;
    Context context;
    if (!name.empty())
    {
        const auto found = contexts.entries.find(name);
        if (found == contexts.entries.end())
        {
            return tl::make_unexpected(
                fmt::format("there is no context {}; acsctl context list shows all", Core::QuoteForError(name)));
        }
        context = found->second;
    }
    connection.tokenFile = context.tokenFile;
    connection.token = context.token;
    connection.ca = context.ca;
    connection.certificate = context.certificate;
    connection.key = context.key;
    if (environment.token.has_value())
    {
        connection.token = *environment.token;
        connection.tokenFile.clear();
    }
    if (options.tokenFile.has_value())
    {
        connection.tokenFile = *options.tokenFile;
        connection.token.clear();
    }
    SetIfAny(connection.ca, options.ca);
    SetIfAny(connection.certificate, options.certificate);
    SetIfAny(connection.key, options.key);
    if (const std::string address = url.value_or(context.url); !address.empty())
    {
        tl::expected<Apps::Url, std::string> parsed = ParseHttpURL(address);
        if (!parsed.has_value())
        {
            return tl::make_unexpected(parsed.error());
        }
        connection.url = std::move(*parsed);
    }
    if (connection.certificate.empty() != connection.key.empty())
    {
        return tl::make_unexpected(std::string("--certificate and --key belong to each other; one is missing"));
    }
    const bool bTLS = !connection.ca.empty() || !connection.certificate.empty();
    if (bTLS && !Apps::IsSecure(connection.url.scheme))
    {
        return tl::make_unexpected(
            fmt::format("--ca, --certificate and --key need an https:// URL, not {}", Apps::MakeText(connection.url)));
    }
    return connection;
}

std::optional<std::string> FindTokenRiskOrNull(const Connection& connection)
{
    const bool bToken = !connection.token.empty() || !connection.tokenFile.empty();
    if (!bToken || Apps::IsSecure(connection.url.scheme) || Apps::IsLoopback(connection.url.peer.host))
    {
        return std::nullopt;
    }
    return fmt::format(
        "the token would be sent to {} without encryption; use https, or a tunnel to 127.0.0.1",
        Apps::MakeText(connection.url));
}

} // namespace ACS::Acsctl
