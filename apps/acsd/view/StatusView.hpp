#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

struct LinkView
{
    std::string name; ///< "mcs", "mqtt"
    bool bUp = false;
    std::optional<std::string> reason;   ///< Why it is not up.
    Core::WallTime since;                ///< Of this state; at the earliest the start of acsd.
    std::optional<std::string> broker{}; ///< URL of the connected broker.

    bool operator==(const LinkView&) const = default;
};

/// Reports to the MCS that wait for an Ack.
struct OutboxView
{
    std::size_t reports = 0;
    std::optional<Core::WallTime> oldest;

    bool operator==(const OutboxView&) const = default;
};

struct RefusedReportView
{
    std::string command;
    std::optional<std::string> planID;
    std::string message;
    bool bRetried = false; ///< RefusedReports::bRetried

    bool operator==(const RefusedReportView&) const = default;
};

/// Reports that the MCS has answered with Fail since the start.
struct RefusedReportsView
{
    std::uint64_t count = 0;
    std::optional<RefusedReportView> last;

    bool operator==(const RefusedReportsView&) const = default;
};

struct PlanCountsView
{
    std::size_t active = 0;  ///< A robot has the plan.
    std::size_t waiting = 0; ///< In the queue.

    bool operator==(const PlanCountsView&) const = default;
};

struct RobotCountsView
{
    std::size_t total = 0;
    std::map<std::string, std::size_t> byStatus;

    bool operator==(const RobotCountsView&) const = default;
};

struct AlarmCountsView
{
    std::size_t heavy = 0;
    std::size_t light = 0;

    bool operator==(const AlarmCountsView&) const = default;
};

/// acsd as a whole, as the operator sees it.
struct StatusView
{
    std::string version;
    Core::WallTime startedAt;
    bool bReady = false;
    std::vector<std::string> notReadyReasons;
    std::optional<bool>
        bConnected; ///< isConnected, as it was last published to the MCS; nullopt: not yet since the start.
    std::vector<LinkView> links;
    std::string tsc;
    std::optional<std::string> tscReason;
    OutboxView outbox;
    RefusedReportsView refusedReports;
    PlanCountsView plans;
    RobotCountsView robots;
    AlarmCountsView alarms;
    std::uint64_t siteRevision = 0; ///< Counts the changes of the blocks since the start: read the site again.

    bool operator==(const StatusView&) const = default;
};

} // namespace ACS::Acsd
