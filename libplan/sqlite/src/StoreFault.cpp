#include "StoreFault.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <system_error>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Of an extended code of SQLite the kind of failure.
constexpr int PRIMARY_CODE = 0xFF;

std::string MakeAdvice(int code)
{
    switch (code)
    {
        case SQLITE_ERROR: // a statement that does not fit what stands in the file
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return fmt::format("an undamaged plan store; {}", RESTORE_IT);
        case SQLITE_FULL:
            return "room on its disk; free some";
        case SQLITE_IOERR:
            return "a disk that reads and writes; look at it and at the system's log, and move the store to another one if "
                   "it is broken";
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_CANTOPEN:
            return "a file that can be written, as can those with -wal and -shm beside it; correct their owner and rights, "
                   "and those of their folder";
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return "a store that no other program locks; close that one, such as a shell of sqlite3";
        default:
            return "a file that can be read and written; look at it, its folder and its disk";
    }
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

tl::unexpected<Core::Error> RefuseFor(
    const SQLite::Exception& exception,
    const std::string& path,
    std::string_view doing,
    int systemError)
{
    const int code = exception.getErrorCode() & PRIMARY_CODE;
    const bool bOfSystem = code == SQLITE_IOERR || code == SQLITE_CANTOPEN; // only then SQLite notes it
    std::string found = fmt::format("{} failed: {}", doing, exception.what());
    if (bOfSystem && systemError != 0)
    {
        found += fmt::format(" ({})", std::generic_category().message(systemError));
    }
    const bool bCorrupt = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR;
    return Refuse(
        bCorrupt ? EPlanningError::StoreCorrupt : EPlanningError::StoreFailed,
        path,
        MakeAdvice(code),
        std::move(found));
}

} // namespace ACS::Planning
