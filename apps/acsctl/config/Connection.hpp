#pragma once

#include "common/config/Url.hpp"
#include "config/ContextFile.hpp"
#include "options/AcsctlOptions.hpp"

#include <tl/expected.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::Acsctl
{

/// The variables of the environment that acsctl reads; empty ones count as absent.
struct Environment
{
    std::optional<std::string> url;        ///< ACSCTL_URL
    std::optional<std::string> token;      ///< ACSCTL_TOKEN
    std::optional<std::string> context;    ///< ACSCTL_CONTEXT
    std::optional<std::string> configHome; ///< XDG_CONFIG_HOME
    std::optional<std::string> home;
    std::optional<std::size_t> columns; ///< COLUMNS
    bool bNoColor = false;              ///< NO_COLOR
    bool bDumbTerminal = false;
};

/// Where acsd is, and how to identify there.
struct Connection
{
    Apps::Url url{Apps::EUrlScheme::Http, {"127.0.0.1", 8081}, "/"};
    std::string token;     ///< Empty: none, or tokenFile.
    std::string tokenFile; ///< Empty: none.
    std::string ca;
    std::string certificate;
    std::string key;
};

/// Options come before the environment, and this before the context. Without a named context (--context, ACSCTL_CONTEXT), the
/// current one is used, but not if --url or ACSCTL_URL is given: its token must not be sent to another address. An error is a
/// sentence.
[[nodiscard]] tl::expected<Connection, std::string> ResolveConnection(
    const ConnectionOptions& options,
    const Environment& environment,
    const Contexts& contexts);

/// Why a token must not be sent to this address: it would not be encrypted. Nullopt if it may.
[[nodiscard]] std::optional<std::string> FindTokenRiskOrNull(const Connection& connection);

/// The address that --url or --http-url names; a query and a fragment are refused.
[[nodiscard]] tl::expected<Apps::Url, std::string> ParseHttpURL(const std::string& text);

} // namespace ACS::Acsctl
