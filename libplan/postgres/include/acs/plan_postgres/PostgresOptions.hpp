#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// How to reach a store in PostgreSQL.
struct PostgresOptions
{
    /// As libpq defines it: "postgresql://user@host:port/database?sslmode=verify-full&sslrootcert=FILE". It may name several
    /// hosts, separated by commas: the one that accepts writes is used. Without sslmode it is verify-full for other machines, so
    /// that no other program can pretend to be the server.
    std::string url;
    std::string password; ///< Of the user; empty: from the URL, or as libpq finds it (PGPASSFILE).
    Core::Duration timeout{std::chrono::seconds(5)}; ///< For connecting, and for each transaction.
    /// Asked several times a second, by the thread that calls: true ends a call that waits for the server. May be empty.
    std::function<bool()> shouldStop{};
    /// Whether a PostgresLease may create the tables in an empty database. False for a process that has used them before.
    bool bMayCreate = true;
};

/// A server that a URL names.
struct PostgresHost
{
    std::string host;      ///< Empty: the local socket.
    std::string port;      ///< Empty: the default.
    std::string address{}; ///< The hostaddr of the URL; empty: that of the host.
};

/// What a URL of a store gives.
struct PostgresTarget
{
    std::string name;                ///< The URL without a password and parameters, for people.
    std::vector<PostgresHost> hosts; ///< At least one.
    bool bPassword = false;          ///< The URL has a password.
    bool bOtherMachine = true;       ///< A host is none of this machine.
    bool bVerified = false;          ///< The connection is encrypted and the server is identified.
};

/// Reads a URL without connecting. Errors: ECoreError::InvalidLocation, with the reason.
[[nodiscard]] ACS_API Core::Result<PostgresTarget> ReadPostgresURL(const std::string& url);

} // namespace ACS::Planning
