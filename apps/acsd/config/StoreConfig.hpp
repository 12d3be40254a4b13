#pragma once

#include "common/config/ConfigSection.hpp"
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The table `store`, except what the engine uses of it, and `tsc.new_store`.
struct StoreConfig
{
    /// `store.directory`: of a store in SQLite; empty: it is in PostgreSQL.
    std::string directory;
    /// `store.url` and `store.password_file`: a store that several processes share.
    std::optional<Planning::PostgresOptions> postgres;
    /// `store.lease`: a standby takes over when the leader has not renewed it for this time.
    std::chrono::milliseconds lease{3'000};
    /// `store.instance`: the name of this process in the messages of the others.
    std::string instance;
    /// `tsc.new_store` is "paused": with a new store the TSC is Paused until the operator resumes it.
    bool bNewStorePaused = false;

    /// The directory, or the URL without its password.
    [[nodiscard]] std::string GetName() const;
};

/// Reads the keys. With bInspected, checks whether a start could open the store. Does not create, change or lock it.
void ReadStoreConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    bool bInspected,
    StoreConfig& config,
    std::vector<std::string>& warnings);

} // namespace ACS::Acsd
