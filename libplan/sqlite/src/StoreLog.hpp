#pragma once

#include "StoreLock.hpp"
#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <cstdint>

namespace ACS::Planning
{

/// The write-ahead log of a store that is open, so that one that was lost is told from one that was folded into the file,
/// by whomever. The first thing in a log is a number, one higher than that of the log before, and the mark beside the store
/// has that number before anything else is stored. What is read at a start, of the file and its log, has at least the
/// number of the mark, or that log was lost.
/// That holds as the number does not come into the file before all of the log does: nobody else folds the log of a program
/// that runs, as a reader stands at its beginning, and while this program does so itself the mark asks for the log.
class StoreLog
{
    SQLite::Database& _database;
    const StoreLock& _lock;
    SQLite::Database _reader; ///< Within a transaction: what is stored after that stays in the log.
    SQLite::Statement _setNumber;
    int _pages = 0;
    int _foldAt;
    bool _bBegun = false; ///< The number is in the log, and in the mark.

public:
    /// The database is in WAL mode and has all tables; both live longer. Throws SQLite::Exception, as all of this class but
    /// the destructor.
    StoreLog(SQLite::Database& database, const StoreLock& lock);
    StoreLog(const StoreLog&) = delete;
    StoreLog& operator=(const StoreLog&) = delete;

    /// Folds the log and takes the mark away. Where others still read the log, the last of them folds it.
    ~StoreLog();

    /// Before each transaction. EPlanningError::StoreFailed where the mark cannot be written.
    [[nodiscard]] Core::Result<void> Begin();

    /// After each transaction, in the place of SQLite's own checkpoints.
    void FoldIfLong();

    /// All that is stored is in the file then, and the next transaction begins a new log. False where others still read
    /// something older, or it cannot be written.
    [[nodiscard]] bool TryFold();

    /// Of the log that was begun last, by what can be read; 0 before the first one.
    [[nodiscard]] static std::int64_t GetNumber(SQLite::Database& database);

    /// Whether the log stays as it is when the database is closed.
    static void Keep(SQLite::Database& database, bool bKept);
};

} // namespace ACS::Planning
