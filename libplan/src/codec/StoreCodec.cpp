#include "codec/PlanEnumNames.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/plan/StoreCodec.hpp>

#include <chrono>
#include <cstddef>
#include <limits>
#include <utility>

namespace ACS::Planning
{

namespace
{

enum class EReportKind : std::uint8_t
{
    Plan,
    Step,
    Job,
    Error,
    Control,
};

/// A report of any kind, for its JSON text: what a kind does not have is absent.
struct ReportText
{
    EReportKind kind = EReportKind::Plan;
    std::optional<std::string> planID;
    std::optional<std::string> robotID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::optional<EPlanState> planState;
    std::optional<EStepState> stepState;
    std::optional<EJobState> jobState;
    std::optional<EPlanControl> control;
    std::optional<bool> bSucceeded;
    std::optional<bool> bSet;
    std::optional<Alarm> alarm;
    std::string message;
};

/// A PlanProgress whose times are counted: nothing of them is lost.
struct ProgressText
{
    EPlanState state = EPlanState::Pending;
    std::string robotID;
    std::string message;
    std::optional<std::int64_t> startedAt;
    std::optional<std::int64_t> endedAt;
    std::vector<StepProgress> steps;
    bool bArrived = false;
    std::optional<EPlanControl> control;
    std::size_t controlCount = 0;
    EControlOrigin controlOrigin = EControlOrigin::MCS;
    std::vector<std::string> requestIDs;
    std::int64_t queuedAt = 0;
    std::int64_t storedAt = 0;
    std::optional<std::int32_t> priority;
};

/// A Block whose time is counted.
struct BlockText
{
    EBlockKind kind = EBlockKind::Node;
    std::string id;
    std::string reason;
    std::int64_t since = 0;
};

} // namespace

} // namespace ACS::Planning

namespace ACS::Json
{

template <>
struct EnumNames<Planning::EReportKind>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EReportKind>{Planning::EReportKind::Plan, "Plan"},
        EnumWord<Planning::EReportKind>{Planning::EReportKind::Step, "Step"},
        EnumWord<Planning::EReportKind>{Planning::EReportKind::Job, "Job"},
        EnumWord<Planning::EReportKind>{Planning::EReportKind::Error, "Error"},
        EnumWord<Planning::EReportKind>{Planning::EReportKind::Control, "Control"},
    };
};

template <>
struct JsonFields<Planning::Job>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("jobId", &Planning::Job::jobID),
        Optional("from", &Planning::Job::from),
        Optional("to", &Planning::Job::to));
};

template <>
struct JsonFields<Planning::Step>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("stepNo", &Planning::Step::stepNo),
        Required("action", &Planning::Step::action),
        Required("position", &Planning::Step::position),
        Optional("carrierIds", &Planning::Step::carrierIDs),
        Optional("jobs", &Planning::Step::jobs));
};

template <>
struct JsonFields<Planning::Plan>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::Plan::planID),
        Optional("lotId", &Planning::Plan::lotID),
        Optional("priority", &Planning::Plan::priority),
        Required("steps", &Planning::Plan::steps));
};

template <>
struct JsonFields<Planning::StepProgress>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("state", &Planning::StepProgress::state),
        Optional("jobs", &Planning::StepProgress::jobs));
};

template <>
struct JsonFields<Planning::ProgressText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("state", &Planning::ProgressText::state),
        Optional("robotId", &Planning::ProgressText::robotID),
        Optional("message", &Planning::ProgressText::message),
        Optional("startedAt", &Planning::ProgressText::startedAt),
        Optional("endedAt", &Planning::ProgressText::endedAt),
        Required("steps", &Planning::ProgressText::steps),
        Optional("arrived", &Planning::ProgressText::bArrived),
        Optional("control", &Planning::ProgressText::control),
        Optional("controlCount", &Planning::ProgressText::controlCount),
        Optional("controlOrigin", &Planning::ProgressText::controlOrigin),
        Optional("requestIds", &Planning::ProgressText::requestIDs),
        Optional("queuedAt", &Planning::ProgressText::queuedAt),
        Optional("storedAt", &Planning::ProgressText::storedAt),
        Optional("priority", &Planning::ProgressText::priority));
};

template <>
struct JsonFields<Planning::Alarm>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::Alarm::robotID),
        Required("errorCode", &Planning::Alarm::errorCode),
        Required("level", &Planning::Alarm::level),
        Required("message", &Planning::Alarm::message),
        Optional("planId", &Planning::Alarm::planID),
        Optional("stepNo", &Planning::Alarm::stepNo),
        Optional("jobId", &Planning::Alarm::jobID));
};

template <>
struct JsonFields<Planning::BlockText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Planning::BlockText::kind),
        Required("id", &Planning::BlockText::id),
        Optional("reason", &Planning::BlockText::reason),
        Required("since", &Planning::BlockText::since));
};

template <>
struct JsonFields<Planning::CarriersChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::CarriersChanged::robotID),
        Required("carrierIds", &Planning::CarriersChanged::carrierIDs));
};

template <>
struct JsonFields<Planning::StartJob>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::StartJob::planID),
        Required("stepNo", &Planning::StartJob::stepNo),
        Required("jobId", &Planning::StartJob::jobID),
        Required("action", &Planning::StartJob::action),
        Required("position", &Planning::StartJob::position),
        Optional("from", &Planning::StartJob::from),
        Optional("to", &Planning::StartJob::to),
        Optional("carrierId", &Planning::StartJob::carrierID),
        Required("commandId", &Planning::StartJob::commandID),
        Optional("mark", &Planning::StartJob::progressToken),
        Optional("jobNumber", &Planning::StartJob::jobNumber),
        Optional("nodeId", &Planning::StartJob::nodeID));
};

template <>
struct JsonFields<Planning::RobotWorkChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::RobotWorkChanged::robotID),
        Optional("commandId", &Planning::RobotWorkChanged::commandID),
        Optional("earlierIds", &Planning::RobotWorkChanged::earlierIDs),
        Optional("mark", &Planning::RobotWorkChanged::progressToken),
        Optional("job", &Planning::RobotWorkChanged::job),
        Optional("pauseAsked", &Planning::RobotWorkChanged::bPauseAsked),
        Optional("doubtful", &Planning::RobotWorkChanged::bUnresolved),
        Optional("nodeIds", &Planning::RobotWorkChanged::nodeIDs),
        Optional("commandTaken", &Planning::RobotWorkChanged::bCommandTaken),
        Optional("jobNumber", &Planning::RobotWorkChanged::jobNumber));
};

template <>
struct JsonFields<Planning::ReportText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Planning::ReportText::kind),
        Optional("planId", &Planning::ReportText::planID),
        Optional("robotId", &Planning::ReportText::robotID),
        Optional("stepNo", &Planning::ReportText::stepNo),
        Optional("jobId", &Planning::ReportText::jobID),
        Optional("planState", &Planning::ReportText::planState),
        Optional("stepState", &Planning::ReportText::stepState),
        Optional("jobState", &Planning::ReportText::jobState),
        Optional("control", &Planning::ReportText::control),
        Optional("succeeded", &Planning::ReportText::bSucceeded),
        Optional("set", &Planning::ReportText::bSet),
        Optional("alarm", &Planning::ReportText::alarm),
        Optional("message", &Planning::ReportText::message));
};

} // namespace ACS::Json

namespace ACS::Planning
{

namespace
{

template <typename TValue>
std::string EncodeText(const TValue& value)
{
    std::string text;
    Json::JsonWriter writer(text);
    Json::Encode(value, writer);
    return text;
}

template <typename TValue>
Core::Result<TValue> DecodeText(std::string_view text)
{
    Json::JsonDocument document;
    // What was accepted and stored must be read again, however long it is; how much is accepted is decided at the border.
    constexpr std::size_t ANY = std::numeric_limits<std::size_t>::max();
    Json::ParseLimits limits;
    limits.bytes = ANY;
    limits.values = ANY;
    const Core::Result<const Json::Value*> root = document.Parse(text, limits);
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeOptions options;
    options.maximumString = ANY;
    options.maximumArray = ANY;
    Json::DecodeContext context(options);
    TValue value;
    if (!Json::TryDecode(**root, value, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return value;
}

std::optional<std::int64_t> MakeCountOrNull(const std::optional<Core::WallTime>& timeOrNull)
{
    return timeOrNull.has_value() ? std::optional<std::int64_t>(timeOrNull->time_since_epoch().count()) : std::nullopt;
}

std::optional<Core::WallTime> MakeTimeOrNull(std::optional<std::int64_t> countOrNull)
{
    return countOrNull.has_value() ? std::optional(Core::WallTime(Core::WallTime::duration(*countOrNull)))
                                   : std::nullopt;
}

ReportText MakeText(const PlanReport& report)
{
    ReportText text;
    text.kind = EReportKind::Plan;
    text.planID = report.planID;
    text.planState = report.state;
    text.message = report.message;
    return text;
}

ReportText MakeText(const StepReport& report)
{
    ReportText text;
    text.kind = EReportKind::Step;
    text.planID = report.planID;
    text.robotID = report.robotID;
    text.stepNo = report.stepNo;
    text.stepState = report.state;
    text.message = report.message;
    return text;
}

ReportText MakeText(const JobReport& report)
{
    ReportText text;
    text.kind = EReportKind::Job;
    text.planID = report.planID;
    text.robotID = report.robotID;
    text.stepNo = report.stepNo;
    text.jobID = report.jobID;
    text.jobState = report.state;
    text.message = report.message;
    return text;
}

ReportText MakeText(const ErrorReport& report)
{
    ReportText text;
    text.kind = EReportKind::Error;
    text.alarm = report.alarm;
    text.bSet = report.bSet;
    return text;
}

ReportText MakeText(const ControlResultReport& report)
{
    ReportText text;
    text.kind = EReportKind::Control;
    text.planID = report.planID;
    text.control = report.control;
    text.bSucceeded = report.bSucceeded;
    text.message = report.message;
    return text;
}

Core::Result<Report> MakeReport(ReportText text)
{
    const auto refuse = [] {
        return Core::Fail(Core::ECoreError::MissingField, {}, "all members of this kind of report", "fewer");
    };
    switch (text.kind)
    {
        case EReportKind::Plan:
            return text.planID && text.planState
                ? Core::Result<Report>(PlanReport{*text.planID, *text.planState, text.message})
                : refuse();
        case EReportKind::Step:
            return text.planID && text.robotID && text.stepNo && text.stepState ? Core::Result<Report>(
                       StepReport{*text.planID, *text.robotID, *text.stepNo, *text.stepState, text.message})
                                                                                : refuse();
        case EReportKind::Job:
            return text.planID && text.robotID && text.stepNo && text.jobID && text.jobState ? Core::Result<Report>(
                       JobReport{*text.planID, *text.robotID, *text.stepNo, *text.jobID, *text.jobState, text.message})
                                                                                             : refuse();
        case EReportKind::Error:
            return text.alarm && text.bSet ? Core::Result<Report>(ErrorReport{*text.alarm, *text.bSet}) : refuse();
        case EReportKind::Control:
            return text.planID && text.control && text.bSucceeded
                ? Core::Result<Report>(ControlResultReport{*text.control, *text.planID, *text.bSucceeded, text.message})
                : refuse();
        default:
            return refuse();
    }
}

} // namespace

std::string EncodePlan(const Plan& plan)
{
    return EncodeText(plan);
}

Core::Result<Plan> DecodePlan(std::string_view text)
{
    return DecodeText<Plan>(text);
}

std::string EncodeProgress(const PlanProgress& progress)
{
    return EncodeText(ProgressText{
        progress.state,
        progress.robotID,
        progress.message,
        MakeCountOrNull(progress.startedAt),
        MakeCountOrNull(progress.endedAt),
        progress.steps,
        progress.bArrived,
        progress.control,
        progress.controlCount,
        progress.controlOrigin,
        progress.requestIDs,
        progress.queuedAt.count(),
        progress.storedAt.count(),
        progress.priority});
}

Core::Result<PlanProgress> DecodeProgress(std::string_view text)
{
    return DecodeText<ProgressText>(text).map([](ProgressText&& read) {
        return PlanProgress{
            read.state,
            std::move(read.robotID),
            std::move(read.message),
            MakeTimeOrNull(read.startedAt),
            MakeTimeOrNull(read.endedAt),
            std::move(read.steps),
            read.bArrived,
            read.control,
            read.controlCount,
            read.controlOrigin,
            std::move(read.requestIDs),
            std::chrono::milliseconds(read.queuedAt),
            std::chrono::milliseconds(read.storedAt),
            read.priority};
    });
}

std::string EncodeReport(const Report& report)
{
    return std::visit([](const auto& typed) { return EncodeText(MakeText(typed)); }, report);
}

Core::Result<Report> DecodeReport(std::string_view text)
{
    Core::Result<ReportText> reportText = DecodeText<ReportText>(text);
    if (!reportText.has_value())
    {
        return tl::unexpected(std::move(reportText.error()));
    }
    return MakeReport(std::move(*reportText));
}

std::string EncodeCarriers(const CarriersChanged& carriers)
{
    return EncodeText(carriers);
}

Core::Result<CarriersChanged> DecodeCarriers(std::string_view text)
{
    return DecodeText<CarriersChanged>(text);
}

std::string EncodeRobotWork(const RobotWorkChanged& work)
{
    return EncodeText(work);
}

Core::Result<RobotWorkChanged> DecodeRobotWork(std::string_view text)
{
    return DecodeText<RobotWorkChanged>(text);
}

std::string EncodeAlarm(const Alarm& alarm)
{
    return EncodeText(alarm);
}

Core::Result<Alarm> DecodeAlarm(std::string_view text)
{
    return DecodeText<Alarm>(text);
}

std::string EncodeBlock(const Block& block)
{
    return EncodeText(BlockText{block.kind, block.id, block.reason, block.since.time_since_epoch().count()});
}

Core::Result<Block> DecodeBlock(std::string_view text)
{
    return DecodeText<BlockText>(text).map([](BlockText&& read) {
        return Block{
            read.kind,
            std::move(read.id),
            std::move(read.reason),
            Core::WallTime(Core::WallTime::duration(read.since))};
    });
}

} // namespace ACS::Planning
