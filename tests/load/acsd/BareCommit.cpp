#include "BareCommit.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

namespace ACS::Load
{

struct BareCommit::Impl
{
    SQLite::Database database;
    std::unique_ptr<SQLite::Statement> insert;

    explicit Impl(const std::string& path)
        : database(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
    {
    }
};

BareCommit::BareCommit(const std::string& path)
    : _impl(std::make_unique<Impl>(path))
{
    _impl->database.exec("PRAGMA journal_mode = WAL");
    _impl->database.exec("PRAGMA synchronous = FULL");
    _impl->database.exec("CREATE TABLE texts (text TEXT)");
    _impl->insert = std::make_unique<SQLite::Statement>(_impl->database, "INSERT INTO texts VALUES (?)");
}

BareCommit::~BareCommit() = default;

void BareCommit::Commit(std::string_view text)
{
    _impl->insert->bind(1, std::string(text));
    _impl->insert->exec();
    _impl->insert->reset();
}

} // namespace ACS::Load
