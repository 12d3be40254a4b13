#pragma once

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

// Shared by the tests of a store's files.

namespace ACS::Planning::Test
{

/// The version of the schema.
inline constexpr int NEWEST = 4;

class StoreFolder : public Testing::TemporaryFolder
{
public:
    [[nodiscard]] std::string GetStore(const std::string& name = "store") const
    {
        return (GetPath() / name).string();
    }

    [[nodiscard]] std::vector<std::string> ListNames() const
    {
        return ListNamesIn(GetPath().string());
    }

    [[nodiscard]] static std::vector<std::string> ListNamesIn(const std::string& directory)
    {
        std::vector<std::string> names;
        for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(directory))
        {
            names.push_back(entry.path().filename().string());
        }
        std::ranges::sort(names);
        return names;
    }
};

inline std::string GetDatabase(const std::string& store)
{
    return store + "/acsd.db";
}

inline std::string GetLog(const std::string& store)
{
    return store + "/acsd.db-wal";
}

inline std::string GetGeneration(const std::string& store)
{
    return store + "/generation";
}

/// Of mode 0700.
inline void MakeDirectory(const std::string& path)
{
    std::filesystem::create_directory(path);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

inline std::unique_ptr<SqlitePlanStore> OpenStore(const std::string& directory)
{
    Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(directory);
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
