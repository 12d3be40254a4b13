#include "config/RemovedKeys.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace ACS::Acsd
{

namespace
{

struct RemovedKey
{
    const char* table;
    const char* key;
    const char* replacement;
};

/// These were renamed, or accepted a single value, which acsd uses now.
constexpr std::array<RemovedKey, 7> REMOVED_KEYS{
    {{"plan", "duplicate", "a plan with a known planId is always refused; see plan.reuse_finished_id"},
     {"plan", "allow_mixed_robot_types", "one robot always executes the whole plan; delete the key"},
     {"locations", "unknown", "a plan with a location that is not on the map is always refused; delete the key"},
     {"locations", "robot_aliases", "AMR is always the alias of the assigned robot; delete the key"},
     {"mcs", "sync_config", "SyncConfig is always answered with Fail; delete the key"},
     {"ext", "battery_station", "MCS-ACS 1.2.1 removed the message; delete the key"},
     {"store",
      "path",
      "renamed to store.directory; keep its value: the first start migrates the database at that path to a directory"}}};

} // namespace

void ReportRemovedKeys(const Apps::ConfigSection& root)
{
    const std::vector<std::string> tables = root.GetNames();
    for (const RemovedKey& removed : REMOVED_KEYS)
    {
        if (std::ranges::find(tables, removed.table) == tables.end())
        {
            continue; // a table that is asked for is listed as allowed
        }
        root.GetSection(removed.table).ReportRemoved(removed.key, removed.replacement);
    }
}

} // namespace ACS::Acsd
