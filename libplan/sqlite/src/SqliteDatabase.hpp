#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/ISqlDatabase.hpp>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// A database of SQLite as the tables of a plan store need it. Statements are prepared once.
class SqliteDatabase final : public ISqlDatabase
{
    SQLite::Database& _database;
    const std::string& _path;
    std::map<std::string, SQLite::Statement, std::less<>> _statements; ///< By their texts.

public:
    /// The database must have the newest schema; both must outlive this object.
    SqliteDatabase(SQLite::Database& database, const std::string& path);

    [[nodiscard]] Core::Result<void> Run(std::string_view text, const std::vector<SqlValue>& values) override;
    [[nodiscard]] Core::Result<std::vector<SqlRow>> Query(std::string_view text) override;

private:
    void Execute(std::string_view text, const std::vector<SqlValue>& values);
};

} // namespace ACS::Planning
