#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "operator/RobotTimes.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// Logs and counts each change of state.
class PlanLog final : public Planning::IPlanObserver
{
public:
    static constexpr std::chrono::seconds SAMPLE_PERIOD{1};

private:
    Core::Logger _logger;
    Apps::MetricsEndpoint& _metrics;
    /// Time at which each running job was commanded, by planID and jobID.
    std::map<std::pair<std::string, std::string>, Core::SteadyTime> _jobs;
    /// Time at which each running step was begun, by planID and stepNo.
    std::map<std::pair<std::string, std::int32_t>, Core::SteadyTime> _steps;
    std::map<std::string, Core::SteadyTime, std::less<>> _changes; ///< Of unfinished plans, by planID: the last one.
    RobotTimes _robotTimes;
    Apps::LogRateLimiter _notes;
    Apps::LogRateLimiter _alarms; ///< A robot can report any number of errors.
    Apps::LogRateLimiter _robots; ///< A robot can change its status any number of times.

public:
    /// The metrics must outlive the log.
    PlanLog(Core::Logger logger, Apps::MetricsEndpoint& metrics);

    /// Creates the series that can occur with these actions and robots. Call it at the start.
    void CreateSeries(const Planning::EngineOptions& options);

    /// Updates the metrics that no change of state updates. Call it every SAMPLE_PERIOD, and before the metrics are read.
    void Sample(const Planning::PlanEngine& engine, Core::Now now);

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
    void MarkChanged(const Planning::PlanRecord& record, Core::Now now);
    void ObserveStep(
        const Planning::PlanRecord& record,
        const Planning::Step& step,
        Planning::EStepState state,
        Core::Now now);
    void ObserveJob(
        const Planning::PlanRecord& record,
        const Planning::Step& step,
        const std::string& jobID,
        Planning::EJobState state,
        Core::Now now);
};

} // namespace ACS::Acsd
