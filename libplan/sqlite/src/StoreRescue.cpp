#include "StoreRescue.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreGeneration.hpp"
#include "StoreSchema.hpp"

#include <fmt/format.h>
#include <SQLiteCpp/Statement.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace ACS::Planning
{

std::string GetRescuePath(const std::string& database)
{
    return database + ".rescued";
}

Core::Result<void> CopyDatabase(SQLite::Database& database, const std::string& target)
{
    const std::string part = target + ".part";
    try
    {
        std::error_code ignored;
        std::filesystem::remove(part, ignored); // of an attempt that failed
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
        return Refuse(part, "a copy that can be written", DescribeErrno(errno));
    }
    return StoreFiles::Rename(part, target);
}

void RemoveRescued(const std::string& database)
{
    std::error_code ignored;
    std::filesystem::remove(GetRescuePath(database), ignored);
}

Core::Result<void> CheckRescued(const std::string& database)
{
    const std::string copy = GetRescuePath(database);
    if (!StoreFiles::IsThere(copy) || !StoreFiles::IsThere(database))
    {
        return {};
    }
    return Refuse(
        database,
        fmt::format(
            "one database; this one was missing while it was open, and its content was copied to {}: move that file away to "
            "continue with this database, or move this one away, with the files -wal and -shm beside it, to continue with the copy",
            copy),
        "both");
}

Core::Result<bool> RestoreRescued(const std::string& database)
{
    Core::Result<void> checked = CheckRescued(database);
    if (!checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    if (!StoreFiles::IsThere(GetRescuePath(database)))
    {
        return false;
    }
    // The copy has the content of the log. SQLite would apply the log to the copy.
    std::error_code ignored;
    std::filesystem::remove(StoreFiles::GetLogPath(database), ignored);
    std::filesystem::remove(database + "-shm", ignored);
    const std::string path = GetRescuePath(database);
    try
    {
        // The copy is complete: it is marked as open, because it was made then, and has no log.
        SQLite::Database copy(path, SQLite::OPEN_READWRITE);
        RestrictSchema(copy);
        EndGeneration(copy);
        checked = ListGeneration(copy, path);
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, path, "restoring", 0);
    }
    return checked.and_then([&] { return StoreFiles::Rename(path, database); }).map([] { return true; });
}

} // namespace ACS::Planning
