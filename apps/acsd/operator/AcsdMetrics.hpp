#pragma once

#include "common/config/Url.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "mcs/McsLink.hpp"
#include "mcs/RefusedReports.hpp"
#include "operator/AlarmSeries.hpp"
#include "operator/ProcessMetrics.hpp"
#include "view/ProgramState.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/StoreLog.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// acsd's metrics by their names at /metrics; docs/reference/metrics.md lists them. Counters of other components are read at
/// each request; durations are observed when they end. The drivers of the robots have metrics of their own.
class AcsdMetrics final
{
public:
    /// Whether this process may command robots; a standby has this metric too.
    static constexpr const char* LEADER = "acsd_leader";
    static constexpr const char* LEADER_HELP = "1 while this process leads, 0 while it is a standby";

private:
    Apps::MetricsEndpoint& _metrics;
    AlarmSeries _alarms;
    ProcessMetrics _process;

public:
    /// The endpoint outlives it. The process has started now.
    AcsdMetrics(Apps::MetricsEndpoint& metrics, Core::Now now);

    void ObserveAckWait(Core::Duration wait);
    void ObserveCommit(Core::Duration duration);
    void ObserveStall(Core::Duration stall);

    void UpdateProcess();
    /// bWorks: no other reason than a link keeps acsd from being ready.
    void UpdateReady(const std::vector<LinkStatus>& links, bool bWorks);
    /// The broker in use is one of the URLs; empty: none is connected.
    void UpdateBrokers(const std::vector<Apps::Url>& urls, const std::string& connected);
    /// bWorking: the value of isConnected that was published last.
    void UpdateMCS(const McsLink& mcs, const RefusedReports& refused, bool bWorking);
    void UpdatePlans(const Planning::PlanEngine& engine, bool bStoreFailing, Core::Now now);
    void UpdateStoreLog(const Planning::StoreLog& log);
    void UpdateLog(std::uint64_t dropped);
    void UpdateTrace(std::uint64_t lost);
    void UpdateAudit(std::uint64_t lost);

private:
    void UpdateLink(const std::string& name, bool bUp);
    void UpdateCommands(const McsLink& mcs, const RefusedReports& refused);
    void UpdateAlarms(const Planning::PlanEngine& engine);
};

} // namespace ACS::Acsd
