#include "PostgresConnection.hpp"

#include "PostgresFault.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <poll.h>
#include <tuple>
#include <utility>
#include <variant>

namespace ACS::Planning
{

namespace
{

struct ResultCloser
{
    void operator()(PGresult* result) const noexcept
    {
        PQclear(result);
    }
};

using ResultPointer = std::unique_ptr<PGresult, ResultCloser>;

/// The server ends a session whose transaction waits for its client this long: the client has stalled, and its locks keep others
/// from taking the store.
constexpr std::chrono::milliseconds IDLE_TRANSACTION{1'000};

/// Of the driver of the network: data that is not acknowledged this long ends the connection.
constexpr std::chrono::milliseconds UNACKNOWLEDGED{5'000};

Core::SteadyTime GetSteadyNow()
{
    return std::chrono::steady_clock::now();
}

double ToSeconds(Core::Duration duration)
{
    return std::chrono::duration<double>(duration).count();
}

std::int64_t ToMilliseconds(Core::Duration duration)
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

bool IsOk(const PGresult& result)
{
    const ExecStatusType status = PQresultStatus(&result);
    return status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK;
}

std::vector<SqlRow> MakeRows(const PGresult& result)
{
    std::vector<SqlRow> rows(static_cast<std::size_t>(PQntuples(&result)));
    for (int row = 0; row < PQntuples(&result); ++row)
    {
        for (int column = 0; column < PQnfields(&result); ++column)
        {
            const auto length = static_cast<std::size_t>(PQgetlength(&result, row, column));
            rows[static_cast<std::size_t>(row)].emplace_back(PQgetvalue(&result, row, column), length);
        }
    }
    return rows;
}

/// What libpq adds to the URL; the URL overrides all but the last two.
std::string MakeSessionScript(Core::Duration timeout)
{
    return fmt::format(
        "SET search_path TO acsd; SET client_encoding TO 'UTF8'; SET client_min_messages TO warning; "
        "SET default_transaction_isolation TO 'read committed'; SET statement_timeout TO {0}; SET lock_timeout TO {0}; "
        "SET idle_in_transaction_session_timeout TO {1};"
        // Durable when Append returns, whatever the default of the database is.
        "SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') IN ('off', 'local')",
        ToMilliseconds(timeout),
        IDLE_TRANSACTION.count());
}

} // namespace

PostgresConnection::PostgresConnection(
    std::unique_ptr<PGconn, Closer> connection,
    std::string name,
    Core::Duration timeout)
    : _connection(std::move(connection)),
      _name(std::move(name)),
      _timeout(timeout)
{
}

Core::Result<PostgresConnection> PostgresConnection::Open(const PostgresOptions& options)
{
    const Core::Result<PostgresTarget> target = ReadPostgresURL(options.url);
    if (!target.has_value())
    {
        return tl::unexpected(target.error());
    }
    const std::string unacknowledged = std::to_string(UNACKNOWLEDGED.count());
    std::vector<std::pair<const char*, const char*>> parameters{
        {"keepalives_idle", "1"},
        {"keepalives_interval", "1"},
        {"keepalives_count", "3"},
        {"tcp_user_timeout", unacknowledged.c_str()},
        {"fallback_application_name", "acsd"}};
    if (target->bOtherMachine)
    {
        parameters.emplace_back("sslmode", "verify-full");
    }
    parameters.emplace_back("dbname", options.url.c_str()); // is expanded, and overrides what is before it
    parameters.emplace_back("target_session_attrs", "read-write");
    if (!options.password.empty())
    {
        parameters.emplace_back("password", options.password.c_str());
    }
    std::vector<const char*> keys;
    std::vector<const char*> values;
    for (const auto& [key, value] : parameters)
    {
        keys.push_back(key);
        values.push_back(value);
    }
    keys.push_back(nullptr);
    values.push_back(nullptr);
    PostgresConnection connection(
        std::unique_ptr<PGconn, Closer>(PQconnectStartParams(keys.data(), values.data(), 1)),
        target->name,
        options.timeout);
    return connection.Connect()
        .and_then([&] { return connection.RunScript(MakeSessionScript(options.timeout), "preparing the session"); })
        .map([&] { return std::move(connection); });
}

Core::Result<void> PostgresConnection::Connect()
{
    constexpr std::string_view OPERATION = "connecting";
    const Core::SteadyTime deadline = GetSteadyNow() + _timeout;
    PostgresPollingStatusType status = PGRES_POLLING_WRITING;
    while (PQstatus(_connection.get()) != CONNECTION_BAD && status != PGRES_POLLING_FAILED
           && status != PGRES_POLLING_OK)
    {
        if (!TryWait(status == PGRES_POLLING_WRITING, deadline))
        {
            return tl::unexpected(MakeTimeoutError(_name, OPERATION, ToSeconds(_timeout)));
        }
        status = PQconnectPoll(_connection.get());
    }
    if (PQstatus(_connection.get()) != CONNECTION_OK)
    {
        return tl::unexpected(MakeConnectionError(_connection.get(), _name, OPERATION));
    }
    PQsetnonblocking(_connection.get(), 1);
    return {};
}

bool PostgresConnection::IsUsable() const noexcept
{
    return _connection != nullptr && PQstatus(_connection.get()) == CONNECTION_OK;
}

Core::Result<std::vector<SqlRow>> PostgresConnection::Query(const SqlStatement& statement, std::string_view operation)
{
    const Core::SteadyTime deadline = GetSteadyNow() + _timeout;
    if (!IsUsable() || !TrySend(statement) || !TryFlush(deadline))
    {
        return tl::unexpected(Fail(operation, deadline));
    }
    return ReadRows(deadline, operation);
}

Core::Result<void> PostgresConnection::RunScript(const std::string& text, std::string_view operation)
{
    const Core::SteadyTime deadline = GetSteadyNow() + _timeout;
    if (!IsUsable() || PQsendQuery(_connection.get(), text.c_str()) == 0 || !TryFlush(deadline))
    {
        return tl::unexpected(Fail(operation, deadline));
    }
    return ReadRows(deadline, operation).map([](const auto& /*rows*/) {});
}

tl::expected<void, TransactionFault> PostgresConnection::Commit(const std::vector<SqlStatement>& statements)
{
    constexpr std::string_view OPERATION = "writing";
    const Core::SteadyTime deadline = GetSteadyNow() + _timeout;
    if (!IsUsable())
    {
        return tl::unexpected(TransactionFault{Fail(OPERATION, deadline)});
    }
    bool bSent = PQenterPipelineMode(_connection.get()) == 1 && TrySend({"BEGIN", {}});
    for (auto statement = statements.begin(); bSent && statement != statements.end(); ++statement)
    {
        bSent = TrySend(*statement);
    }
    if (!bSent)
    {
        // Nothing of it can have been committed: COMMIT was not sent.
        return tl::unexpected(TransactionFault{Fail(OPERATION, deadline)});
    }
    if (!TrySend({"COMMIT", {}}) || PQpipelineSync(_connection.get()) == 0 || !TryFlush(deadline))
    {
        return tl::unexpected(TransactionFault{Fail(OPERATION, deadline), true});
    }
    const tl::expected<void, TransactionFault> outcome = ReadOutcome(statements.size() + 2, deadline);
    if (!outcome.has_value() && IsUsable() && PQexitPipelineMode(_connection.get()) == 1)
    {
        std::ignore = RunScript("ROLLBACK", "ending a transaction"); // a connection that fails here is not used again
    }
    return outcome;
}

/// Reads the results up to the end of the pipeline.
tl::expected<void, TransactionFault> PostgresConnection::ReadOutcome(std::size_t statements, Core::SteadyTime deadline)
{
    constexpr std::string_view OPERATION = "writing";
    std::optional<TransactionFault> fault;
    std::size_t done = 0;
    for (ExecStatusType status = PGRES_EMPTY_QUERY; status != PGRES_PIPELINE_SYNC;)
    {
        if (!TryAwaitResult(deadline))
        {
            Core::Error lost = Fail(OPERATION, deadline);
            return tl::unexpected(fault.has_value() ? *fault : TransactionFault{std::move(lost), true});
        }
        const ResultPointer result(PQgetResult(_connection.get()));
        if (result == nullptr)
        {
            continue; // between two statements
        }
        status = PQresultStatus(result.get());
        if (IsOk(*result))
        {
            ++done;
        }
        else if (status == PGRES_FATAL_ERROR && !fault.has_value())
        {
            fault = {MakeStatementError(*result, _name, OPERATION), false, IsWorthRepeating(*result)};
        }
    }
    if (fault.has_value())
    {
        return tl::unexpected(std::move(*fault));
    }
    if (done != statements || PQexitPipelineMode(_connection.get()) != 1)
    {
        return tl::unexpected(TransactionFault{Fail(OPERATION, deadline), true});
    }
    return {};
}

bool PostgresConnection::TrySend(const SqlStatement& statement)
{
    std::vector<std::string> numbers;
    numbers.reserve(statement.values.size());
    std::vector<const char*> texts;
    for (const SqlValue& value : statement.values)
    {
        if (const auto* const text = std::get_if<std::string>(&value); text != nullptr)
        {
            texts.push_back(text->c_str());
        }
        else
        {
            texts.push_back(numbers.emplace_back(std::to_string(std::get<std::int64_t>(value))).c_str());
        }
    }
    return PQsendQueryParams(
               _connection.get(),
               statement.text.c_str(),
               static_cast<int>(texts.size()),
               nullptr,
               texts.data(),
               nullptr,
               nullptr,
               0)
        == 1;
}

/// Waits until the socket can be written, or read. False if the deadline has passed.
bool PostgresConnection::TryWait(bool bForWriting, Core::SteadyTime deadline)
{
    while (true)
    {
        const std::int64_t left = ToMilliseconds(deadline - GetSteadyNow());
        if (left <= 0)
        {
            return false;
        }
        // What can be read must be read also while writing, or both sides wait for each other.
        std::array<pollfd, 1> sockets{
            {{PQsocket(_connection.get()), static_cast<short>(bForWriting ? POLLOUT | POLLIN : POLLIN), 0}}};
        const int ready = ::poll(sockets.data(), sockets.size(), static_cast<int>(left));
        if (ready > 0 || (ready < 0 && errno != EINTR))
        {
            return true; // an error shows itself in the next call of libpq
        }
    }
}

bool PostgresConnection::TryFlush(Core::SteadyTime deadline)
{
    while (true)
    {
        const int left = PQflush(_connection.get());
        if (left <= 0)
        {
            return left == 0;
        }
        if (!TryWait(true, deadline) || PQconsumeInput(_connection.get()) == 0)
        {
            return false;
        }
    }
}

bool PostgresConnection::TryAwaitResult(Core::SteadyTime deadline)
{
    while (PQisBusy(_connection.get()) == 1)
    {
        if (!TryWait(false, deadline) || PQconsumeInput(_connection.get()) == 0)
        {
            return false;
        }
    }
    return PQstatus(_connection.get()) == CONNECTION_OK;
}

/// Rows of the last statement; the first error.
Core::Result<std::vector<SqlRow>> PostgresConnection::ReadRows(Core::SteadyTime deadline, std::string_view operation)
{
    Core::Result<std::vector<SqlRow>> rows;
    while (true)
    {
        if (!TryAwaitResult(deadline))
        {
            return rows.has_value() ? tl::unexpected(Fail(operation, deadline)) : rows;
        }
        const ResultPointer result(PQgetResult(_connection.get()));
        if (result == nullptr)
        {
            return rows;
        }
        if (IsOk(*result) && rows.has_value())
        {
            rows = MakeRows(*result);
        }
        else if (!IsOk(*result) && rows.has_value())
        {
            rows = tl::unexpected(MakeStatementError(*result, _name, operation));
        }
    }
}

/// Closes the connection, and returns why.
Core::Error PostgresConnection::Fail(std::string_view operation, Core::SteadyTime deadline)
{
    Core::Error error =
        _connection != nullptr && PQstatus(_connection.get()) == CONNECTION_OK && GetSteadyNow() >= deadline
        ? MakeTimeoutError(_name, operation, ToSeconds(_timeout))
        : MakeConnectionError(_connection.get(), _name, operation);
    _connection.reset();
    return error;
}

} // namespace ACS::Planning
