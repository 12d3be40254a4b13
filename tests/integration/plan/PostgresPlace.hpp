#pragma once

#include "Catch.hpp"
#include "PostgresServer.hpp"
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan_postgres/PostgresLease.hpp>
#include <acs/plan_postgres/PostgresPlanStore.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace ACS::Planning::Test
{

/// The server of all tests of this program, with the default settings, and so with fsync.
inline Testing::PostgresServer& GetServer()
{
    static Testing::PostgresServer server;
    return server;
}

/// An empty database.
class PostgresPlace
{
    std::string _database;

public:
    PostgresPlace()
    {
        static std::atomic<int> number = 0;
        _database = "store" + std::to_string(++number);
        GetServer().Execute("CREATE DATABASE " + _database);
    }

    [[nodiscard]] const std::string& GetDatabase() const noexcept
    {
        return _database;
    }

    [[nodiscard]] PostgresOptions GetOptions() const
    {
        return {GetServer().GetURL(_database), {}, std::chrono::seconds(5)};
    }

    /// The options for a port that leads to the server.
    [[nodiscard]] PostgresOptions GetOptions(std::uint16_t port) const
    {
        return {Testing::PostgresServer::GetURL(_database, port), {}, std::chrono::seconds(5)};
    }

    [[nodiscard]] std::unique_ptr<PostgresLease> OpenLease() const
    {
        auto lease = std::make_unique<PostgresLease>(GetOptions());
        const Core::Result<LeaseState> state = lease->Read();
        INFO((state.has_value() ? std::string() : Core::Describe(state.error())));
        REQUIRE(state.has_value());
        return lease;
    }

    /// Takes the lease from any process that has it. Returns the epoch.
    [[nodiscard]] std::uint64_t Take() const
    {
        const std::unique_ptr<PostgresLease> lease = OpenLease();
        const Core::Result<LeaseState> state = lease->Read();
        REQUIRE(state.has_value());
        const auto taken = lease->TryTakeOrNull(*state, {"a test", "config", std::chrono::seconds(3)});
        INFO((taken.has_value() ? std::string() : Core::Describe(taken.error())));
        REQUIRE(taken.has_value());
        REQUIRE(taken->has_value());
        return **taken;
    }

    [[nodiscard]] std::unique_ptr<PostgresPlanStore> OpenWith(const PostgresOptions& options) const
    {
        Core::Result<std::unique_ptr<PostgresPlanStore>> store = PostgresPlanStore::Open(options, Take());
        INFO((store.has_value() ? std::string() : Core::Describe(store.error())));
        REQUIRE(store.has_value());
        return std::move(*store);
    }

    [[nodiscard]] std::unique_ptr<IPlanStore> Open() const
    {
        return OpenWith(GetOptions());
    }

    // NOLINTNEXTLINE(modernize-use-nodiscard): most statements have no result
    std::string Execute(const std::string& sql) const
    {
        return GetServer().Execute("SET search_path TO acsd; " + sql, _database);
    }
};

} // namespace ACS::Planning::Test
