#include "PostgresConnection.hpp"
#include "PostgresFault.hpp"
#include "PostgresSchema.hpp"
#include <acs/plan_postgres/PostgresLease.hpp>

#include <chrono>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

std::int64_t ToCount(std::uint64_t number)
{
    return static_cast<std::int64_t>(number);
}

} // namespace

class PostgresLease::Impl
{
    PostgresOptions _options;
    std::optional<PostgresConnection> _connection;

public:
    explicit Impl(PostgresOptions options)
        : _options(std::move(options))
    {
    }

    [[nodiscard]] Core::Result<void> Connect()
    {
        if (_connection.has_value() && _connection->IsUsable())
        {
            return {};
        }
        return PostgresConnection::Open(_options).and_then([this](PostgresConnection connection) {
            _connection = std::move(connection);
            return EnsureTables();
        });
    }

    [[nodiscard]] Core::Result<std::vector<SqlRow>> Query(const SqlStatement& statement, std::string_view operation)
    {
        return Connect().and_then([&] { return _connection->Query(statement, operation); });
    }

private:
    /// An older schema is migrated by the process that leads: a leader of that version may be working with it.
    [[nodiscard]] Core::Result<void> EnsureTables()
    {
        const std::string name = ReadPostgresURL(_options.url)->name;
        const Core::Result<int> version = ReadPostgresSchema(*_connection, name);
        if (!version.has_value() || *version > 0)
        {
            return version.map([](int) {});
        }
        Core::Result<void> created = MigratePostgresSchema(*_connection, 0);
        // Another process may have created them at the same time.
        return created.has_value() || ReadPostgresSchema(*_connection, name).value_or(0) == 0 ? created
                                                                                              : Core::Result<void>();
    }
};

PostgresLease::PostgresLease(PostgresOptions options)
    : _impl(std::make_unique<Impl>(std::move(options)))
{
}

PostgresLease::~PostgresLease() = default;

Core::Result<LeaseState> PostgresLease::Read()
{
    return _impl
        ->Query({"SELECT epoch, renewal, holder, config, duration_ms, released FROM lease", {}}, "reading the lease")
        .and_then([](const std::vector<SqlRow>& rows) -> Core::Result<LeaseState> {
            if (rows.empty())
            {
                return RefuseStore(EPlanningError::StoreCorrupt, "lease", "one row; restore a backup", "none");
            }
            const SqlRow& row = rows.front();
            return LeaseState{
                static_cast<std::uint64_t>(ReadCount(row[0])),
                static_cast<std::uint64_t>(ReadCount(row[1])),
                row[2],
                row[3],
                std::chrono::milliseconds(ReadCount(row[4])),
                row[5] == "t"};
        });
}

Core::Result<std::optional<std::uint64_t>> PostgresLease::TryTakeOrNull(const LeaseState& seen, const LeaseClaim& claim)
{
    // The update of the second table waits for a transaction of the former leader; after it, none is stored.
    return _impl
        ->Query(
            {"WITH taken AS (UPDATE lease SET epoch = epoch + 1, renewal = 0, holder = $3, config = $4, duration_ms = $5, "
             "released = false WHERE epoch = $1 AND renewal = $2 RETURNING epoch) "
             "UPDATE batches SET epoch = taken.epoch, session = 0 FROM taken RETURNING batches.epoch",
             {ToCount(seen.epoch), ToCount(seen.renewal), claim.holder, claim.config, claim.duration.count()}},
            "taking the lease")
        .map([](const std::vector<SqlRow>& rows) {
            return rows.empty() ? std::nullopt
                                : std::optional(static_cast<std::uint64_t>(ReadCount(rows.front().front())));
        });
}

Core::Result<bool> PostgresLease::TryRenew(std::uint64_t epoch)
{
    return _impl
        ->Query(
            {"UPDATE lease SET renewal = renewal + 1 WHERE epoch = $1 AND NOT released RETURNING epoch",
             {ToCount(epoch)}},
            "renewing the lease")
        .map([](const std::vector<SqlRow>& rows) { return !rows.empty(); });
}

Core::Result<void> PostgresLease::Release(std::uint64_t epoch)
{
    return _impl->Query({"UPDATE lease SET released = true WHERE epoch = $1", {ToCount(epoch)}}, "releasing the lease")
        .map([](const std::vector<SqlRow>& /*rows*/) {});
}

} // namespace ACS::Planning
