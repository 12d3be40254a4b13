#include "StoreLog.hpp"

#include <sqlite3.h>

#include <charconv>
#include <exception>
#include <string>

namespace ACS::Planning
{

namespace
{

constexpr int FOLDED_PAGES = 1'000; ///< As SQLite does of itself.
constexpr int READER_BUSY_MILLISECONDS = 1'000;

/// In the table settings.
constexpr const char* NUMBER_NAME = "log_number";

std::string GetFile(const SQLite::Database& database)
{
    return sqlite3_db_filename(database.getHandle(), "main");
}

int NotePages(void* pages, sqlite3* /*database*/, const char* /*name*/, int count)
{
    *static_cast<int*>(pages) = count;
    return SQLITE_OK;
}

} // namespace

StoreLog::StoreLog(SQLite::Database& database, const StoreLock& lock)
    : _database(database),
      _lock(lock),
      _reader(GetFile(database), SQLite::OPEN_READONLY, READER_BUSY_MILLISECONDS),
      _setNumber(database, "INSERT OR REPLACE INTO settings VALUES (?, ?)"),
      _foldAt(FOLDED_PAGES)
{
    sqlite3_wal_hook(_database.getHandle(), NotePages, &_pages);
    static_cast<void>(GetNumber(_database)); // the first look makes the log's file
    Keep(_database, false);
}

StoreLog::~StoreLog()
{
    try
    {
        if (!TryFold())
        {
            Keep(_database, true);
            static_cast<void>(Begin()); // the end of all that is stored: whoever folds that has folded all
        }
    }
    catch (const std::exception&)
    {
        // The mark asks for the log, which stays.
    }
    sqlite3_wal_hook(_database.getHandle(), nullptr, nullptr);
}

Core::Result<void> StoreLog::Begin()
{
    if (_bBegun)
    {
        return {};
    }
    if (sqlite3_get_autocommit(_reader.getHandle()) != 0)
    {
        _reader.exec("BEGIN");
    }
    static_cast<void>(GetNumber(_reader));
    const std::int64_t number = GetNumber(_database) + 1;
    _setNumber.tryReset();
    _setNumber.bind(1, NUMBER_NAME);
    _setNumber.bind(2, std::to_string(number));
    _setNumber.exec();
    _setNumber.reset();
    Core::Result<void> marked = _lock.Mark({number, false});
    _bBegun = marked.has_value();
    return marked;
}

void StoreLog::FoldIfLong()
{
    if (_pages < _foldAt)
    {
        return;
    }
    // What somebody reads for long is not tried again with each transaction.
    _foldAt = TryFold() ? FOLDED_PAGES : _pages + FOLDED_PAGES;
}

bool StoreLog::TryFold()
{
    if (!_lock.Mark({0, true}).has_value())
    {
        return false;
    }
    _bBegun = false;
    if (sqlite3_get_autocommit(_reader.getHandle()) == 0)
    {
        _reader.tryExec("ROLLBACK");
    }
    int pages = 0;
    int folded = 0;
    const int code =
        sqlite3_wal_checkpoint_v2(_database.getHandle(), "main", SQLITE_CHECKPOINT_PASSIVE, &pages, &folded);
    const bool bFolded = code == SQLITE_OK && pages == folded;
    if (bFolded)
    {
        _lock.Unmark();
    }
    return bFolded;
}

std::int64_t StoreLog::GetNumber(SQLite::Database& database)
{
    SQLite::Statement query(database, "SELECT value FROM settings WHERE name = ?");
    query.bind(1, NUMBER_NAME);
    const std::string text = query.executeStep() ? query.getColumn(0).getString() : std::string();
    std::int64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

void StoreLog::Keep(SQLite::Database& database, bool bKept)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the library's own signature
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, bKept ? 1 : 0, nullptr);
}

} // namespace ACS::Planning
