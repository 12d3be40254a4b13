#pragma once

#include "StoreFolder.hpp"
#include <acs/plan/IPlanStore.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>
#include <string>

namespace ACS::Planning::Test
{

/// An empty place for a store in SQLite.
class SqlitePlace
{
    StoreFolder _folder;

public:
    [[nodiscard]] std::unique_ptr<IPlanStore> Open() const
    {
        return OpenStore(_folder.GetStore());
    }

    void Execute(const std::string& sql) const
    {
        SQLite::Database(GetDatabase(_folder.GetStore()), SQLite::OPEN_READWRITE).exec(sql);
    }
};

} // namespace ACS::Planning::Test
