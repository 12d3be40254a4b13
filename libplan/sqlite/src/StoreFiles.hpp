#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <sys/stat.h>

namespace ACS::Planning
{

/// A file of an open store that was removed or replaced.
struct StoreFileChange
{
    bool bOfLog = false;    ///< The file is the write-ahead log; else it is the database.
    bool bReplaced = false; ///< Another file has its name; else it is missing or cannot be accessed.
    std::string found;      ///< Description for an error text.
};

/// The files of a database. An instance detects that the paths no longer lead to the files that were opened: SQLite writes
/// to a removed file without an error, and the changes are lost when it is closed.
class StoreFiles
{
    /// Identifies a file independently of its name.
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

    /// Stores the identities of the database and of its log.
    explicit StoreFiles(std::string database);

    [[nodiscard]] std::optional<StoreFileChange> FindChangeOrNull() const;

    /// Fails if there is a log whose database is missing or empty, because SQLite would delete the log.
    /// EPlanningError::StoreCorrupt.
    [[nodiscard]] static Core::Result<void> CheckLogHasDatabase(const std::string& database);

    [[nodiscard]] static std::string GetLogPath(const std::string& database);

    [[nodiscard]] static std::string GetParent(const std::string& path);
    /// Identifies a file on its file system: inode number and time of creation. A copy of the file has another identity, also if it
    /// gets the inode number; a file that is written or renamed keeps its own. Empty if there is no such file.
    [[nodiscard]] static std::string DescribeIdentity(const std::string& path);

    [[nodiscard]] static bool IsThere(const std::string& path);
    [[nodiscard]] static bool HasContent(const std::string& path);
    /// 0 if there is no such file.
    [[nodiscard]] static std::uint64_t GetSize(const std::string& path);

    /// The URI with which SQLite reads a database without locking it and without creating files. nullopt if the database has a
    /// log: such a database can be read by its path only.
    [[nodiscard]] static std::optional<std::string> MakeImmutableUriOrNull(const std::string& database);

    /// Synchronises a file, or the entries of a directory, to disk. False on failure; the reason is in errno.
    [[nodiscard]] static bool TrySynchronise(const std::string& path);
    [[nodiscard]] static bool TrySynchroniseParent(const std::string& path);

    /// Both are durable on return and atomic: the target has the complete new content or is unchanged.
    /// EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<void> Rename(const std::string& from, const std::string& to);
    [[nodiscard]] static Core::Result<void> Write(const std::string& path, std::string_view text);

private:
    [[nodiscard]] static std::optional<Identity> FindOrNull(const std::string& path);
    [[nodiscard]] static StoreFileChange MakeChange(const std::string& path, bool bOfLog);
};

} // namespace ACS::Planning
