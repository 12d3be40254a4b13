#include "config/LiveConfig.hpp"

#include "config/NamedFiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::array<std::string_view, 12> LIVE_KEYS{
    "comm.grace",
    "log.level",
    "mcs.empty_carriers",
    "mcs.on_report_nack",
    "mcs.tx_max_bytes",
    "mcs.tx_warn_bytes",
    "mcs.unassigned_robot_id",
    "outbox.replay",
    "robot.status_interval",
    "shutdown.drain_timeout",
    "trace.max_file_bytes",
    "trace.max_files"};

/// Adds the keys of files with the same name and another text.
void AddChangedFiles(
    const std::map<std::string, std::string>& before,
    const std::map<std::string, std::string>& after,
    std::vector<std::string>& keys)
{
    for (const auto& [key, text] : after)
    {
        const auto old = before.find(key);
        if (old != before.end() && old->second != text && std::ranges::find(keys, key) == keys.end())
        {
            keys.push_back(key);
        }
    }
    std::ranges::sort(keys);
}

} // namespace

bool IsLiveKey(std::string_view key)
{
    return std::ranges::find(LIVE_KEYS, key) != LIVE_KEYS.end();
}

ConfigChange CompareConfigs(
    const std::map<std::string, std::string>& before,
    const std::map<std::string, std::string>& after)
{
    std::set<std::string> keys;
    for (const auto& [key, value] : before)
    {
        keys.insert(key);
    }
    for (const auto& [key, value] : after)
    {
        keys.insert(key);
    }
    ConfigChange change;
    for (const std::string& key : keys)
    {
        const auto old = before.find(key);
        const auto fresh = after.find(key);
        const bool bSame = old != before.end() && fresh != after.end() && old->second == fresh->second;
        if (!bSame)
        {
            (IsLiveKey(key) ? change.applied : change.pending).push_back(key);
        }
    }
    return change;
}

void LogChange(const AcsdConfig& present, const AcsdConfig& fresh, const Core::Logger& logger)
{
    ConfigChange change = CompareConfigs(present.values, fresh.values);
    AddChangedFiles(present.files, fresh.files, change.pending);
    for (const std::string& key : change.applied)
    {
        const auto value = fresh.values.find(key);
        const std::string_view text = value == fresh.values.end() ? "default" : std::string_view(value->second);
        logger.Info("applied", {{"key", key}, {"value", text}});
    }
    for (const std::string& key : change.pending)
    {
        logger.Warning("not applied: the change needs a restart of acsd", {{"key", key}});
    }
    if (const std::vector<std::string> keys = FindCredentialKeys(fresh.values); !keys.empty())
    {
        logger.Warning(
            "credentials have their former contents: systemd copies them when the service starts. Restart acsd after a change of "
            "such a file",
            {{"keys", fmt::format("{}", fmt::join(keys, ", "))}});
    }
    if (change == ConfigChange{})
    {
        logger.Info("configuration reloaded without changes");
    }
}

void ApplyLiveKeys(const AcsdConfig& fresh, AcsdConfig& present)
{
    present.operations.logLevel = fresh.operations.logLevel;
    present.operations.trace = fresh.operations.trace;
    present.operations.workGrace = fresh.operations.workGrace;
    present.operations.statusInterval = fresh.operations.statusInterval;
    present.operations.drainTimeout = fresh.operations.drainTimeout;
    const MessageStyle& style = fresh.mcs.style;
    present.mcs.style.bUnassignedRobotEmpty = style.bUnassignedRobotEmpty;
    present.mcs.style.bEmptyCarriersOmitted = style.bEmptyCarriersOmitted;
    present.mcs.style.bRefusedReportsRetried = style.bRefusedReportsRetried;
    present.mcs.style.longestText = style.longestText;
    present.mcs.style.replay = style.replay;
    present.mcs.warnBytes = fresh.mcs.warnBytes;
    std::erase_if(present.values, [](const auto& entry) { return IsLiveKey(entry.first); });
    std::ranges::copy_if(fresh.values, std::inserter(present.values, present.values.end()), [](const auto& entry) {
        return IsLiveKey(entry.first);
    });
}

} // namespace ACS::Acsd
