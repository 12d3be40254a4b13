#pragma once

#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <sys/stat.h>

namespace ACS::Planning
{

/// What has become of a file that is open.
struct StoreFileChange
{
    bool bOfLog = false;    ///< Only the write-ahead log is concerned.
    bool bReplaced = false; ///< Another file has its name; else it is gone, or out of reach.
    std::string found;      ///< The same in words.
};

/// The files of a store as the system sees them: whether they can be one, and whether what is open is still what the path
/// leads to. A file that was removed while it is open can be written without an error, and is gone at the end.
class StoreFiles
{
    /// Which file it is, whatever it is called.
    struct Identity
    {
        dev_t device = 0;
        ino_t number = 0;

        bool operator==(const Identity&) const = default;
    };

    std::string _path;
    std::string _logPath; ///< Of the write-ahead log: beside the file, where the path is a link.
    std::optional<Identity> _store;
    std::optional<Identity> _log;

public:
    StoreFiles() = default;

    /// What the path leads to now: the database has just been opened by it.
    StoreFiles(std::string path, std::string logPath);

    /// Where the path does not lead to the files any more that were opened.
    [[nodiscard]] std::optional<StoreFileChange> FindChangeOrNull() const;

    /// Whether a store is there that this program may write, or can be made. EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<void> CheckUsable(const std::string& path);

    /// What is stored last stands in the log: SQLite throws one away that has no store, or an empty one.
    /// EPlanningError::StoreCorrupt.
    [[nodiscard]] static Core::Result<void> CheckLogHasStore(const std::string& path);

    /// What a path leads to: by each link to it a store is the same one, and its other files are beside it.
    [[nodiscard]] static std::string Resolve(const std::string& path);

    /// Of the write-ahead log.
    [[nodiscard]] static std::string GetLogPath(const std::string& path);

    /// Whether there is a file that is not empty, and no log beside it.
    [[nodiscard]] static bool HasOnlyStore(const std::string& path);

    /// By which SQLite reads a store without locking it or making a file beside it. nullopt where it has a log: what stands
    /// in that is read by the path only.
    [[nodiscard]] static std::optional<std::string> MakeUntouchedUriOrNull(const std::string& path);

    /// A file, or the names in a folder: on disk when it returns. Else the reason is in errno.
    [[nodiscard]] static bool TrySynchronise(const std::string& path);

    /// The names in the folder of a file.
    [[nodiscard]] static bool TrySynchroniseFolder(const std::string& path);

private:
    [[nodiscard]] static std::optional<Identity> FindOrNull(const std::string& path);
    [[nodiscard]] static StoreFileChange MakeChange(const std::string& path, bool bOfLog);
};

} // namespace ACS::Planning
