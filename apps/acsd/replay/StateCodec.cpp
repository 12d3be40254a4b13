#include "replay/StateCodec.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/json/TextCodec.hpp>
#include <acs/plan_json/PlanFields.hpp>

#include <array>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace ACS::Json
{

template <>
struct JsonFields<Planning::PlanAdded>
{
    static constexpr auto FIELDS = std::make_tuple(Flat(&Planning::PlanAdded::record));
};

template <>
struct JsonFields<Planning::PlanProgressed>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::PlanProgressed::planID),
        Required("progress", &Planning::PlanProgressed::progress));
};

template <>
struct JsonFields<Planning::PlanRemoved>
{
    static constexpr auto FIELDS = std::make_tuple(Required("sequence", &Planning::PlanRemoved::sequence));
};

template <>
struct JsonFields<Planning::ReportAdded>
{
    static constexpr auto FIELDS = std::make_tuple(Flat(&Planning::ReportAdded::entry));
};

template <>
struct JsonFields<Planning::ReportRemoved>
{
    static constexpr auto FIELDS = std::make_tuple(Required("sequence", &Planning::ReportRemoved::sequence));
};

template <>
struct JsonFields<Planning::AlarmSet>
{
    static constexpr auto FIELDS = std::make_tuple(Required("alarm", &Planning::AlarmSet::alarm));
};

template <>
struct JsonFields<Planning::AlarmCleared>
{
    static constexpr auto FIELDS = std::make_tuple(Required("alarm", &Planning::AlarmCleared::alarm));
};

template <>
struct JsonFields<Planning::TscChanged>
{
    static constexpr auto FIELDS = std::make_tuple(Required("state", &Planning::TscChanged::state));
};

template <>
struct JsonFields<Planning::MaintenanceChanged>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::MaintenanceChanged::robotID),
        Required("on", &Planning::MaintenanceChanged::bOn));
};

template <>
struct JsonFields<Planning::BlockAdded>
{
    static constexpr auto FIELDS = std::make_tuple(Required("block", &Planning::BlockAdded::block));
};

template <>
struct JsonFields<Planning::BlockRemoved>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("kind", &Planning::BlockRemoved::kind), Required("id", &Planning::BlockRemoved::id));
};

template <>
struct JsonFields<Planning::ReceiptAdded>
{
    static constexpr auto FIELDS = std::make_tuple(Required("receipt", &Planning::ReceiptAdded::receipt));
};

template <>
struct VariantTag<Planning::StoreChange>
{
    static constexpr std::string_view NAME = "change";
    static constexpr std::array<std::string_view, 14> WORDS{
        "PlanAdded",
        "PlanProgressed",
        "PlanRemoved",
        "ReportAdded",
        "ReportRemoved",
        "CarriersChanged",
        "AlarmSet",
        "AlarmCleared",
        "TscChanged",
        "RobotWorkChanged",
        "MaintenanceChanged",
        "BlockAdded",
        "BlockRemoved",
        "ReceiptAdded"};
};

template <>
struct JsonFields<Planning::StoredState>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("plans", &Planning::StoredState::plans),
        Optional("outbox", &Planning::StoredState::outbox),
        Required("lastReportSequence", &Planning::StoredState::lastReportSequence),
        Optional("carriers", &Planning::StoredState::carriers),
        Optional("alarms", &Planning::StoredState::alarms),
        Optional("robotsInMaintenance", &Planning::StoredState::robotsInMaintenance),
        Optional("tsc", &Planning::StoredState::tscState),
        Optional("holdReason", &Planning::StoredState::holdReason),
        Optional("robotWorks", &Planning::StoredState::robotWorks),
        Optional("blocks", &Planning::StoredState::blocks),
        Optional("receipts", &Planning::StoredState::receipts));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

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
    return Json::EncodeText(state);
}

Core::Result<Planning::StoredState> DecodeState(std::string_view text)
{
    return Json::DecodeText<Planning::StoredState>(text);
}

std::string EncodeBatch(const Planning::StoreBatch& batch)
{
    return Json::EncodeText(batch.changes);
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
