#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan_sqlite/StoreOrigin.hpp>

#include <memory>
#include <string>

namespace ACS::Planning
{

/// Plans in a SQLite database, with a write-ahead log and full synchronisation: what Append returned for is on disk. The
/// store owns a directory of mode 0700 and locks it while it is open: one store per directory. The database is `acsd.db` in
/// it. Used by one thread.
class SqlitePlanStore final : public IPlanStore
{
    class Impl;
    std::unique_ptr<Impl> _impl;

    explicit SqlitePlanStore(std::unique_ptr<Impl> impl);

public:
    SqlitePlanStore(const SqlitePlanStore&) = delete;
    SqlitePlanStore& operator=(const SqlitePlanStore&) = delete;
    ~SqlitePlanStore() override;

    /// Opens the store, or creates it; its parent directory must exist. The schema is brought up to date. A path to a
    /// database of the former layout (a file with `.lock` beside it) is migrated to a directory; the former files are kept
    /// with `.former` in their names.
    /// Errors: EPlanningError::StoreFailed (no such directory, no permission, open in another program), StoreCorrupt
    /// (damaged, not a plan store, or its log is missing), StoreTooNew. Each names the file, the reason of the system or
    /// of SQLite, and the remedy. A database that is refused is left unchanged, and its log too.
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> Open(const std::string& directory);

    /// What Open would find, without creating or changing a file; another program may have the store open. Errors as of
    /// Open, except that no lock is taken.
    [[nodiscard]] static Core::Result<StoreOrigin> Inspect(const std::string& directory);

    [[nodiscard]] const StoreOrigin& GetOrigin() const noexcept;

    [[nodiscard]] Core::Result<StoredState> Load() override;
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;

    /// Fails when the database or its log was removed, moved or replaced while it is open. Append fails too, because its
    /// changes would be lost. The stored state is copied to `acsd.db.rescued` at once. When the files are back, the store
    /// works again and the copy is deleted; else the next Open restores the copy, or is refused if there is another
    /// database too.
    [[nodiscard]] Core::Result<void> Check() override;
};

} // namespace ACS::Planning
