#pragma once

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

// What the tests of a store's files share.

namespace ACS::Planning::Test
{

/// Of the schema.
inline constexpr int NEWEST = 3;

class StoreFolder : public Testing::TemporaryFolder
{
public:
    [[nodiscard]] std::string GetFile(const std::string& name = "acsd.db") const
    {
        return (GetPath() / name).string();
    }

    [[nodiscard]] std::vector<std::string> ListNames() const
    {
        std::vector<std::string> names;
        for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(GetPath()))
        {
            names.push_back(entry.path().filename().string());
        }
        std::ranges::sort(names);
        return names;
    }
};

inline std::unique_ptr<SqlitePlanStore> OpenStore(const std::string& file)
{
    Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(file);
    INFO((store.has_value() ? std::string() : Core::Describe(store.error())));
    REQUIRE(store.has_value());
    return std::move(*store);
}

inline StoreBatch MakeBatch(const std::string& robotID)
{
    return {{MaintenanceChanged{robotID, true}}};
}

inline std::vector<std::string> LoadRobots(SqlitePlanStore& store)
{
    return store.Load()->robotsInMaintenance;
}

inline bool Contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace ACS::Planning::Test
