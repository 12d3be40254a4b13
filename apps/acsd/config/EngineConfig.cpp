#include "config/EngineConfig.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;

constexpr std::int64_t MOST_BASE_NODES = 1'000;
constexpr double MOST_CLEARANCE = 100;
constexpr std::int64_t MAXIMUM_PERCENT = 100;
constexpr std::int64_t MOST_REJECTIONS = 1'000;
constexpr std::int64_t MOST_PLANS = 100'000;
constexpr std::int64_t FEWEST_REPORTS = 100;
constexpr std::int64_t MOST_REPORTS = 10'000'000;
constexpr std::int64_t FEWEST_LOG_BYTES = 8LL * 1024 * 1024; // the store merges a smaller log later
constexpr std::int64_t MOST_LOG_BYTES = 1LL << 40U;

void ReadQueue(const ConfigSection& root, Planning::EngineOptions& engine)
{
    const ConfigSection queue = root.GetSection("queue");
    engine.maximumPlans = static_cast<std::size_t>(
        queue.GetInteger("max_plans", 1, MOST_PLANS, static_cast<std::int64_t>(engine.maximumPlans)));
    engine.bLowerPriorityFirst =
        queue.GetWord("priority_order", {"higher_first", "lower_first"}, "higher_first") == "lower_first";
    engine.defaultPriority = static_cast<std::int32_t>(queue.GetInteger(
        "default_priority",
        std::numeric_limits<std::int32_t>::min(),
        std::numeric_limits<std::int32_t>::max(),
        engine.defaultPriority));
    engine.queueAgeing = queue.GetDuration("ageing", 0ms, 24h, engine.queueAgeing);
    engine.queueOvertaking = queue.GetDuration("overtaking", 0ms, 24h, engine.queueOvertaking);

    const ConfigSection traffic = root.GetSection("traffic");
    engine.clearance = traffic.GetNumber("clearance", 0, MOST_CLEARANCE, engine.clearance);
    engine.baseLength = static_cast<std::size_t>(
        traffic.GetInteger("base_length", 1, MOST_BASE_NODES, static_cast<std::int64_t>(engine.baseLength)));

    const ConfigSection plan = root.GetSection("plan");
    engine.bFinishedIDsReused = plan.IsEnabled("reuse_finished_id", engine.bFinishedIDsReused);

    const ConfigSection reports = root.GetSection("reports");
    engine.bInitialPendingReported = reports.IsEnabled("initial_pending", engine.bInitialPendingReported);

    const ConfigSection history = root.GetSection("history");
    engine.finishedPlansKept = static_cast<std::size_t>(
        history.GetInteger("keep", 0, MOST_PLANS, static_cast<std::int64_t>(engine.finishedPlansKept)));

    engine.restartWait = root.GetSection("restart").GetDuration("wait", 0ms, 1h, engine.restartWait);

    const ConfigSection tsc = root.GetSection("tsc");
    engine.bTscStartsPaused = tsc.GetWord("initial", {"auto", "paused"}, "auto") == "paused";
    engine.bTscPausedAcceptsPlans = tsc.IsEnabled("paused_accepts_plans", engine.bTscPausedAcceptsPlans);
}

void ReadDispatch(const ConfigSection& root, Planning::EngineOptions& engine)
{
    const ConfigSection robot = root.GetSection("robot");
    Planning::DispatchOptions& dispatch = engine.dispatch;
    const auto readPercent = [&robot](const std::string& key, double fallback) {
        return static_cast<double>(robot.GetInteger(key, 0, MAXIMUM_PERCENT, static_cast<std::int64_t>(fallback)));
    };
    dispatch.batteryFloor = readPercent("battery_floor", dispatch.batteryFloor);
    dispatch.batteryResume = readPercent("battery_resume", dispatch.batteryResume);
    engine.maximumRejections = static_cast<std::size_t>(
        robot.GetInteger("max_rejections", 1, MOST_REJECTIONS, static_cast<std::int64_t>(engine.maximumRejections)));
    dispatch.bLoadsIntoTakenPorts = robot.GetWord("taken_port", {"wait", "load"}, "wait") == "load";

    const ConfigSection drive = root.GetSection("drive");
    engine.stallTimeout = drive.GetDuration("stall_timeout", 0ms, 24h, engine.stallTimeout);
    engine.waitTimeout = drive.GetDuration("wait_timeout", 0ms, 24h, engine.waitTimeout);

    const std::string moving =
        root.GetSection("mcs").GetWord("position_while_moving", {"last", "target", "null"}, "last");
    engine.movingPosition = moving == "target"
        ? Planning::EMovingPosition::Target
        : (moving == "null" ? Planning::EMovingPosition::None : Planning::EMovingPosition::Last);
}

/// Register D-14 to D-22.
void ReadControls(const ConfigSection& root, Planning::ControlOptions& controls)
{
    const ConfigSection cancel = root.GetSection("cancel");
    const std::string until = cancel.GetWord("until", {"first_arrival", "dispatch", "first_job"}, "first_arrival");
    controls.cancelUntil = until == "dispatch"
        ? Planning::ECancelWindow::Dispatch
        : (until == "first_job" ? Planning::ECancelWindow::FirstJob : Planning::ECancelWindow::FirstArrival);
    controls.cancelTimeout = cancel.GetDuration("confirm_timeout", 1ms, 1h, controls.cancelTimeout);

    const ConfigSection pause = root.GetSection("pause");
    controls.bPausesAfterJob = pause.GetWord("mode", {"immediate", "after_job"}, "immediate") == "after_job";
    controls.pauseTimeout = pause.GetDuration("confirm_timeout", 1ms, 1h, controls.pauseTimeout);

    const ConfigSection abort = root.GetSection("abort");
    controls.bAbortStopsJob = abort.GetWord("running_job", {"finish", "stop"}, "finish") == "stop";
    controls.bAbortFinishesPausedJob = abort.GetWord("paused_job", {"discard", "finish"}, "discard") == "finish";
    controls.bJobFailureFailsAbort = abort.GetWord("job_failure_final", {"Failed", "Aborted"}, "Failed") == "Failed";
    controls.bAbortReportsStep = abort.IsEnabled("report_step", controls.bAbortReportsStep);
    controls.jobEndTimeout = abort.GetDuration("end_timeout", 1ms, 24h, controls.jobEndTimeout);

    controls.bResultAfterRefusal =
        root.GetSection("mcs").IsEnabled("result_after_fail_ack", controls.bResultAfterRefusal);
}

} // namespace

void ReadEngineConfig(const ConfigSection& root, Planning::EngineOptions& engine)
{
    ReadQueue(root, engine);
    ReadControls(root, engine.controls);
    ReadDispatch(root, engine);
    engine.maximumReports = static_cast<std::size_t>(
        root.GetSection("outbox")
            .GetInteger("max", FEWEST_REPORTS, MOST_REPORTS, static_cast<std::int64_t>(engine.maximumReports)));
    engine.maximumLogBytes = static_cast<std::uint64_t>(root.GetSection("store").GetInteger(
        "max_log_bytes",
        FEWEST_LOG_BYTES,
        MOST_LOG_BYTES,
        static_cast<std::int64_t>(engine.maximumLogBytes)));
}

} // namespace ACS::Acsd
