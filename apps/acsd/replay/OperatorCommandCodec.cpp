#include "replay/OperatorCommandCodec.hpp"

#include "replay/FindMember.hpp"
#include <acs/json/TextCodec.hpp>
#include <acs/plan_json/PlanFields.hpp>

#include <array>
#include <string_view>
#include <tuple>
#include <variant>

namespace ACS::Json
{

template <>
struct JsonFields<Planning::SubmitPlan>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("plan", &Planning::SubmitPlan::plan),
        Defaulted("replyToken", &Planning::SubmitPlan::replyToken),
        Optional("transactionId", &Planning::SubmitPlan::transactionID));
};

template <>
struct JsonFields<Planning::ControlPlan>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("control", &Planning::ControlPlan::control),
        Required("planId", &Planning::ControlPlan::planID),
        Optional("reason", &Planning::ControlPlan::reason),
        Defaulted("replyToken", &Planning::ControlPlan::replyToken),
        Optional("transactionId", &Planning::ControlPlan::transactionID),
        Required("origin", &Planning::ControlPlan::origin));
};

template <>
struct JsonFields<Planning::MessageAcknowledged>
{
    static constexpr auto FIELDS = std::make_tuple(Required("sequence", &Planning::MessageAcknowledged::sequence));
};

template <>
struct JsonFields<Planning::ControlTSC>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("pause", &Planning::ControlTSC::bPause),
        Defaulted("replyToken", &Planning::ControlTSC::replyToken));
};

template <>
struct JsonFields<Planning::ResolveJob>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::ResolveJob::planID),
        Required("jobId", &Planning::ResolveJob::jobID),
        Required("resolution", &Planning::ResolveJob::resolution),
        Defaulted("replyToken", &Planning::ResolveJob::replyToken));
};

template <>
struct JsonFields<Planning::SetMaintenance>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::SetMaintenance::robotID),
        Required("on", &Planning::SetMaintenance::bOn),
        Defaulted("replyToken", &Planning::SetMaintenance::replyToken));
};

template <>
struct JsonFields<Planning::ClearAlarms>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::ClearAlarms::robotID),
        Required("errorCode", &Planning::ClearAlarms::errorCode),
        Optional("planId", &Planning::ClearAlarms::planID),
        Optional("jobId", &Planning::ClearAlarms::jobID),
        Defaulted("replyToken", &Planning::ClearAlarms::replyToken));
};

template <>
struct JsonFields<Planning::SetCarriers>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Planning::SetCarriers::robotID),
        Required("carrierIds", &Planning::SetCarriers::carrierIDs),
        Defaulted("replyToken", &Planning::SetCarriers::replyToken));
};

template <>
struct JsonFields<Planning::SkipStep>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::SkipStep::planID),
        Required("stepNo", &Planning::SkipStep::stepNo),
        Defaulted("replyToken", &Planning::SkipStep::replyToken));
};

template <>
struct JsonFields<Planning::SetPlanPriority>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("planId", &Planning::SetPlanPriority::planID),
        Required("priority", &Planning::SetPlanPriority::priority),
        Defaulted("replyToken", &Planning::SetPlanPriority::replyToken));
};

template <>
struct JsonFields<Planning::BlockPlace>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Planning::BlockPlace::kind),
        Required("id", &Planning::BlockPlace::id),
        Optional("reason", &Planning::BlockPlace::reason),
        Defaulted("replyToken", &Planning::BlockPlace::replyToken));
};

template <>
struct JsonFields<Planning::UnblockPlace>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Planning::UnblockPlace::kind),
        Required("id", &Planning::UnblockPlace::id),
        Defaulted("replyToken", &Planning::UnblockPlace::replyToken));
};

template <>
struct VariantTag<Planning::PlanCommand>
{
    static constexpr std::string_view NAME = "command";
    static constexpr std::array<std::string_view, 12> WORDS{
        "SubmitPlan",
        "ControlPlan",
        "MessageAcknowledged",
        "ControlTSC",
        "ResolveJob",
        "SetMaintenance",
        "ClearAlarms",
        "SetCarriers",
        "SkipStep",
        "SetPlanPriority",
        "BlockPlace",
        "UnblockPlace"};
};

template <>
struct JsonFields<Acsd::OfferInput>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("offer", &Acsd::OfferInput::command), Optional("receipt", &Acsd::OfferInput::receipt));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

std::string EncodeOffer(const OfferInput& offer)
{
    return Json::EncodeText(offer);
}

Core::Result<OfferInput> DecodeOffer(std::string_view text)
{
    return Json::DecodeText<OfferInput>(text);
}

std::string FindPlanID(const Planning::PlanCommand& command)
{
    const auto* const submitOrNull = std::get_if<Planning::SubmitPlan>(&command);
    return submitOrNull == nullptr ? FindMember(command, PLAN_ID) : submitOrNull->plan.planID;
}

std::string FindRobotID(const Planning::PlanCommand& command)
{
    return FindMember(command, ROBOT_ID);
}

} // namespace ACS::Acsd
