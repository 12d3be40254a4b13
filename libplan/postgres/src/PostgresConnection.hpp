#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ISqlDatabase.hpp>
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <libpq-fe.h>

namespace ACS::Planning
{

/// A statement with its parameters.
struct SqlStatement
{
    std::string text;
    std::vector<SqlValue> values;
};

/// Why a transaction was not stored.
struct TransactionFault
{
    Core::Error error;
    bool bUnknown = false;    ///< The connection was lost: the transaction may have been stored.
    bool bRepeatable = false; ///< It may succeed if it is repeated.
};

/// A number that the database has written itself.
[[nodiscard]] std::int64_t ReadCount(const std::string& text);

/// A connection to PostgreSQL. Every call ends within the timeout, except that the resolution of a host's name may take longer. A
/// connection that has failed is not used again.
class PostgresConnection
{
    struct Closer
    {
        void operator()(PGconn* connection) const noexcept
        {
            PQfinish(connection);
        }
    };

    std::unique_ptr<PGconn, Closer> _connection;
    std::string _name;
    Core::Duration _timeout;
    std::function<bool()> _shouldStop;

    PostgresConnection(std::unique_ptr<PGconn, Closer> connection, std::string name, const PostgresOptions& options);

public:
    /// Connects to the first host that accepts writes, and prepares the session: search path acsd, limits of time. Each of N hosts
    /// has an Nth of the timeout.
    [[nodiscard]] static Core::Result<PostgresConnection> Open(const PostgresOptions& options);

    /// The connection has not failed, as far as it is known.
    [[nodiscard]] bool IsUsable() const noexcept;

    /// The rows of one statement, a transaction of its own.
    [[nodiscard]] Core::Result<std::vector<SqlRow>> Query(const SqlStatement& statement, std::string_view operation);

    /// Several statements as one transaction.
    [[nodiscard]] Core::Result<void> RunScript(const std::string& text, std::string_view operation);

    /// Executes the statements as one transaction, sent together: one round trip.
    [[nodiscard]] tl::expected<void, TransactionFault> Commit(const std::vector<SqlStatement>& statements);

private:
    [[nodiscard]] static Core::Result<PostgresConnection> OpenHost(
        const PostgresOptions& options,
        const PostgresTarget& target,
        const PostgresHost& host,
        Core::Duration timeout);
    [[nodiscard]] static Core::Result<PostgresConnection> OpenAddress(
        const PostgresOptions& options,
        const PostgresTarget& target,
        const PostgresHost& host,
        Core::Duration timeout);
    [[nodiscard]] Core::Result<void> Connect(Core::Duration timeout);
    [[nodiscard]] bool TrySend(const SqlStatement& statement);
    [[nodiscard]] bool TryWait(bool bForWriting, Core::SteadyTime deadline);
    [[nodiscard]] bool TryFlush(Core::SteadyTime deadline);
    [[nodiscard]] bool TryAwaitResult(Core::SteadyTime deadline);
    [[nodiscard]] Core::Result<std::vector<SqlRow>> ReadRows(Core::SteadyTime deadline, std::string_view operation);
    [[nodiscard]] tl::expected<void, TransactionFault> ReadOutcome(std::size_t statements, Core::SteadyTime deadline);
    [[nodiscard]] bool TryEndPipeline(Core::SteadyTime deadline);
    [[nodiscard]] Core::Error Fail(std::string_view operation, Core::SteadyTime deadline);
};

} // namespace ACS::Planning
