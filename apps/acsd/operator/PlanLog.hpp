#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include "common/log/LogRateLimiter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/plan/IPlanObserver.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// Logs and counts each change of state.
class PlanLog final : public Planning::IPlanObserver
{
    Core::Logger _logger;
    Apps::MetricsEndpoint& _metrics;
    /// Time at which each running job was commanded, by planID and jobID.
    std::map<std::pair<std::string, std::string>, Core::SteadyTime> _jobs;
    Apps::LogRateLimiter _notes;
    Apps::LogRateLimiter _alarms; ///< A robot can report any number of errors.
    Apps::LogRateLimiter _robots; ///< A robot can change its status any number of times.

public:
    /// The metrics must outlive the log.
    PlanLog(Core::Logger logger, Apps::MetricsEndpoint& metrics);

    void OnPlanChanged(
        const Planning::PlanRecord& record,
        Planning::EPlanState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnStepChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        Planning::EStepState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnJobChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        Planning::EJobState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
        override;
    void OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now) override;
    void OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now) override;
    void OnNote(std::string_view robotID, std::string_view text, Core::Now now) override;

private:
    void ObserveJob(
        const Planning::PlanRecord& record,
        const Planning::Step& step,
        const std::string& jobID,
        Planning::EJobState state,
        Core::Now now);
};

} // namespace ACS::Acsd
