#include "StoreRescue.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreLock.hpp"

#include <fmt/format.h>
#include <SQLiteCpp/Statement.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace ACS::Planning
{

namespace
{

tl::unexpected<Core::Error> RefuseCopy(const std::string& path, const std::error_code& reason)
{
    return Refuse(EPlanningError::StoreFailed, path, "a copy that can be written", reason.message());
}

/// A name that is whole or not there at all.
Core::Result<void> Rename(const std::string& from, const std::string& to)
{
    std::error_code failed;
    std::filesystem::rename(from, to, failed);
    if (!failed && !StoreFiles::TrySynchroniseFolder(to))
    {
        failed = std::error_code(errno, std::generic_category());
    }
    return failed ? Core::Result<void>(RefuseCopy(to, failed)) : Core::Result<void>();
}

bool IsThere(const std::string& path)
{
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

} // namespace

std::string GetRescuePath(const std::string& storePath)
{
    return storePath + ".rescued";
}

Core::Result<void> RescueStore(SQLite::Database& database, const std::string& storePath)
{
    const std::string part = GetRescuePath(storePath) + ".part";
    try
    {
        std::error_code ignored;
        std::filesystem::remove(part, ignored); // of a try that failed
        SQLite::Statement copy(database, "VACUUM INTO ?");
        copy.bind(1, part);
        copy.exec();
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, part, "copying", errno);
    }
    if (!StoreFiles::TrySynchronise(part))
    {
        return RefuseCopy(part, std::error_code(errno, std::generic_category()));
    }
    return Rename(part, GetRescuePath(storePath));
}

void ForgetRescued(const std::string& storePath)
{
    std::error_code ignored;
    std::filesystem::remove(GetRescuePath(storePath), ignored);
}

Core::Result<void> CheckRescued(const std::string& storePath)
{
    const std::string copy = GetRescuePath(storePath);
    if (!IsThere(copy) || !IsThere(storePath))
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreFailed,
        storePath,
        fmt::format(
            "one store; the file was gone while it was open, and what it held was copied to {}: move that away to go on with "
            "this one, or this one with the files -wal and -shm beside it to go on with what was copied",
            copy),
        "both");
}

Core::Result<bool> TakeUpRescued(const std::string& storePath)
{
    if (Core::Result<void> checked = CheckRescued(storePath); !checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    if (!IsThere(GetRescuePath(storePath)))
    {
        return false;
    }
    const Core::Result<StoreLock> lock = StoreLock::Acquire(storePath);
    if (!lock.has_value())
    {
        return tl::unexpected(lock.error());
    }
    // What they hold is in the copy, and SQLite would take them for logs of it.
    std::error_code ignored;
    std::filesystem::remove(storePath + "-wal", ignored);
    std::filesystem::remove(storePath + "-shm", ignored);
    lock->Unmark();
    Core::Result<void> renamed = Rename(GetRescuePath(storePath), storePath);
    if (!renamed.has_value())
    {
        return tl::unexpected(std::move(renamed.error()));
    }
    return true;
}

} // namespace ACS::Planning
