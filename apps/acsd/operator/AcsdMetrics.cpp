#include "operator/AcsdMetrics.hpp"

#include "operator/WaitCauses.hpp"
#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/SessionEvent.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Planning::EAlarmLevel;
using Planning::EPlanState;
using Planning::ETscState;

constexpr const char* READY = "acsd_ready";
constexpr const char* LINK_UP = "acsd_link_up";
constexpr const char* BROKER_CONNECTED = "acsd_mqtt_broker_connected";
constexpr const char* MCS_CONNECTED = "acsd_mcs_connected";
constexpr const char* MCS_REGISTERED = "acsd_mcs_registered";
constexpr const char* IS_CONNECTED = "acsd_is_connected";
constexpr const char* MCS_LINK_LOSSES = "acsd_mcs_link_losses_total";
constexpr const char* MCS_SENT = "acsd_mcs_requests_sent_total";
constexpr const char* MCS_RECEIVED = "acsd_mcs_requests_received_total";
constexpr const char* MCS_REFUSED = "acsd_mcs_requests_refused_total";
constexpr const char* MCS_NACKS = "acsd_mcs_nacks_total";
constexpr const char* MCS_TIMEOUTS = "acsd_mcs_ack_timeouts_total";
constexpr const char* MCS_UNMATCHED = "acsd_mcs_ack_unmatched_total";
constexpr const char* MCS_NOTES = "acsd_mcs_notes_total";
constexpr const char* MCS_LONGEST = "acsd_mcs_tx_bytes_max";
constexpr const char* POSITIONS_MISSED = "acsd_position_ticks_missed_total";
constexpr const char* MCS_ACK_WAIT = "acsd_mcs_ack_wait_seconds";
constexpr const char* OUTBOX_DEPTH = "acsd_outbox_depth";
constexpr const char* OUTBOX_OLDEST = "acsd_outbox_oldest_seconds";
constexpr const char* PLANS_ACTIVE = "acsd_plans_active";
constexpr const char* PLANS = "acsd_plans";
constexpr const char* QUEUE_OLDEST = "acsd_queue_oldest_seconds";
constexpr const char* PLANS_WAITING = "acsd_plans_waiting";
constexpr const char* TSC_STATE = "acsd_tsc_state";
constexpr const char* ALARMS = "acsd_alarms_active";
constexpr const char* ALARMS_BY_CODE = "acsd_alarms_by_code";
constexpr const char* ROBOT_BATTERY = "acsd_robot_battery";
constexpr const char* ROBOT_MAINTENANCE = "acsd_robot_maintenance";
constexpr const char* COMMITS = "acsd_store_commit_seconds";
constexpr const char* STORE_FAILING = "acsd_store_failing";
constexpr const char* STORE_LOG = "acsd_store_log_bytes";
constexpr const char* STORE_FREE = "acsd_store_free_bytes";
constexpr const char* LOOP_STALLS = "acsd_loop_stall_seconds";
constexpr const char* LOG_DROPPED = "acsd_log_lines_dropped_total";
constexpr const char* TRACE_LOST = "acsd_trace_lost_total";
constexpr const char* AUDIT_LOST = "acsd_audit_lost_total";

constexpr std::array ACTIVE_STATES{EPlanState::Pending, EPlanState::InProgress, EPlanState::Paused};
constexpr std::array TSC_STATES{ETscState::Auto, ETscState::Pausing, ETscState::Paused};

/// The commands that an MCS can refuse as a report. The session handles the Acks of the other ones.
constexpr std::array REPORTS{
    Protocol::EAcsCommand::PlanReport,
    Protocol::EAcsCommand::StepReport,
    Protocol::EAcsCommand::JobReport,
    Protocol::EAcsCommand::CancelResultReport,
    Protocol::EAcsCommand::AbortResultReport,
    Protocol::EAcsCommand::PauseResultReport,
    Protocol::EAcsCommand::ResumeResultReport,
    Protocol::EAcsCommand::ErrorReport};

/// Not negative, although the wall clock may have been set back.
double GetAge(Core::WallTime since, Core::Now now)
{
    return std::max(0.0, std::chrono::duration<double>(now.wall - since).count());
}

double ToSeconds(Core::Duration duration)
{
    return std::chrono::duration<double>(duration).count();
}

template <typename TNumber>
double ToNumber(TNumber number)
{
    return static_cast<double>(number);
}

} // namespace

AcsdMetrics::AcsdMetrics(Apps::MetricsEndpoint& metrics, Core::Now now)
    : _metrics(metrics),
      _process(metrics, now)
{
    _metrics.AddGauge(LEADER, LEADER_HELP);
    _metrics.SetGauge(LEADER, {}, 1);
    _metrics.AddGauge(READY, "1 when /readyz answers 200");
    _metrics.AddGauge(LINK_UP, "1 when the link is up: mcs registered, mqtt subscribed");
    _metrics.AddGauge(
        BROKER_CONNECTED,
        "1 for the MQTT broker that acsd is connected to, 0 for the others of mqtt.urls");
    _metrics.AddGauge(MCS_CONNECTED, "1 when the WebSocket to the MCS is open");
    _metrics.AddGauge(MCS_REGISTERED, "1 when the MCS has accepted the registration");
    _metrics.AddGauge(IS_CONNECTED, "isConnected as it was reported to the MCS last: 1 when acsd can work");
    _metrics.AddCounter(MCS_LINK_LOSSES, "Connections to the MCS that ended or could not be established");
    _metrics.AddCounter(MCS_SENT, "Requests sent to the MCS, including resends");
    _metrics.AddCounter(MCS_RECEIVED, "Requests received from the MCS, including repeated ones");
    _metrics.AddCounter(MCS_REFUSED, "Requests of the MCS that were answered with Fail");
    _metrics.AddCounter(MCS_NACKS, "Reports that the MCS answered with Fail");
    _metrics.AddCounter(MCS_TIMEOUTS, "Reports without an Ack after all resends");
    _metrics.AddCounter(MCS_UNMATCHED, "Acks with an unknown transactionId, or without a pending request");
    _metrics.AddCounter(MCS_NOTES, "Deviations of the MCS from the specification, by kind");
    _metrics.AddGauge(MCS_LONGEST, "Length of the longest message sent to the MCS, in bytes");
    _metrics.AddCounter(POSITIONS_MISSED, "Periods of RobotPositionUpdate without a message because acsd was late");
    _metrics.AddHistogram(
        MCS_ACK_WAIT,
        "Time from a report to its Ack",
        {0.001, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10});
    _metrics.AddGauge(OUTBOX_DEPTH, "Reports without an Ack");
    _metrics.AddGauge(OUTBOX_OLDEST, "Age of the oldest report without an Ack; 0 without one");
    _metrics.AddGauge(PLANS_ACTIVE, "Unfinished plans");
    _metrics.AddGauge(PLANS, "Unfinished plans, by status");
    _metrics.AddGauge(QUEUE_OLDEST, "Age of the oldest plan that has not started; 0 without one");
    _metrics.AddGauge(PLANS_WAITING, "Unfinished plans that make no progress, by cause");
    _metrics.AddGauge(TSC_STATE, "1 for the present state of the TSC, 0 for the others");
    _metrics.AddGauge(ALARMS, "Active alarms, by level");
    _metrics.AddGauge(ALARMS_BY_CODE, "Active alarms, by robot, code and level");
    _metrics.AddGauge(ROBOT_BATTERY, "Charge in percent");
    _metrics.AddGauge(ROBOT_MAINTENANCE, "1 while the robot is in maintenance");
    _metrics.AddHistogram(
        COMMITS,
        "Time from a batch of changes to its commit",
        {0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 5});
    _metrics.AddGauge(STORE_FAILING, "1 while data cannot be stored");
    _metrics.AddGauge(STORE_LOG, "Size of the store's write-ahead log");
    _metrics.AddGauge(STORE_FREE, "Free space on the file system of the store");
    _metrics.AddHistogram(LOOP_STALLS, "Times for which the event loop was blocked", {0.5, 1, 2, 5, 10, 30});
    _metrics.AddCounter(LOG_DROPPED, "Log lines dropped because standard error was not read in time");
    _metrics.AddCounter(TRACE_LOST, "Messages that are missing in the trace");
    _metrics.AddCounter(AUDIT_LOST, "Commands that are missing in the files of the audit log");
    for (const char* histogram : {MCS_ACK_WAIT, COMMITS, LOOP_STALLS})
    {
        _metrics.CreateHistogram(histogram);
    }
}

void AcsdMetrics::ObserveAckWait(Core::Duration wait)
{
    _metrics.Observe(MCS_ACK_WAIT, {}, ToSeconds(wait));
}

void AcsdMetrics::ObserveStall(Core::Duration stall)
{
    _metrics.Observe(LOOP_STALLS, {}, ToSeconds(stall));
}

void AcsdMetrics::ObserveCommit(Core::Duration duration)
{
    _metrics.Observe(COMMITS, {}, ToSeconds(duration));
}

void AcsdMetrics::UpdateProcess()
{
    _process.Update();
}

void AcsdMetrics::UpdateReady(const std::vector<LinkStatus>& links, bool bWorks)
{
    for (const LinkStatus& link : links)
    {
        UpdateLink(link.name, link.bUp);
    }
    const bool bUp = std::ranges::all_of(links, &LinkStatus::bUp);
    _metrics.SetGauge(READY, {}, bUp && bWorks ? 1.0 : 0.0);
}

void AcsdMetrics::UpdateBrokers(const std::vector<Apps::Url>& urls, const std::string& connected)
{
    for (const Apps::Url& url : urls)
    {
        const std::string broker = MakeText(url);
        _metrics.SetGauge(BROKER_CONNECTED, {{"broker", broker}}, broker == connected ? 1.0 : 0.0);
    }
}

void AcsdMetrics::UpdateMCS(const McsLink& mcs, const RefusedReports& refused, bool bWorking)
{
    const Protocol::SessionStatistics& statistics = mcs.GetStatistics();
    const McsLink::Metrics metrics = mcs.GetMetrics();
    _metrics.SetGauge(MCS_CONNECTED, {}, metrics.bConnected ? 1.0 : 0.0);
    _metrics.SetGauge(MCS_REGISTERED, {}, mcs.IsRegistered() ? 1.0 : 0.0);
    _metrics.SetGauge(IS_CONNECTED, {}, bWorking ? 1.0 : 0.0);
    _metrics.SetGauge(MCS_LONGEST, {}, ToNumber(metrics.longestSent));
    _metrics.SetTotal(MCS_LINK_LOSSES, {}, ToNumber(statistics.linkLosses));
    _metrics.SetTotal(POSITIONS_MISSED, {}, ToNumber(statistics.positionTicksMissed));
    _metrics.SetTotal(MCS_TIMEOUTS, {}, ToNumber(metrics.unanswered));
    UpdateCommands(mcs, refused);
    for (std::size_t index = 0; index < Protocol::NOTE_COUNT; ++index)
    {
        const auto note = static_cast<Protocol::EProtocolNote>(index);
        _metrics.SetTotal(MCS_NOTES, {{"what", std::string(GetText(note))}}, ToNumber(statistics.CountOf(note)));
    }
    _metrics.SetTotal(
        MCS_UNMATCHED,
        {},
        ToNumber(
            statistics.CountOf(Protocol::EProtocolNote::AckMismatched)
            + statistics.CountOf(Protocol::EProtocolNote::AckUnexpected)));
}

/// Only the commands that each side sends.
void AcsdMetrics::UpdateCommands(const McsLink& mcs, const RefusedReports& refused)
{
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<Protocol::EAcsCommand>(index);
        const Apps::MetricsEndpoint::Labels labels{{"command", std::string(GetText(command))}};
        const Protocol::CommandCounters& counters = mcs.GetStatistics().Of(command);
        if (Protocol::IsSentByMCS(command))
        {
            _metrics.SetTotal(MCS_RECEIVED, labels, ToNumber(counters.received));
            _metrics.SetTotal(MCS_REFUSED, labels, ToNumber(counters.refused));
            continue;
        }
        _metrics.SetTotal(MCS_SENT, labels, ToNumber(counters.sent));
        if (std::ranges::find(REPORTS, command) != REPORTS.end())
        {
            _metrics.SetTotal(MCS_NACKS, labels, ToNumber(refused.byCommand.at(index)));
        }
    }
}

void AcsdMetrics::UpdatePlans(const Planning::PlanEngine& engine, bool bStoreFailing, Core::Now now)
{
    const std::vector<Planning::PlanSummary> plans = engine.GetActivePlans();
    _metrics.SetGauge(STORE_FAILING, {}, bStoreFailing ? 1.0 : 0.0);
    _metrics.SetGauge(PLANS_ACTIVE, {}, ToNumber(plans.size()));
    for (const EPlanState state : ACTIVE_STATES)
    {
        const auto count = std::ranges::count(plans, state, &Planning::PlanSummary::state);
        _metrics.SetGauge(PLANS, {{"status", std::string(GetText(state))}}, ToNumber(count));
    }
    Core::WallTime oldest = now.wall;
    for (const Planning::PlanSummary& plan : plans)
    {
        if (plan.state == EPlanState::Pending)
        {
            oldest = std::min(oldest, plan.startTime);
        }
    }
    _metrics.SetGauge(QUEUE_OLDEST, {}, GetAge(oldest, now));
    for (const auto& [cause, count] : CountWaitCauses(engine, bStoreFailing))
    {
        _metrics.SetGauge(PLANS_WAITING, {{"cause", std::string(cause)}}, ToNumber(count));
    }
    for (const ETscState state : TSC_STATES)
    {
        _metrics.SetGauge(
            TSC_STATE,
            {{"state", std::string(GetText(state))}},
            engine.GetTscState() == state ? 1.0 : 0.0);
    }
    const Planning::OutboxSummary outbox = engine.GetOutboxSummary();
    _metrics.SetGauge(OUTBOX_DEPTH, {}, ToNumber(outbox.count));
    _metrics.SetGauge(OUTBOX_OLDEST, {}, GetAge(outbox.oldest.value_or(now.wall), now));
    UpdateAlarms(engine);
    for (const Planning::RobotPose& pose : engine.GetRobotPoses())
    {
        _metrics.SetGauge(ROBOT_BATTERY, {{"robot", pose.robotID}}, pose.batteryPercent);
    }
    for (const Planning::RobotStatus& robot : engine.GetRobotStatuses())
    {
        _metrics.SetGauge(ROBOT_MAINTENANCE, {{"robot", robot.robotID}}, robot.bInMaintenance ? 1.0 : 0.0);
    }
}

void AcsdMetrics::UpdateAlarms(const Planning::PlanEngine& engine)
{
    for (const EAlarmLevel level : {EAlarmLevel::Heavy, EAlarmLevel::Light})
    {
        const auto count = std::ranges::count(engine.GetActiveAlarms(), level, &Planning::Alarm::level);
        _metrics.SetGauge(ALARMS, {{"level", std::string(GetText(level))}}, ToNumber(count));
    }
    _metrics.ReplaceGauges(ALARMS_BY_CODE, _alarms.Count(engine.GetActiveAlarms()));
}

void AcsdMetrics::UpdateStoreLog(const Planning::StoreLog& log)
{
    _metrics.SetGauge(STORE_LOG, {}, ToNumber(log.bytes));
    _metrics.SetGauge(STORE_FREE, {}, ToNumber(log.freeBytes));
}

void AcsdMetrics::UpdateLog(std::uint64_t dropped)
{
    _metrics.SetTotal(LOG_DROPPED, {}, ToNumber(dropped));
}

void AcsdMetrics::UpdateTrace(std::uint64_t lost)
{
    _metrics.SetTotal(TRACE_LOST, {}, ToNumber(lost));
}

void AcsdMetrics::UpdateAudit(std::uint64_t lost)
{
    _metrics.SetTotal(AUDIT_LOST, {}, ToNumber(lost));
}

void AcsdMetrics::UpdateLink(const std::string& name, bool bUp)
{
    _metrics.SetGauge(LINK_UP, {{"link", name}}, bUp ? 1.0 : 0.0);
}

} // namespace ACS::Acsd
