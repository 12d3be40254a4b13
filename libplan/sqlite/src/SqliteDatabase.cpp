#include "SqliteDatabase.hpp"

#include "StoreFault.hpp"

#include <cerrno>
#include <utility>
#include <variant>

namespace ACS::Planning
{

SqliteDatabase::SqliteDatabase(SQLite::Database& database, const std::string& path)
    : _database(database),
      _path(path)
{
}

Core::Result<void> SqliteDatabase::Run(std::string_view text, const std::vector<SqlValue>& values)
{
    errno = 0;
    try
    {
        Execute(text, values);
        return {};
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _path, "writing", errno);
    }
}

Core::Result<std::vector<SqlRow>> SqliteDatabase::Query(std::string_view text)
{
    try
    {
        std::vector<SqlRow> rows;
        SQLite::Statement query(_database, std::string(text));
        while (query.executeStep())
        {
            SqlRow& row = rows.emplace_back();
            for (int column = 0; column < query.getColumnCount(); ++column)
            {
                row.push_back(query.getColumn(column).getString());
            }
        }
        return rows;
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _path, "reading", 0);
    }
}

/// Resets the statement before and after: it may have failed the last time, and it must not keep a lock.
void SqliteDatabase::Execute(std::string_view text, const std::vector<SqlValue>& values)
{
    auto found = _statements.find(text);
    if (found == _statements.end())
    {
        std::string key(text);
        SQLite::Statement prepared(_database, key);
        found = _statements.emplace(std::move(key), std::move(prepared)).first;
    }
    SQLite::Statement& statement = found->second;
    statement.tryReset();
    int position = 0;
    for (const SqlValue& value : values)
    {
        ++position;
        std::visit([&](const auto& bound) { statement.bind(position, bound); }, value);
    }
    statement.exec();
    statement.reset();
}

} // namespace ACS::Planning
