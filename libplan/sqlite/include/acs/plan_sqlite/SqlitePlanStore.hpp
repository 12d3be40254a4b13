#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

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
    /// permission, another program has it), StoreCorrupt (damaged, or no file of ours), StoreTooNew. A file that is
    /// refused is left as it is.
    [[nodiscard]] static Core::Result<std::unique_ptr<SqlitePlanStore>> Open(const std::string& path);

    [[nodiscard]] Core::Result<StoredState> Load() override;
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;
};

} // namespace ACS::Planning
