#include "commands/Session.hpp"

#include "config/ContextStore.hpp"
#include "http/ClientTls.hpp"

#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

/// The contexts; without reading the file where no context can be used.
tl::expected<Contexts, std::string> LoadContexts(const ConnectionOptions& options, const Environment& environment)
{
    const bool bNamed = options.context.has_value() || environment.context.has_value();
    const bool bAddressed = options.url.has_value() || environment.url.has_value();
    return bNamed || !bAddressed ? ContextStore(environment).Load() : Contexts();
}

tl::expected<Connection, std::string> MakeConnection(const AcsctlOptions& options, const Environment& environment)
{
    const tl::expected<Contexts, std::string> contexts = LoadContexts(options.connection, environment);
    if (!contexts.has_value())
    {
        return tl::make_unexpected(contexts.error());
    }
    tl::expected<Connection, std::string> connection = ResolveConnection(options.connection, environment, *contexts);
    if (!connection.has_value())
    {
        return connection;
    }
    if (const std::optional<std::string> risk = FindTokenRiskOrNull(*connection); risk.has_value())
    {
        return tl::make_unexpected(*risk);
    }
    if (!connection->tokenFile.empty())
    {
        tl::expected<std::string, std::string> token = ReadTokenFile(connection->tokenFile);
        if (!token.has_value())
        {
            return tl::make_unexpected(token.error());
        }
        connection->token = std::move(*token);
    }
    else if (!connection->token.empty() && !IsToken(connection->token))
    {
        return tl::make_unexpected(std::string("the token has spaces or characters outside of ASCII"));
    }
    return connection;
}

} // namespace

Outcome<void> Session::Open(const AcsctlOptions& options, const Environment& environment)
{
    tl::expected<Connection, std::string> connection = MakeConnection(options, environment);
    if (!connection.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, connection.error());
    }
    auto tls = MakeClientTLS(*connection);
    if (!tls.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, tls.error());
    }
    _url = Apps::MakeText(connection->url);
    _client = std::make_unique<ApiClient>(_loop, std::move(*connection), std::move(*tls), options.timeout);
    return {};
}

EventLoop& Session::GetLoop() noexcept
{
    return _loop;
}

IApi& Session::GetAPI() noexcept
{
    return *_client;
}

const std::string& Session::GetURL() const noexcept
{
    return _url;
}

} // namespace ACS::Acsctl
