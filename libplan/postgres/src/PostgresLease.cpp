#include "PostgresConnection.hpp"
#include "PostgresFault.hpp"
#include "PostgresSchema.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/plan/LeaseTerm.hpp>
#include <acs/plan_postgres/PostgresLease.hpp>

#include <fmt/format.h>

#include <chrono>
#include <limits>
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

/// A number to which 1 can be added.
bool IsCount(const std::string& text)
{
    const std::int64_t count = Core::ParseNumberOrNull<std::int64_t>(text).value_or(-1);
    return count >= 0 && count < std::numeric_limits<std::int64_t>::max();
}

/// A row that acsd has not written must not make a standby lead too early.
Core::Result<LeaseState> DecodeLease(const std::string& name, const std::vector<SqlRow>& rows)
{
    constexpr std::string_view REMEDY = "; stop all processes, then restore a backup";
    if (rows.size() != 1 || rows.front()[6] != "1")
    {
        return RefuseStore(
            EPlanningError::StoreCorrupt,
            name,
            fmt::format("one row in acsd.lease and one in acsd.batches{}", REMEDY),
            fmt::format("{} and {}", rows.size(), rows.empty() ? "an unknown number" : rows.front()[6]));
    }
    const SqlRow& row = rows.front();
    const std::chrono::milliseconds duration(ReadCount(row[4]));
    const bool bReleased = row[5] == "t";
    const bool bInRange = duration >= LeaseTerm::SHORTEST && duration <= LeaseTerm::LONGEST;
    if (!IsCount(row[0]) || !IsCount(row[1]) || (!bReleased && !bInRange))
    {
        // Without the renewal of a leader, which changes: the same fault has the same text.
        return RefuseStore(
            EPlanningError::StoreCorrupt,
            name,
            fmt::format("a row in acsd.lease that acsd has written{}", REMEDY),
            fmt::format(
                R"(epoch "{}", renewal "{}", duration_ms "{}")",
                row[0],
                IsCount(row[1]) ? "valid" : row[1],
                row[4]));
    }
    return LeaseState{
        static_cast<std::uint64_t>(ReadCount(row[0])),
        static_cast<std::uint64_t>(ReadCount(row[1])),
        row[2],
        row[3],
        duration,
        bReleased};
}

} // namespace

class PostgresLease::Impl
{
    PostgresOptions _options;
    std::optional<PostgresConnection> _connection;
    bool _bMayCreate;

public:
    explicit Impl(PostgresOptions options)
        : _options(std::move(options)),
          _bMayCreate(_options.bMayCreate)
    {
    }

    /// Of the store. The URL is valid once a call has succeeded.
    [[nodiscard]] std::string GetName() const
    {
        return ReadPostgresURL(_options.url)->name;
    }

    [[nodiscard]] Core::Result<void> Connect()
    {
        if (_connection.has_value() && _connection->IsUsable())
        {
            return {};
        }
        return PostgresConnection::Open(_options).and_then([this](PostgresConnection connection) {
            _connection = std::move(connection);
            Core::Result<void> ensured = EnsureTables();
            if (ensured.has_value())
            {
                _bMayCreate = false;
            }
            else
            {
                _connection.reset(); // the next call checks again
            }
            return ensured;
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
        const std::string name = GetName();
        const Core::Result<int> version = ReadPostgresSchema(*_connection, name);
        if (!version.has_value() || *version > 0)
        {
            return version.map([](int) {});
        }
        if (!_bMayCreate)
        {
            return RefuseStore(
                EPlanningError::StoreCorrupt,
                name,
                "the tables that this process has used; restore a backup, or restart all processes to begin with an empty store",
                "an empty database");
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
        ->Query(
            {"SELECT epoch, renewal, holder, config, duration_ms, released, (SELECT count(*) FROM batches) FROM lease",
             {}},
            "reading the lease")
        .and_then([this](const std::vector<SqlRow>& rows) { return DecodeLease(_impl->GetName(), rows); });
}

Core::Result<std::optional<std::uint64_t>> PostgresLease::TryTakeOrNull(const LeaseState& seen, const LeaseClaim& claim)
{
    // The update of the second table waits for a transaction of the former leader; after it, none is stored. The new epoch is higher
    // than that of each former leader, also if the row has been changed by hand.
    return _impl
        ->Query(
            {"WITH taken AS (UPDATE lease SET epoch = greatest(lease.epoch, batches.epoch) + 1, renewal = 0, holder = $3, config = $4, "
             "duration_ms = $5, released = false FROM batches WHERE lease.epoch = $1 AND renewal = $2 RETURNING lease.epoch) "
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
