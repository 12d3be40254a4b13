#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ILease.hpp>
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace ACS::Planning
{

/// The lease of a store in PostgreSQL, on a connection of its own, so that it is renewed while the store writes. The next call
/// makes a lost connection again.
class ACS_API PostgresLease final : public ILease
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// Opens no connection. The first call creates the tables in an empty database, unless the options forbid it. Tables that are
    /// missing later are not created again, because the plans in them are lost. With an invalid URL every call fails.
    explicit PostgresLease(PostgresOptions options);
    PostgresLease(const PostgresLease&) = delete;
    PostgresLease& operator=(const PostgresLease&) = delete;
    ~PostgresLease() override;

    [[nodiscard]] Core::Result<LeaseState> Read() override;
    [[nodiscard]] Core::Result<std::optional<std::uint64_t>> TryTakeOrNull(
        const LeaseState& seen,
        const LeaseClaim& claim) override;
    [[nodiscard]] Core::Result<bool> TryRenew(std::uint64_t epoch) override;
    [[nodiscard]] Core::Result<void> Release(std::uint64_t epoch) override;
};

} // namespace ACS::Planning
