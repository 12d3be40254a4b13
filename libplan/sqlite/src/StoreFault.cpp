#include "StoreFault.hpp"

#include "StoreFiles.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Masks the primary code of an extended code of SQLite.
constexpr int PRIMARY_CODE = 0xFF;

std::string MakeAdvice(int code)
{
    switch (code)
    {
        case SQLITE_ERROR: // a statement that the tables in the file do not have
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return fmt::format("an undamaged plan store; {}", RESTORE_IT);
        case SQLITE_IOERR:
            return "a disk that reads and writes; check it and the system log, and move the store to another disk if it is "
                   "broken";
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_CANTOPEN:
            return "files that can be written; correct the owner and mode of the store directory and of the files in it";
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return "a database that no other program locks; close that program, such as a sqlite3 shell";
        default:
            return "a file that can be read and written; check it, its directory and its disk";
    }
}

/// Of the file system, or of what this user may use of it.
bool IsDiskFull(int code, int systemError)
{
    return code == SQLITE_FULL || systemError == ENOSPC || systemError == EDQUOT;
}

} // namespace

tl::unexpected<Core::Error> Refuse(
    EPlanningError error,
    const std::string& path,
    std::string expected,
    std::string found)
{
    return Core::Fail(make_error_code(error), path, std::move(expected), std::move(found));
}

tl::unexpected<Core::Error> Refuse(const std::string& path, std::string expected, std::string found)
{
    return Refuse(EPlanningError::StoreFailed, path, std::move(expected), std::move(found));
}

tl::unexpected<Core::Error> RefuseFor(
    const SQLite::Exception& exception,
    const std::string& path,
    std::string_view operation,
    int systemError)
{
    const int code = exception.getErrorCode() & PRIMARY_CODE;
    const bool bOfSystem = code == SQLITE_IOERR || code == SQLITE_CANTOPEN; // otherwise errno is unrelated
    std::string found = fmt::format("{} failed: {}", operation, exception.what());
    if (bOfSystem && systemError != 0)
    {
        found += fmt::format(" ({})", DescribeErrno(systemError));
    }
    if (IsDiskFull(code, bOfSystem ? systemError : 0))
    {
        return Refuse(
            path,
            fmt::format(
                "free space on the disk of {}; delete or move other files of this disk",
                StoreFiles::GetParent(path)),
            std::move(found));
    }
    const bool bCorrupt = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR;
    return Refuse(
        bCorrupt ? EPlanningError::StoreCorrupt : EPlanningError::StoreFailed,
        path,
        MakeAdvice(code),
        std::move(found));
}

std::string DescribeErrno(int reason)
{
    return std::generic_category().message(reason);
}

} // namespace ACS::Planning
