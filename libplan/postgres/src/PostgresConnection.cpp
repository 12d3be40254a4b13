#include "PostgresConnection.hpp"

#include "PostgresFault.hpp"
#include "PostgresResolver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
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

/// Between two questions whether to stop.
constexpr std::chrono::milliseconds STOP_INTERVAL{100};

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

/// The limits of the server are shorter than that of the client, which otherwise could not know the outcome. A session whose
/// transaction waits for its client is ended soon: the client has stalled, and its locks keep others from taking the store.
std::string MakeSessionScript(Core::Duration timeout)
{
    constexpr std::chrono::milliseconds LONGEST_IDLE{1'000};
    const std::int64_t limit = ToMilliseconds(timeout);
    return fmt::format(
        "SET search_path TO acsd; SET client_encoding TO 'UTF8'; SET client_min_messages TO error; "
        "SET default_transaction_isolation TO 'read committed'; SET idle_session_timeout TO 0; "
        "SET statement_timeout TO {}; SET lock_timeout TO {}; "
        "SET idle_in_transaction_session_timeout TO {};"
        // Durable when Append returns, whatever the default of the database is.
        "SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') IN ('off', 'local')",
        limit * 4 / 5,
        limit * 3 / 5,
        std::min(LONGEST_IDLE.count(), limit / 2));
}

} // namespace

std::int64_t ReadCount(const std::string& text)
{
    std::int64_t count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    return count;
}

PostgresConnection::PostgresConnection(
    std::unique_ptr<PGconn, Closer> connection,
    std::string name,
    const PostgresOptions& options)
    : _connection(std::move(connection)),
      _name(std::move(name)),
      _timeout(options.timeout),
      _shouldStop(options.shouldStop)
{
}

Core::Result<PostgresConnection> PostgresConnection::Open(const PostgresOptions& options)
{
    const Core::Result<PostgresTarget> target = ReadPostgresURL(options.url);
    if (!target.has_value())
    {
        return tl::unexpected(target.error());
    }
    // One after the other, because libpq has no limit of time for one of several: the second would never be tried if the first
    // is silent.
    Core::Result<PostgresConnection> opened = tl::unexpected(Core::Error());
    for (const PostgresHost& host : target->hosts)
    {
        opened = OpenHost(options, *target, host, options.timeout / static_cast<int>(target->hosts.size()));
        if (opened.has_value())
        {
            break;
        }
    }
    return opened;
}

/// The first of its addresses that answers.
Core::Result<PostgresConnection> PostgresConnection::OpenHost(
    const PostgresOptions& options,
    const PostgresTarget& target,
    const PostgresHost& host,
    Core::Duration timeout)
{
    const Core::SteadyTime deadline = GetSteadyNow() + timeout;
    if (!host.address.empty())
    {
        return OpenAddress(options, target, host, timeout);
    }
    return ResolveHost(host.host, deadline, options.shouldStop, target.name)
        .and_then([&](const std::vector<std::string>& addresses) {
            if (addresses.empty())
            {
                return OpenAddress(options, target, host, timeout);
            }
            const Core::Duration share = (deadline - GetSteadyNow()) / static_cast<int>(addresses.size());
            Core::Result<PostgresConnection> opened = tl::unexpected(Core::Error());
            for (auto address = addresses.begin(); address != addresses.end() && !opened.has_value(); ++address)
            {
                opened = OpenAddress(options, target, {host.host, host.port, *address}, share);
            }
            return opened;
        });
}

/// The parameters before the URL are defaults, those after it override it.
Core::Result<PostgresConnection> PostgresConnection::OpenAddress(
    const PostgresOptions& options,
    const PostgresTarget& target,
    const PostgresHost& host,
    Core::Duration timeout)
{
    const std::string unacknowledged = std::to_string(ToMilliseconds(options.timeout));
    std::vector<std::pair<const char*, const char*>> parameters{
        {"keepalives_idle", "1"},
        {"keepalives_interval", "1"},
        {"keepalives_count", "3"},
        {"tcp_user_timeout", unacknowledged.c_str()},
        {"fallback_application_name", "acsd"}};
    if (target.bOtherMachine)
    {
        parameters.emplace_back("sslmode", "verify-full");
    }
    parameters.emplace_back("dbname", options.url.c_str());
    parameters.emplace_back("target_session_attrs", "read-write");
    if (target.hosts.size() > 1)
    {
        parameters.emplace_back("host", host.host.c_str());
        parameters.emplace_back("port", host.port.c_str());
    }
    if (!host.address.empty())
    {
        parameters.emplace_back("hostaddr", host.address.c_str()); // the certificate is still that of the host
    }
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
        target.name,
        options);
    return connection.Connect(timeout)
        .and_then([&] { return connection.RunScript(MakeSessionScript(options.timeout), "preparing the session"); })
        .map([&] { return std::move(connection); });
}

Core::Result<void> PostgresConnection::Connect(Core::Duration timeout)
{
    constexpr std::string_view OPERATION = "connecting";
    const Core::SteadyTime deadline = GetSteadyNow() + timeout;
    PQsetErrorVerbosity(_connection.get(), PQERRORS_VERBOSE); // with the SQLSTATE, which is the same in all languages
    PQsetNoticeProcessor(
        _connection.get(),
        [](void* /*unused*/, const char* /*notice*/) {},
        nullptr);
    PostgresPollingStatusType status = PGRES_POLLING_WRITING;
    while (PQstatus(_connection.get()) != CONNECTION_BAD && status != PGRES_POLLING_FAILED
           && status != PGRES_POLLING_OK)
    {
        if (!TryWait(status == PGRES_POLLING_WRITING, deadline))
        {
            return tl::unexpected(MakeTimeoutError(_name, OPERATION, ToSeconds(timeout)));
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
    tl::expected<void, TransactionFault> outcome = ReadOutcome(statements.size() + 2, deadline);
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
            if (GetSteadyNow() >= deadline)
            {
                break;
            }
            continue; // between two statements
        }
        status = PQresultStatus(result.get());
        if (IsOk(*result))
        {
            ++done;
        }
        else if (status == PGRES_FATAL_ERROR && !fault.has_value())
        {
            // Anything but an ERROR of a statement ends the connection, perhaps after COMMIT was executed.
            fault = {MakeStatementError(*result, _name, OPERATION), !IsOfStatement(*result), IsWorthRepeating(*result)};
        }
        if (done == statements)
        {
            // COMMIT was executed, whatever follows.
            if (!TryEndPipeline(deadline))
            {
                _connection.reset();
            }
            return {};
        }
    }
    return tl::unexpected(fault.has_value() ? *fault : TransactionFault{Fail(OPERATION, deadline), true});
}

/// After the last result: reads the end of the pipeline.
bool PostgresConnection::TryEndPipeline(Core::SteadyTime deadline)
{
    while (TryAwaitResult(deadline) && GetSteadyNow() < deadline)
    {
        const ResultPointer result(PQgetResult(_connection.get()));
        if (result != nullptr)
        {
            return PQresultStatus(result.get()) == PGRES_PIPELINE_SYNC && PQexitPipelineMode(_connection.get()) == 1;
        }
    }
    return false;
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
        const Core::Duration left = deadline - GetSteadyNow();
        if (left <= Core::Duration(0) || (_shouldStop && _shouldStop()))
        {
            return false;
        }
        const std::int64_t slice =
            std::max<std::int64_t>(1, ToMilliseconds(std::min<Core::Duration>(left, STOP_INTERVAL)));
        // What can be read must be read also while writing, or both sides wait for each other.
        std::array<pollfd, 1> sockets{
            {{PQsocket(_connection.get()), static_cast<short>(bForWriting ? POLLOUT | POLLIN : POLLIN), 0}}};
        const int ready = ::poll(sockets.data(), sockets.size(), static_cast<int>(slice));
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
            Core::Error lost = Fail(operation, deadline);
            return rows.has_value() ? tl::unexpected(std::move(lost)) : rows;
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
