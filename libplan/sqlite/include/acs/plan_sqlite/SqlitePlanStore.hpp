#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/StoreOrigin.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// Plan store in a SQLite database with a write-ahead log and full synchronisation: changes are on disk when Append returns.
/// The store has a directory of its own with mode 0700 and the database `acsd.db`. The directory is locked while the store is
/// open. Used by one thread.
class ACS_API SqlitePlanStore final : public IPlanStore
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

    explicit SqlitePlanStore(std::unique_ptr<Impl> impl);

public:
    SqlitePlanStore(const SqlitePlanStore&) = delete;
    SqlitePlanStore& operator=(const SqlitePlanStore&) = delete;
    ~SqlitePlanStore() override;

    /// Opens or creates the store; its parent directory must exist. An older schema is migrated. If the path is a database of
    /// the former layout (a file with `.lock` beside it), it is migrated to a directory, and the former files are kept with
    /// `.former` in their names.
    /// Errors: EPlanningError::StoreFailed (no such directory, no permission), StoreTaken (open in another program), StoreCorrupt
    /// (damaged, not a plan store, its log is missing, or the database was not used last in this directory), StoreTooNew. Each names the file, the reason of the system or
    /// of SQLite, and the remedy. A refused database and its log are left unchanged.
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> Open(const std::string& directory);

    /// Opens a store that Open refuses because its database was restored or copied, or because its log is missing. Its work is
    /// held for this reason (StoredState::holdReason). Errors as of Open; also if there is no database.
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> Accept(
        const std::string& directory,
        const std::string& holdReason);

    /// Checks what Open would find, without locking, creating or changing a file; another program may have the store open.
    /// Errors as of Open, except that of a locked store.
    [[nodiscard]] static Core::Result<StoreOrigin> Inspect(const std::string& directory);

    /// Likewise, and reads the content; empty for a store that is new, rescued, or of an older schema.
    [[nodiscard]] static Core::Result<StoredState> InspectState(const std::string& directory);

    /// What Open or Accept has found.
    [[nodiscard]] const StoreOrigin& GetOrigin() const noexcept;

    [[nodiscard]] Core::Result<StoredState> Load() override;
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;

    /// Fails if the database or its log was removed, moved or replaced while open; Append fails too, because its changes would
    /// be lost. The content of such a database is copied to `acsd.db.rescued` immediately; that of such a log is merged into the
    /// database. When the files are back, the store works again and the copy is deleted. Otherwise the next Open restores the
    /// copy, or fails if there is another database. A directory that replaces the one that was opened is locked too;
    /// EPlanningError::StoreTaken if another program has locked it: the store must not be used any more.
    [[nodiscard]] Core::Result<void> Check() override;

    /// A log of more than 8 MiB is merged into the database, without waiting for other programs; SQLite itself does so from
    /// 4 MiB on, with each commit. It cannot be merged while another program reads an older state of the database.
    [[nodiscard]] StoreLog CheckLog() override;

private:
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> OpenAs(
        const std::string& directory,
        const std::optional<std::string>& holdReasonOrNull);
    [[nodiscard]] static Core::Result<StoreOrigin> InspectAs(
        const std::string& directory,
        const std::function<Core::Result<void>(Impl&)>& read);
};

} // namespace ACS::Planning
