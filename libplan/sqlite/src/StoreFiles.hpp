#pragma once

#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <sys/stat.h>

namespace ACS::Planning
{

/// How the files of an open store have changed.
struct StoreFileChange
{
    bool bOfLog = false;    ///< Only the write-ahead log is concerned.
    bool bReplaced = false; ///< Another file has its name; else it is missing or cannot be reached.
    std::string found;      ///< The same as text.
};

/// The files of a database. An instance detects that the paths no longer lead to the files that were opened: SQLite writes
/// to a removed file without an error, and the changes are lost when it is closed.
class StoreFiles
{
    /// A file whatever its name is.
    struct Identity
    {
        dev_t device = 0;
        ino_t number = 0;

        bool operator==(const Identity&) const = default;
    };

    std::string _database;
    std::optional<Identity> _databaseFile;
    std::optional<Identity> _logFile;

public:
    StoreFiles() = default;

    /// Remembers the files to which the paths lead now.
    explicit StoreFiles(std::string database);

    [[nodiscard]] std::optional<StoreFileChange> FindChangeOrNull() const;

    /// SQLite deletes a log whose database is missing or empty. EPlanningError::StoreCorrupt.
    [[nodiscard]] static Core::Result<void> CheckLogHasDatabase(const std::string& database);

    /// Of the write-ahead log.
    [[nodiscard]] static std::string GetLogPath(const std::string& database);

    [[nodiscard]] static std::string GetParent(const std::string& path);
    [[nodiscard]] static bool IsThere(const std::string& path);
    [[nodiscard]] static bool HasContent(const std::string& path);

    /// With which SQLite reads a database without locking it or creating a file beside it; nullopt for one with a log,
    /// which is read by its path only.
    [[nodiscard]] static std::optional<std::string> MakeImmutableUriOrNull(const std::string& database);

    /// A file, or the names in a directory: on disk on return. Else the reason is in errno.
    [[nodiscard]] static bool TrySynchronise(const std::string& path);
    [[nodiscard]] static bool TrySynchroniseParent(const std::string& path);

    /// Both on disk on return, and the file complete or unchanged. EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<void> Rename(const std::string& from, const std::string& to);
    [[nodiscard]] static Core::Result<void> Write(const std::string& path, std::string_view text);

private:
    [[nodiscard]] static std::optional<Identity> FindOrNull(const std::string& path);
    [[nodiscard]] static StoreFileChange MakeChange(const std::string& path, bool bOfLog);
};

} // namespace ACS::Planning
