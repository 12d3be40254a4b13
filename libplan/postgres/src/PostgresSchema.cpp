#include "PostgresSchema.hpp"

#include "PostgresFault.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

namespace ACS::Planning
{

namespace
{

/// Of the advisory lock that is held while the schema is changed: "acsd".
constexpr std::int64_t SCHEMA_LOCK = 0x61637364;

/// Entry n migrates version n to n + 1. A released entry must not be changed; append a new one. Identifiers sort as bytes, as in
/// the store in SQLite.
constexpr std::array MIGRATIONS{std::string_view(R"sql(
CREATE TABLE acsd.plans (sequence bigint PRIMARY KEY, plan_id text COLLATE "C" NOT NULL UNIQUE, accepted_at bigint NOT NULL,
  plan text NOT NULL, state text NOT NULL, progress text NOT NULL, transaction_id text NOT NULL);
CREATE TABLE acsd.reports (sequence bigint PRIMARY KEY, transaction_id text COLLATE "C" NOT NULL UNIQUE, time bigint NOT NULL,
  report text NOT NULL);
CREATE TABLE acsd.carriers (robot_id text COLLATE "C" PRIMARY KEY, carriers text NOT NULL);
CREATE TABLE acsd.alarms (robot_id text COLLATE "C" NOT NULL, error_code text COLLATE "C" NOT NULL,
  plan_id text COLLATE "C" NOT NULL, job_id text COLLATE "C" NOT NULL, alarm text NOT NULL,
  PRIMARY KEY (robot_id, error_code, plan_id, job_id));
CREATE TABLE acsd.settings (name text COLLATE "C" PRIMARY KEY, value text NOT NULL);
CREATE TABLE acsd.robot_works (robot_id text COLLATE "C" PRIMARY KEY, work text NOT NULL);
CREATE TABLE acsd.maintenance (robot_id text COLLATE "C" PRIMARY KEY);
CREATE TABLE acsd.blocks (sequence bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, kind text COLLATE "C" NOT NULL,
  id text COLLATE "C" NOT NULL, block text NOT NULL, UNIQUE (kind, id));
CREATE TABLE acsd.receipts (sequence bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, owner text NOT NULL, key text NOT NULL,
  answer text NOT NULL, time bigint NOT NULL);

-- Which process leads. One row, as in the next table.
CREATE TABLE acsd.lease (one boolean PRIMARY KEY DEFAULT true CHECK (one), epoch bigint NOT NULL DEFAULT 0,
  renewal bigint NOT NULL DEFAULT 0, holder text NOT NULL DEFAULT '', config text NOT NULL DEFAULT '',
  duration_ms bigint NOT NULL DEFAULT 0, released boolean NOT NULL DEFAULT true);
INSERT INTO acsd.lease DEFAULT VALUES;

-- Each transaction of the leader changes this row: its lock keeps others from taking the store meanwhile, and its number shows
-- after a lost connection whether a transaction was stored. A session is one connection of the leader.
CREATE TABLE acsd.batches (one boolean PRIMARY KEY DEFAULT true CHECK (one), epoch bigint NOT NULL DEFAULT 0,
  session bigint NOT NULL DEFAULT 0, number bigint NOT NULL DEFAULT 0, last_report bigint NOT NULL DEFAULT 0);
INSERT INTO acsd.batches DEFAULT VALUES;
INSERT INTO acsd.settings VALUES ('identity', gen_random_uuid());

CREATE FUNCTION acsd.begin_batch(epoch_ bigint, session_ bigint, last_report_ bigint) RETURNS void LANGUAGE plpgsql AS $$
BEGIN
  UPDATE acsd.batches SET number = number + 1, last_report = greatest(last_report, last_report_)
    WHERE epoch = epoch_ AND session = session_;
  IF NOT FOUND THEN
    RAISE EXCEPTION 'another process leads, or this one has connected again' USING ERRCODE = 'ACS01';
  END IF;
END $$;
)sql")};

} // namespace

namespace
{

/// A standby that can read the tables and not write them would only learn it when it has to lead.
Core::Result<void> CheckRights(PostgresConnection& connection, const std::string& name)
{
    return connection
        .Query(
            {"SELECT string_agg(relname, ', ' ORDER BY relname) FROM pg_class WHERE relnamespace = 'acsd'::regnamespace AND relkind = 'r' "
             "AND NOT (has_table_privilege(oid, 'SELECT') AND has_table_privilege(oid, 'INSERT') "
             "AND has_table_privilege(oid, 'UPDATE') AND has_table_privilege(oid, 'DELETE'))",
             {}},
            "reading the rights")
        .and_then([&name](const std::vector<SqlRow>& rows) -> Core::Result<void> {
            const std::string& tables = rows.front().front();
            if (tables.empty())
            {
                return {};
            }
            return RefuseStore(
                EPlanningError::StoreFailed,
                name,
                "a role that may read and write all tables of the schema acsd; give the role that owns them",
                "a role that may not write " + tables);
        });
}

} // namespace

int GetNewestPostgresSchema() noexcept
{
    return static_cast<int>(MIGRATIONS.size());
}

Core::Result<int> ReadPostgresSchema(PostgresConnection& connection, const std::string& name)
{
    constexpr std::string_view OPERATION = "reading the schema";
    const Core::Result<std::vector<SqlRow>> found = connection.Query(
        {"SELECT current_setting('server_encoding'), to_regclass('acsd.settings') IS NOT NULL, "
         "(SELECT count(*) FROM pg_class WHERE relnamespace = to_regnamespace('acsd'))",
         {}},
        OPERATION);
    if (!found.has_value())
    {
        return tl::unexpected(found.error());
    }
    const SqlRow& row = found->front();
    if (row[0] != "UTF8")
    {
        return RefuseStore(
            EPlanningError::StoreFailed,
            name,
            "a database with the encoding UTF8; create one with createdb --encoding=UTF8 --template=template0",
            "the encoding " + row[0]);
    }
    if (row[1] == "f")
    {
        if (row[2] == "0")
        {
            return 0;
        }
        return RefuseStore(
            EPlanningError::StoreCorrupt,
            name,
            "a schema acsd of a plan store; give another database",
            "a schema acsd of another program");
    }
    return connection.Query({"SELECT value FROM acsd.settings WHERE name = 'schema_version'", {}}, OPERATION)
        .and_then([&](const std::vector<SqlRow>& rows) -> Core::Result<int> {
            const std::string text = rows.empty() ? "none" : rows.front().front();
            int version = 0;
            std::from_chars(text.data(), text.data() + text.size(), version);
            if (version <= 0)
            {
                return RefuseStore(
                    EPlanningError::StoreCorrupt,
                    name,
                    "a version of the schema; restore a backup",
                    "the version " + text);
            }
            if (version > GetNewestPostgresSchema())
            {
                return RefuseStore(
                    EPlanningError::StoreTooNew,
                    name,
                    fmt::format(
                        "a schema up to version {}; start the newer program that wrote it, or restore a backup made before the "
                        "upgrade",
                        GetNewestPostgresSchema()),
                    fmt::format("version {}", version));
            }
            return CheckRights(connection, name).map([version] { return version; });
        });
}

Core::Result<void> MigratePostgresSchema(PostgresConnection& connection, int fromVersion)
{
    // One transaction. A process that waited for the lock of another finds the tables of that one, fails and reads again.
    std::string script = fmt::format("BEGIN; SELECT pg_advisory_xact_lock({});", SCHEMA_LOCK);
    if (fromVersion == 0)
    {
        // The right to create it is not needed if it exists.
        script += "DO $$ BEGIN IF to_regnamespace('acsd') IS NULL THEN CREATE SCHEMA acsd; END IF; END $$;";
    }
    for (auto version = static_cast<std::size_t>(fromVersion); version < MIGRATIONS.size(); ++version)
    {
        script += MIGRATIONS[version];
    }
    script += fmt::format(
        "INSERT INTO acsd.settings (name, value) VALUES ('schema_version', '{}') "
        "ON CONFLICT (name) DO UPDATE SET value = excluded.value; COMMIT",
        GetNewestPostgresSchema());
    Core::Result<void> migrated = connection.RunScript(script, "creating the tables");
    if (!migrated.has_value() && connection.IsUsable())
    {
        std::ignore = connection.RunScript("ROLLBACK", "ending a transaction");
    }
    return migrated;
}

} // namespace ACS::Planning
