#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan_sqlite/StoreOrigin.hpp>

#include <memory>
#include <string>

namespace ACS::Planning
{

/// Plans in one SQLite file, with a write-ahead log and full synchronisation: what Append returned for is on disk. The
/// schema is brought up to date on opening. One store per file, which a lock on a file beside it (".lock") sees to; one
/// thread.
class SqlitePlanStore final : public IPlanStore
{
    class Impl;
    std::unique_ptr<Impl> _impl;

    explicit SqlitePlanStore(std::unique_ptr<Impl> impl);

public:
    SqlitePlanStore(const SqlitePlanStore&) = delete;
    SqlitePlanStore& operator=(const SqlitePlanStore&) = delete;
    ~SqlitePlanStore() override;

    /// Opens the file, or creates it. Errors, each naming the file: EPlanningError::StoreFailed (no such folder, no
    /// permission, another program has it), StoreCorrupt (damaged, no file of ours, or without the log that it had),
    /// StoreTooNew. A file that is refused is left as it is, and its log too.
    /// Each tells path, what failed with the reason of the system or SQLite, and what to do.
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> Open(const std::string& path);

    /// What Open would find, without making, changing or taking anything; the store may be another program's at that
    /// moment. Errors as of Open, but for who has it.
    [[nodiscard]] static Core::Result<StoreOrigin> Inspect(const std::string& path);

    [[nodiscard]] const StoreOrigin& GetOrigin() const noexcept;

    [[nodiscard]] Core::Result<StoredState> Load() override;
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;

    /// The file, or its write-ahead log, was removed, moved or replaced while it is open: Append fails too, as what it
    /// writes would be lost. All that is stored is copied to the path with ".rescued" at once. The files put back, all goes
    /// on and the copy goes; else the next Open makes the store of the copy, or is refused where there is another file too.
    [[nodiscard]] Core::Result<void> Check() override;
};

} // namespace ACS::Planning
