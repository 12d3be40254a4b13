#pragma once

#include <acs/plan/IPlanStore.hpp>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <map>
#include <string>

namespace ACS::Planning
{

/// Writes changes into the tables. Throws SQLite::Exception.
class ChangeWriter
{
    SQLite::Database& _database;
    std::map<std::string, SQLite::Statement> _statements; ///< Prepared statements by their text.

public:
    /// The database must have the newest schema and outlive the writer.
    explicit ChangeWriter(SQLite::Database& database);

    void Write(const StoreChange& change);

private:
    template <typename... TValues>
    void Run(const char* text, const TValues&... values);
};

} // namespace ACS::Planning
