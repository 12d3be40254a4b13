#include "PostgresConnection.hpp"
#include "PostgresFault.hpp"
#include "PostgresSchema.hpp"
#include <acs/plan/SqlPlanTables.hpp>
#include <acs/plan_postgres/PostgresPlanStore.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Planning
{

namespace
{

/// Repetitions of a transaction that the server has ended because of another one.
constexpr int MOST_REPETITIONS = 3;

/// Between two attempts to connect after a connection was lost during a commit.
constexpr std::chrono::milliseconds RETRY_DELAY{100};

constexpr std::string_view RESTORE_REMEDY =
    "stop all processes, then restore a backup with pg_restore, or drop the schema acsd to start with an empty store";

/// Between two attempts to connect: a server that is being restarted refuses at once.
void PauseFor(std::chrono::milliseconds duration)
{
    std::ignore = ::poll(nullptr, 0, static_cast<int>(duration.count()));
}

/// Collects the statements of a transaction.
class StatementList final : public ISqlDatabase
{
    std::vector<SqlStatement>& _statements;

public:
    explicit StatementList(std::vector<SqlStatement>& statements)
        : _statements(statements)
    {
    }

    /// PostgreSQL cannot store U+0000, which the texts of a robot may have; JSON texts have it escaped.
    [[nodiscard]] Core::Result<void> Run(std::string_view text, const std::vector<SqlValue>& values) override
    {
        constexpr std::string_view REPLACEMENT = "\xEF\xBF\xBD"; // U+FFFD
        SqlStatement& statement = _statements.emplace_back(SqlStatement{std::string(text), values});
        for (SqlValue& value : statement.values)
        {
            auto* const string = std::get_if<std::string>(&value);
            for (std::size_t at = 0; string != nullptr && (at = string->find('\0', at)) != std::string::npos;)
            {
                string->replace(at, 1, REPLACEMENT);
            }
        }
        return {};
    }

    [[nodiscard]] Core::Result<std::vector<SqlRow>> Query(std::string_view /*text*/) override
    {
        return std::vector<SqlRow>();
    }
};

/// Reads with a connection.
class ConnectionReader final : public ISqlDatabase
{
    PostgresConnection& _connection;

public:
    explicit ConnectionReader(PostgresConnection& connection)
        : _connection(connection)
    {
    }

    [[nodiscard]] Core::Result<void> Run(std::string_view text, const std::vector<SqlValue>& values) override
    {
        return _connection.Query({std::string(text), values}, "writing").map([](const auto& /*rows*/) {});
    }

    [[nodiscard]] Core::Result<std::vector<SqlRow>> Query(std::string_view text) override
    {
        return _connection.Query({std::string(text), {}}, "reading");
    }
};

/// All tables as of one moment: another process may write them.
Core::Result<StoredState> ReadSnapshot(PostgresConnection& connection, const std::string& name)
{
    ConnectionReader reader(connection);
    return reader
        .Run("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY", {})
        // Rows are decoded between the queries.
        .and_then([&] { return reader.Run("SET LOCAL idle_in_transaction_session_timeout TO 0", {}); })
        .and_then([&] {
            return ReadStoredState(reader, {name, std::string(RESTORE_REMEDY), "SELECT last_report FROM batches"});
        })
        .and_then([&](StoredState state) { return reader.Run("COMMIT", {}).map([&] { return std::move(state); }); });
}

std::uint64_t FindLastReport(const StoreBatch& batch)
{
    std::uint64_t last = 0;
    for (const StoreChange& change : batch.changes)
    {
        if (const auto* const added = std::get_if<ReportAdded>(&change); added != nullptr)
        {
            last = std::max(last, added->entry.sequence);
        }
    }
    return last;
}

/// Opens a store for reading only, and reads if its schema is the newest.
Core::Result<StoreOrigin> InspectAs(
    const PostgresOptions& options,
    const std::function<Core::Result<void>(PostgresConnection&)>& read)
{
    return PostgresConnection::Open(options).and_then([&](PostgresConnection connection) {
        return ReadPostgresSchema(connection, ReadPostgresURL(options.url)->name).and_then([&](int version) {
            const int newest = GetNewestPostgresSchema();
            const Core::Result<void> done = version == newest ? read(connection) : Core::Result<void>();
            return done.map([&] { return StoreOrigin{version == 0, false, version, newest}; });
        });
    });
}

} // namespace

class PostgresPlanStore::Impl
{
    PostgresOptions _options;
    std::uint64_t _epoch;
    std::string _name;
    std::optional<PostgresConnection> _connection;
    StoreOrigin _origin;
    std::string _identity;
    std::int64_t _session = 0;
    std::int64_t _number = 0; ///< Of the last transaction that is stored.

public:
    Impl(PostgresOptions options, std::uint64_t epoch, std::string name)
        : _options(std::move(options)),
          _epoch(epoch),
          _name(std::move(name))
    {
    }

    [[nodiscard]] Core::Result<void> Open()
    {
        return PostgresConnection::Open(_options)
            .and_then([this](PostgresConnection connection) {
                _connection = std::move(connection);
                return ReadPostgresSchema(*_connection, _name);
            })
            .and_then([this](int version) {
                _origin = {version == 0, false, version, GetNewestPostgresSchema()};
                return version < GetNewestPostgresSchema() ? MigratePostgresSchema(*_connection, version)
                                                           : Core::Result<void>();
            })
            .and_then([this] { return BeginSession(); })
            .and_then([this] { return ReadIdentity(); });
    }

    [[nodiscard]] const std::string& GetIdentity() const noexcept
    {
        return _identity;
    }

    [[nodiscard]] const StoreOrigin& GetOrigin() const noexcept
    {
        return _origin;
    }

    [[nodiscard]] Core::Result<StoredState> Load()
    {
        return Connect().and_then([this] { return ReadSnapshot(*_connection, _name); });
    }

    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch)
    {
        for (int repetition = 0;; ++repetition)
        {
            const Core::Result<std::vector<SqlStatement>> statements =
                Connect().and_then([&] { return MakeStatements(batch); });
            if (!statements.has_value())
            {
                return tl::unexpected(statements.error());
            }
            tl::expected<void, TransactionFault> committed = _connection->Commit(*statements);
            if (committed.has_value())
            {
                ++_number;
                return {};
            }
            if (committed.error().bUnknown)
            {
                return FindOutcome(committed.error().error);
            }
            if (!committed.error().bRepeatable || repetition == MOST_REPETITIONS)
            {
                return tl::unexpected(std::move(committed.error().error));
            }
        }
    }

    [[nodiscard]] Core::Result<void> Check()
    {
        return Connect()
            .and_then([this] {
                return _connection->Query(
                    {"SELECT 1 FROM batches WHERE epoch = $1 AND session = $2",
                     {static_cast<std::int64_t>(_epoch), _session}},
                    "checking the store");
            })
            .and_then([this](const std::vector<SqlRow>& rows) {
                return rows.empty() ? RefuseTaken("another process leads") : Core::Result<void>();
            });
    }

    [[nodiscard]] StoreLog CheckLog() const
    {
        StoreLog log;
        log.path = _name;
        log.freeBytes = std::numeric_limits<std::uint64_t>::max();
        return log;
    }

private:
    [[nodiscard]] Core::Result<void> RefuseTaken(std::string found) const
    {
        return RefuseStore(
            EPlanningError::StoreTaken,
            _name,
            "the lease with which this process began; end the process",
            std::move(found));
    }

    [[nodiscard]] Core::Result<std::vector<SqlStatement>> MakeStatements(const StoreBatch& batch) const
    {
        std::vector<SqlStatement> statements;
        StatementList list(statements);
        Core::Result<void> made = list.Run(
            "SELECT begin_batch($1, $2, $3)",
            {static_cast<std::int64_t>(_epoch), _session, static_cast<std::int64_t>(FindLastReport(batch))});
        for (auto change = batch.changes.begin(); made.has_value() && change != batch.changes.end(); ++change)
        {
            made = WriteChange(list, *change);
        }
        return made.map([&] { return std::move(statements); });
    }

    /// After a connection was lost during a commit: success if it was stored, else the error of the commit.
    [[nodiscard]] Core::Result<void> FindOutcome(const Core::Error& lost)
    {
        const std::int64_t expected = _number + 1;
        Core::Result<void> connected;
        const Core::SteadyTime deadline = std::chrono::steady_clock::now() + _options.timeout;
        do
        {
            connected = Reconnect();
            if (connected.has_value())
            {
                return _number == expected ? Core::Result<void>() : tl::unexpected(lost);
            }
            if (connected.error().code == EPlanningError::StoreTaken)
            {
                return connected;
            }
            PauseFor(RETRY_DELAY);
        }
        while (std::chrono::steady_clock::now() < deadline && !(_options.shouldStop && _options.shouldStop()));
        return RefuseTaken(fmt::format(
            "the connection was lost during a commit, and whether that was stored could not be read: {}",
            Core::Describe(connected.error())));
    }

    [[nodiscard]] Core::Result<void> Connect()
    {
        return _connection.has_value() && _connection->IsUsable() ? Core::Result<void>() : Reconnect();
    }

    [[nodiscard]] Core::Result<void> Reconnect()
    {
        return PostgresConnection::Open(_options).and_then([this](PostgresConnection connection) {
            _connection = std::move(connection);
            return BeginSession();
        });
    }

    [[nodiscard]] Core::Result<void> ReadIdentity()
    {
        return _connection->Query({"SELECT value FROM settings WHERE name = 'identity'", {}}, "reading the identity")
            .map([this](const std::vector<SqlRow>& rows) { _identity = rows.empty() ? "" : rows.front().front(); });
    }

    /// From then on no transaction of a former connection is stored, and the number is that of the last one that was.
    [[nodiscard]] Core::Result<void> BeginSession()
    {
        return _connection
            ->Query(
                {"UPDATE batches SET session = session + 1 WHERE epoch = $1 RETURNING session, number",
                 {static_cast<std::int64_t>(_epoch)}},
                "beginning a session")
            .and_then([this](const std::vector<SqlRow>& rows) {
                if (rows.empty())
                {
                    return RefuseTaken("another process leads");
                }
                _session = ReadCount(rows.front()[0]);
                _number = ReadCount(rows.front()[1]);
                return Core::Result<void>();
            });
    }
};

PostgresPlanStore::PostgresPlanStore(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

PostgresPlanStore::~PostgresPlanStore() = default;

Core::Result<std::unique_ptr<PostgresPlanStore>> PostgresPlanStore::Open(PostgresOptions options, std::uint64_t epoch)
{
    return ReadPostgresURL(options.url).and_then([&](const PostgresTarget& target) {
        auto impl = std::make_unique<Impl>(std::move(options), epoch, target.name);
        return impl->Open().map(
            [&] { return std::unique_ptr<PostgresPlanStore>(new PostgresPlanStore(std::move(impl))); });
    });
}

Core::Result<StoreOrigin> PostgresPlanStore::Inspect(const PostgresOptions& options)
{
    return InspectAs(options, [](PostgresConnection& /*connection*/) { return Core::Result<void>(); });
}

Core::Result<StoredState> PostgresPlanStore::InspectState(const PostgresOptions& options)
{
    StoredState state;
    return InspectAs(
               options,
               [&](PostgresConnection& connection) {
                   return ReadSnapshot(connection, ReadPostgresURL(options.url)->name).map([&](StoredState read) {
                       state = std::move(read);
                   });
               })
        .map([&](const StoreOrigin& /*origin*/) { return std::move(state); });
}

const StoreOrigin& PostgresPlanStore::GetOrigin() const noexcept
{
    return _impl->GetOrigin();
}

const std::string& PostgresPlanStore::GetIdentity() const noexcept
{
    return _impl->GetIdentity();
}

Core::Result<StoredState> PostgresPlanStore::Load()
{
    return _impl->Load();
}

Core::Result<void> PostgresPlanStore::Append(const StoreBatch& batch)
{
    return _impl->Append(batch);
}

Core::Result<void> PostgresPlanStore::Check()
{
    return _impl->Check();
}

StoreLog PostgresPlanStore::CheckLog()
{
    return _impl->CheckLog();
}

} // namespace ACS::Planning
