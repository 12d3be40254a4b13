#include "config/StoreConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"
#include "config/SecretCheck.hpp"
#include <acs/plan/LeaseTerm.hpp>
#include <acs/plan_postgres/PostgresPlanStore.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <fmt/format.h>

#include <array>
#include <unistd.h>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::size_t LONGEST_HOST_NAME = 256;

std::string GetHostName()
{
    std::array<char, LONGEST_HOST_NAME> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string("acsd");
}

void ReadDirectory(const ConfigSection& store, const std::string& fileName, bool bInspected, StoreConfig& config)
{
    if (!store.HasKey("directory"))
    {
        store.AddError("directory", "missing; give the path of a directory, or store.url for a store in PostgreSQL");
        return;
    }
    const std::string directory = store.GetString("directory");
    config.directory = ResolvePath(fileName, directory);
    if (directory.empty())
    {
        store.AddError("directory", "is empty; give the path of a directory, such as \"store\"");
    }
    else if (bInspected)
    {
        const Core::Result<Planning::StoredState> content = Planning::SqlitePlanStore::InspectState(config.directory);
        if (!content.has_value())
        {
            store.AddError("directory", Core::Describe(content.error()));
        }
    }
    for (const char* const key : {"password_file", "lease", "instance"})
    {
        if (store.HasKey(key))
        {
            store.AddError(key, "belongs to store.url; delete the key, because the store is in a directory");
        }
    }
}

void ReadPassword(const ConfigSection& store, const std::string& fileName, Planning::PostgresOptions& options)
{
    const std::string key = "password_file";
    const std::optional<std::string> file = store.GetStringOrNull(key);
    if (!file.has_value())
    {
        return;
    }
    const std::string path = ResolvePath(fileName, *file);
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        store.AddError(key, fmt::format("{}: {}", path, text.error()));
        return;
    }
    options.password = text->substr(0, text->find_first_of("\r\n"));
    if (options.password.empty())
    {
        store.AddError(key, path + " has no password in its first line");
    }
    CheckSecretFile(store, key, path);
}

void WarnOfURL(const Planning::PostgresTarget& target, const std::string& fileName, std::vector<std::string>& warnings)
{
    if (target.bPassword)
    {
        WarnOfReadableConfig("store.url", fileName, warnings);
    }
    if (target.bOtherMachine && !target.bVerified)
    {
        warnings.emplace_back(
            "store.url: its sslmode does not identify the server, so that another program can read and change all plans; delete "
            "sslmode, or give verify-full");
    }
}

void ReadPostgres(
    const ConfigSection& store,
    const std::string& fileName,
    bool bInspected,
    StoreConfig& config,
    std::vector<std::string>& warnings)
{
    Planning::PostgresOptions& options = config.postgres.emplace();
    options.url = store.GetString("url");
    ReadPassword(store, fileName, options);
    config.lease =
        store.GetDuration("lease", Planning::LeaseTerm::SHORTEST, Planning::LeaseTerm::LONGEST, config.lease);
    config.instance = store.GetString("instance", GetHostName());
    const Core::Result<Planning::PostgresTarget> target = Planning::ReadPostgresURL(options.url);
    if (!target.has_value())
    {
        store.AddError("url", Core::Describe(target.error()));
        return;
    }
    WarnOfURL(*target, fileName, warnings);
    if (bInspected)
    {
        const Core::Result<Planning::StoredState> content = Planning::PostgresPlanStore::InspectState(options);
        if (!content.has_value())
        {
            store.AddError("url", Core::Describe(content.error()));
        }
    }
}

} // namespace

std::string StoreConfig::GetName() const
{
    if (!postgres.has_value())
    {
        return directory;
    }
    const Core::Result<Planning::PostgresTarget> target = Planning::ReadPostgresURL(postgres->url);
    return target.has_value() ? target->name : std::string("store.url");
}

void ReadStoreConfig(
    const ConfigSection& root,
    const std::string& fileName,
    bool bInspected,
    StoreConfig& config,
    std::vector<std::string>& warnings)
{
    config.bNewStorePaused = root.GetSection("tsc").GetWord("new_store", {"auto", "paused"}, "auto") == "paused";
    const ConfigSection store = root.GetSection("store");
    if (!store.HasKey("url"))
    {
        ReadDirectory(store, fileName, bInspected, config);
        return;
    }
    if (store.HasKey("directory"))
    {
        store.AddError("directory", "there is also store.url, of a store in PostgreSQL; delete one of them");
    }
    ReadPostgres(store, fileName, bInspected, config, warnings);
}

} // namespace ACS::Acsd
