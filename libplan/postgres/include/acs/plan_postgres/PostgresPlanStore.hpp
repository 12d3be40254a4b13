#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/StoreOrigin.hpp>
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace ACS::Planning
{

/// Plan store in the schema `acsd` of a PostgreSQL database (14 or later), for the process that has the lease: every transaction
/// checks its epoch. The changes are durable when Append returns, on the synchronous standbys of the server too, if it has some.
/// A lost connection is made again; if it was lost during a commit, the store reads whether that was stored. Used by one thread.
class ACS_API PostgresPlanStore final : public IPlanStore
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

    explicit PostgresPlanStore(std::unique_ptr<Impl> impl);

public:
    PostgresPlanStore(const PostgresPlanStore&) = delete;
    PostgresPlanStore& operator=(const PostgresPlanStore&) = delete;
    ~PostgresPlanStore() override;

    /// Opens the store with the epoch that the lease was taken with (PostgresLease), and migrates an older schema. Errors:
    /// EPlanningError::StoreFailed, StoreCorrupt, StoreTooNew; StoreTaken if another process has taken the lease since.
    [[nodiscard]] static Core::Result<std::unique_ptr<PostgresPlanStore>> Open(
        PostgresOptions options,
        std::uint64_t epoch);

    /// Checks what Open would find, without changing anything. Errors as of Open, except StoreTaken.
    [[nodiscard]] static Core::Result<StoreOrigin> Inspect(const PostgresOptions& options);

    /// Likewise, and reads the content; empty for a store that is new or of an older schema.
    [[nodiscard]] static Core::Result<StoredState> InspectState(const PostgresOptions& options);

    /// What Open has found.
    [[nodiscard]] const StoreOrigin& GetOrigin() const noexcept;

    /// A random name that the store got when it was created: the same for all processes that share it.
    [[nodiscard]] const std::string& GetIdentity() const noexcept;

    [[nodiscard]] Core::Result<StoredState> Load() override;

    /// StoreTaken also if the server cannot be reached after a connection was lost during a commit: whether the changes were
    /// stored is unknown, and only the next start reads it.
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;

    /// Whether the server answers and the epoch is still the present one.
    [[nodiscard]] Core::Result<void> Check() override;

    /// The log of the server is the concern of its administrator: always small.
    [[nodiscard]] StoreLog CheckLog() override;
};

} // namespace ACS::Planning
