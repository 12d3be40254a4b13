#include "replay/StateCodec.hpp"

#include "replay/ReceiptText.hpp"
#include "replay/RecordJson.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/StoreCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

struct PlanText
{
    std::uint64_t sequence = 0;
    std::int64_t acceptedAt = 0;
    std::string plan;
    std::string progress;
    std::string transactionID;
};

struct ReportLine
{
    std::uint64_t sequence = 0;
    std::string transactionID;
    std::int64_t time = 0;
    std::string report;
};

struct StoreText
{
    std::vector<PlanText> plans;
    std::vector<ReportLine> outbox;
    std::uint64_t lastReportSequence = 0;
    std::vector<std::string> carriers;
    std::vector<std::string> alarms;
    std::vector<std::string> robotsInMaintenance;
    std::string tscState; ///< Empty: none was ever stored.
    std::string holdReason;
    std::vector<std::string> robotWorks;
    std::vector<std::string> blocks;
    std::vector<ReceiptText> receipts;
};

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::PlanText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("sequence", &Acsd::PlanText::sequence),
        Required("acceptedAt", &Acsd::PlanText::acceptedAt),
        Required("plan", &Acsd::PlanText::plan),
        Required("progress", &Acsd::PlanText::progress),
        Optional("transactionId", &Acsd::PlanText::transactionID));
};

template <>
struct JsonFields<Acsd::ReportLine>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("sequence", &Acsd::ReportLine::sequence),
        Required("transactionId", &Acsd::ReportLine::transactionID),
        Required("time", &Acsd::ReportLine::time),
        Required("report", &Acsd::ReportLine::report));
};

template <>
struct JsonFields<Acsd::StoreText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("plans", &Acsd::StoreText::plans),
        Optional("outbox", &Acsd::StoreText::outbox),
        Required("lastReportSequence", &Acsd::StoreText::lastReportSequence),
        Optional("carriers", &Acsd::StoreText::carriers),
        Optional("alarms", &Acsd::StoreText::alarms),
        Optional("robotsInMaintenance", &Acsd::StoreText::robotsInMaintenance),
        Optional("tsc", &Acsd::StoreText::tscState),
        Optional("holdReason", &Acsd::StoreText::holdReason),
        Optional("robotWorks", &Acsd::StoreText::robotWorks),
        Optional("blocks", &Acsd::StoreText::blocks),
        Optional("receipts", &Acsd::StoreText::receipts));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

Core::WallTime MakeWallTime(std::int64_t count)
{
    return Core::WallTime(Core::WallTime::duration(count));
}

/// Adds the decoded texts to the values. An error of the first text that cannot be read.
template <typename TText, typename TValue, typename TDecode>
Core::Result<void> DecodeAll(const std::vector<TText>& texts, const TDecode& decode, std::vector<TValue>& values)
{
    for (const TText& text : texts)
    {
        Core::Result<TValue> value = decode(text);
        if (!value.has_value())
        {
            return tl::unexpected(std::move(value.error()));
        }
        values.push_back(std::move(*value));
    }
    return {};
}

Core::Result<Planning::PlanRecord> DecodeRecordOfPlan(const PlanText& text)
{
    return Planning::DecodePlan(text.plan).and_then([&text](Planning::Plan&& plan) {
        return Planning::DecodeProgress(text.progress).map([&text, &plan](Planning::PlanProgress&& progress) {
            return Planning::PlanRecord{
                text.sequence,
                MakeWallTime(text.acceptedAt),
                std::move(plan),
                std::move(progress),
                text.transactionID};
        });
    });
}

Core::Result<Planning::OutboxEntry> DecodeEntry(const ReportLine& text)
{
    return Planning::DecodeReport(text.report).map([&text](Planning::Report&& report) {
        return Planning::OutboxEntry{text.sequence, text.transactionID, MakeWallTime(text.time), std::move(report)};
    });
}

Core::Result<std::optional<Planning::ETscState>> ReadTscStateOrNull(const std::string& text)
{
    if (text.empty())
    {
        return std::nullopt;
    }
    for (const Planning::ETscState state :
         {Planning::ETscState::Auto, Planning::ETscState::Paused, Planning::ETscState::Pausing})
    {
        if (text == GetText(state))
        {
            return state;
        }
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "tsc", "a state of the TSC", Core::QuoteForError(text));
}

Core::Result<Planning::StoredState> MakeStoredState(const StoreText& text)
{
    Planning::StoredState state;
    state.lastReportSequence = text.lastReportSequence;
    state.robotsInMaintenance = text.robotsInMaintenance;
    state.holdReason = text.holdReason;
    std::ranges::transform(text.receipts, std::back_inserter(state.receipts), MakeReceipt);
    return ReadTscStateOrNull(text.tscState)
        .and_then([&](std::optional<Planning::ETscState> tscOrNull) {
            state.tscState = tscOrNull;
            return DecodeAll(text.plans, DecodeRecordOfPlan, state.plans);
        })
        .and_then([&] { return DecodeAll(text.outbox, DecodeEntry, state.outbox); })
        .and_then([&] { return DecodeAll(text.carriers, Planning::DecodeCarriers, state.carriers); })
        .and_then([&] { return DecodeAll(text.alarms, Planning::DecodeAlarm, state.alarms); })
        .and_then([&] { return DecodeAll(text.robotWorks, Planning::DecodeRobotWork, state.robotWorks); })
        .and_then([&] { return DecodeAll(text.blocks, Planning::DecodeBlock, state.blocks); })
        .map([&] { return std::move(state); });
}

std::string QuoteText(std::string_view text)
{
    std::string quoted;
    Core::JsonText::AppendString(text, quoted);
    return quoted;
}

std::string DescribeChange(const Planning::StoreChange& change)
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    return std::visit(
        Core::Overloaded{
            [](const PlanAdded& added) {
                return fmt::format(
                    R"({{"change":"PlanAdded","sequence":{},"transactionId":{},"plan":{},"progress":{}}})",
                    added.record.sequence,
                    QuoteText(added.record.transactionID),
                    EncodePlan(added.record.plan),
                    EncodeProgress(added.record.progress));
            },
            [](const PlanProgressed& progressed) {
                return fmt::format(
                    R"({{"change":"PlanProgressed","planId":{},"progress":{}}})",
                    QuoteText(progressed.planID),
                    EncodeProgress(progressed.progress));
            },
            [](const PlanRemoved& removed) {
                return fmt::format(R"({{"change":"PlanRemoved","sequence":{}}})", removed.sequence);
            },
            [](const ReportAdded& added) {
                return fmt::format(
                    R"({{"change":"ReportAdded","sequence":{},"transactionId":{},"report":{}}})",
                    added.entry.sequence,
                    QuoteText(added.entry.transactionID),
                    EncodeReport(added.entry.report));
            },
            [](const ReportRemoved& removed) {
                return fmt::format(R"({{"change":"ReportRemoved","sequence":{}}})", removed.sequence);
            },
            [](const CarriersChanged& carriers) {
                return fmt::format(R"({{"change":"CarriersChanged","carriers":{}}})", EncodeCarriers(carriers));
            },
            [](const AlarmSet& set) {
                return fmt::format(R"({{"change":"AlarmSet","alarm":{}}})", EncodeAlarm(set.alarm));
            },
            [](const AlarmCleared& cleared) {
                return fmt::format(R"({{"change":"AlarmCleared","alarm":{}}})", EncodeAlarm(cleared.alarm));
            },
            [](const TscChanged& changed) {
                return fmt::format(R"({{"change":"TscChanged","state":"{}"}})", GetText(changed.state));
            },
            [](const RobotWorkChanged& work) {
                return fmt::format(R"({{"change":"RobotWorkChanged","work":{}}})", EncodeRobotWork(work));
            },
            [](const MaintenanceChanged& changed) {
                return fmt::format(
                    R"({{"change":"MaintenanceChanged","robotId":{},"on":{}}})",
                    QuoteText(changed.robotID),
                    changed.bOn);
            },
            [](const BlockAdded& added) {
                return fmt::format(R"({{"change":"BlockAdded","block":{}}})", EncodeBlock(added.block));
            },
            [](const BlockRemoved& removed) {
                return fmt::format(
                    R"({{"change":"BlockRemoved","kind":"{}","id":{}}})",
                    GetText(removed.kind),
                    QuoteText(removed.id));
            },
            [](const ReceiptAdded& added) {
                return fmt::format(
                    R"({{"change":"ReceiptAdded","receipt":{}}})",
                    EncodeRecord(MakeReceiptText(added.receipt)));
            }},
        change);
}

/// Empty: of no plan.
std::string GetPlanOf(const Planning::Report& report)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::ErrorReport& error) { return error.alarm.planID.value_or(std::string()); },
            [](const auto& other) {
                return other.planID;
            }},
        report);
}

std::string GetPlanOf(const Planning::StoreChange& change)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::PlanAdded& added) { return added.record.plan.planID; },
            [](const Planning::PlanProgressed& progressed) { return progressed.planID; },
            [](const Planning::ReportAdded& added) { return GetPlanOf(added.entry.report); },
            [](const Planning::AlarmSet& set) { return set.alarm.planID.value_or(std::string()); },
            [](const Planning::AlarmCleared& cleared) { return cleared.alarm.planID.value_or(std::string()); },
            [](const Planning::RobotWorkChanged& work) {
                return work.job.has_value() ? work.job->planID : std::string();
            },
            [](const auto& /*other*/) {
                return std::string();
            }},
        change);
}

} // namespace

std::string EncodeState(const Planning::StoredState& state)
{
    StoreText text;
    for (const Planning::PlanRecord& record : state.plans)
    {
        text.plans.push_back(
            {record.sequence,
             record.acceptedAt.time_since_epoch().count(),
             Planning::EncodePlan(record.plan),
             Planning::EncodeProgress(record.progress),
             record.transactionID});
    }
    for (const Planning::OutboxEntry& entry : state.outbox)
    {
        text.outbox.push_back(
            {entry.sequence,
             entry.transactionID,
             entry.time.time_since_epoch().count(),
             Planning::EncodeReport(entry.report)});
    }
    text.lastReportSequence = state.lastReportSequence;
    std::ranges::transform(state.carriers, std::back_inserter(text.carriers), Planning::EncodeCarriers);
    std::ranges::transform(state.alarms, std::back_inserter(text.alarms), Planning::EncodeAlarm);
    text.robotsInMaintenance = state.robotsInMaintenance;
    text.tscState = state.tscState.has_value() ? GetText(*state.tscState) : "";
    text.holdReason = state.holdReason;
    std::ranges::transform(state.robotWorks, std::back_inserter(text.robotWorks), Planning::EncodeRobotWork);
    std::ranges::transform(state.blocks, std::back_inserter(text.blocks), Planning::EncodeBlock);
    std::ranges::transform(state.receipts, std::back_inserter(text.receipts), MakeReceiptText);
    return EncodeRecord(text);
}

Core::Result<Planning::StoredState> DecodeState(std::string_view text)
{
    return DecodeRecord<StoreText>(text).and_then([](const StoreText& read) { return MakeStoredState(read); });
}

std::string EncodeBatch(const Planning::StoreBatch& batch)
{
    std::vector<std::string> changes;
    std::ranges::transform(batch.changes, std::back_inserter(changes), DescribeChange);
    return fmt::format("[{}]", fmt::join(changes, ","));
}

std::string FindPlanID(const Planning::StoreBatch& batch)
{
    std::set<std::string> planIDs;
    for (const Planning::StoreChange& change : batch.changes)
    {
        if (std::string planID = GetPlanOf(change); !planID.empty())
        {
            planIDs.insert(std::move(planID));
        }
    }
    return planIDs.size() == 1 ? *planIDs.begin() : std::string();
}

} // namespace ACS::Acsd
