#pragma once

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

// Shared by the tests of a store's files.

namespace ACS::Planning::Test
{

/// The version of the schema.
inline constexpr int NEWEST = 6;

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

/// The copy of a directory is used as if it were the original: its generation file identifies no file, as one of an earlier
/// version.
inline void ForgetIdentity(const std::string& store)
{
    std::ifstream in(GetGeneration(store));
    std::string text;
    std::string line;
    while (std::getline(in, line))
    {
        text += line.substr(0, line.find(' ')) + "\n";
    }
    std::ofstream(GetGeneration(store)) << text;
}

inline constexpr const char* HOLD_REASON = "It was accepted.";

inline std::unique_ptr<SqlitePlanStore> AcceptStore(const std::string& directory)
{
    CHECK_FALSE(SqlitePlanStore::Open(directory).has_value());
    Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Accept(directory, HOLD_REASON);
    REQUIRE(store.has_value());
    CHECK((*store)->Load()->holdReason == HOLD_REASON);
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
