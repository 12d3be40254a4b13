#include "replay/OperatorCommandCodec.hpp"

#include "replay/ReceiptText.hpp"
#include "replay/RecordJson.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/StoreCodec.hpp>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

/// A command of any kind: what a kind does not have is absent.
struct CommandText
{
    std::string command;
    std::string planID;
    std::string robotID;
    std::string text; ///< A word, a reason or a code, depending on the command.
    std::string reason;
    std::string transactionID;
    std::string plan; ///< JSON
    std::optional<bool> bOn;
    std::optional<std::int32_t> number;
    std::optional<std::uint64_t> sequence;
    std::optional<std::string> alarmPlanID;
    std::optional<std::string> jobID;
    std::vector<std::optional<std::string>> carrierIDs;
    std::uint64_t replyToken = 0;
    std::string origin;  ///< Of a control; empty: the MCS.
    std::string placeID; ///< Of a block, whose kind is the text.
    std::optional<ReceiptText> receipt;
};

constexpr std::string_view SUBMIT_COMMAND = "SubmitPlan";
constexpr std::string_view CONTROL_COMMAND = "ControlPlan";
constexpr std::string_view ACKNOWLEDGED_COMMAND = "MessageAcknowledged";
constexpr std::string_view TSC_COMMAND = "ControlTSC";
constexpr std::string_view RESOLVE_COMMAND = "ResolveJob";
constexpr std::string_view MAINTENANCE_COMMAND = "SetMaintenance";
constexpr std::string_view CLEAR_COMMAND = "ClearAlarms";
constexpr std::string_view CARRIERS_COMMAND = "SetCarriers";
constexpr std::string_view SKIP_COMMAND = "SkipStep";
constexpr std::string_view PRIORITY_COMMAND = "SetPlanPriority";
constexpr std::string_view BLOCK_COMMAND = "BlockPlace";
constexpr std::string_view UNBLOCK_COMMAND = "UnblockPlace";

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::CommandText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("command", &Acsd::CommandText::command),
        Optional("planId", &Acsd::CommandText::planID),
        Optional("robotId", &Acsd::CommandText::robotID),
        Optional("text", &Acsd::CommandText::text),
        Optional("reason", &Acsd::CommandText::reason),
        Optional("transactionId", &Acsd::CommandText::transactionID),
        Optional("plan", &Acsd::CommandText::plan),
        Optional("on", &Acsd::CommandText::bOn),
        Optional("number", &Acsd::CommandText::number),
        Optional("sequence", &Acsd::CommandText::sequence),
        Optional("alarmPlanId", &Acsd::CommandText::alarmPlanID),
        Optional("jobId", &Acsd::CommandText::jobID),
        Optional("carrierIds", &Acsd::CommandText::carrierIDs),
        Defaulted("replyToken", &Acsd::CommandText::replyToken),
        Optional("origin", &Acsd::CommandText::origin),
        Optional("placeId", &Acsd::CommandText::placeID),
        Optional("receipt", &Acsd::CommandText::receipt));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

/// The value that has this text; an error if there is none.
template <typename TEnum>
Core::Result<TEnum> FindWordValue(std::string_view text, std::initializer_list<TEnum> values)
{
    for (const TEnum value : values)
    {
        if (text == GetText(value))
        {
            return value;
        }
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "text", "a word of the command", Core::QuoteForError(text));
}

CommandText MakeCommandText(const Planning::PlanCommand& command)
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    CommandText text;
    std::visit(
        Core::Overloaded{
            [&text](const SubmitPlan& submit) {
                text.command = SUBMIT_COMMAND;
                text.plan = EncodePlan(submit.plan);
                text.replyToken = submit.replyToken;
                text.transactionID = submit.transactionID;
            },
            [&text](const ControlPlan& control) {
                text.command = CONTROL_COMMAND;
                text.text = GetText(control.control);
                text.planID = control.planID;
                text.reason = control.reason;
                text.replyToken = control.replyToken;
                text.transactionID = control.transactionID;
                text.origin = GetText(control.origin);
            },
            [&text](const MessageAcknowledged& acknowledged) {
                text.command = ACKNOWLEDGED_COMMAND;
                text.sequence = acknowledged.sequence;
            },
            [&text](const ControlTSC& control) {
                text.command = TSC_COMMAND;
                text.bOn = control.bPause;
                text.replyToken = control.replyToken;
            },
            [&text](const ResolveJob& resolve) {
                text.command = RESOLVE_COMMAND;
                text.planID = resolve.planID;
                text.jobID = resolve.jobID;
                text.text = GetText(resolve.resolution);
                text.replyToken = resolve.replyToken;
            },
            [&text](const SetMaintenance& maintenance) {
                text.command = MAINTENANCE_COMMAND;
                text.robotID = maintenance.robotID;
                text.bOn = maintenance.bOn;
                text.replyToken = maintenance.replyToken;
            },
            [&text](const ClearAlarms& clear) {
                text.command = CLEAR_COMMAND;
                text.robotID = clear.robotID;
                text.text = clear.errorCode;
                text.alarmPlanID = clear.planID;
                text.jobID = clear.jobID;
                text.replyToken = clear.replyToken;
            },
            [&text](const SetCarriers& carriers) {
                text.command = CARRIERS_COMMAND;
                text.robotID = carriers.robotID;
                text.carrierIDs = carriers.carrierIDs;
                text.replyToken = carriers.replyToken;
            },
            [&text](const SkipStep& skip) {
                text.command = SKIP_COMMAND;
                text.planID = skip.planID;
                text.number = skip.stepNo;
                text.replyToken = skip.replyToken;
            },
            [&text](const SetPlanPriority& priority) {
                text.command = PRIORITY_COMMAND;
                text.planID = priority.planID;
                text.number = priority.priority;
                text.replyToken = priority.replyToken;
            },
            [&text](const BlockPlace& block) {
                text.command = BLOCK_COMMAND;
                text.text = GetText(block.kind);
                text.placeID = block.id;
                text.reason = block.reason;
                text.replyToken = block.replyToken;
            },
            [&text](const UnblockPlace& unblock) {
                text.command = UNBLOCK_COMMAND;
                text.text = GetText(unblock.kind);
                text.placeID = unblock.id;
                text.replyToken = unblock.replyToken;
            }},
        command);
    return text;
}

Core::Result<Planning::PlanCommand> MakeControl(CommandText text)
{
    using Planning::EPlanControl;
    return FindWordValue(
               text.text,
               {EPlanControl::Cancel, EPlanControl::Abort, EPlanControl::Pause, EPlanControl::Resume})
        .map([&text](EPlanControl control) -> Planning::PlanCommand {
            return Planning::ControlPlan{
                control,
                std::move(text.planID),
                std::move(text.reason),
                text.replyToken,
                std::move(text.transactionID),
                text.origin == GetText(Planning::EControlOrigin::Operator) ? Planning::EControlOrigin::Operator
                                                                           : Planning::EControlOrigin::MCS};
        });
}

Core::Result<Planning::PlanCommand> MakeResolution(CommandText text)
{
    using Planning::EJobResolution;
    return FindWordValue(text.text, {EJobResolution::Done, EJobResolution::Failed, EJobResolution::Again})
        .map([&text](EJobResolution resolution) -> Planning::PlanCommand {
            return Planning::ResolveJob{
                std::move(text.planID),
                std::move(text.jobID).value_or(std::string()),
                resolution,
                text.replyToken};
        });
}

Core::Result<Planning::PlanCommand> MakeBlock(CommandText text)
{
    using Planning::EBlockKind;
    return FindWordValue(text.text, {EBlockKind::Node, EBlockKind::Edge, EBlockKind::Station})
        .map([&text](EBlockKind kind) -> Planning::PlanCommand {
            if (text.command == BLOCK_COMMAND)
            {
                return Planning::BlockPlace{kind, std::move(text.placeID), std::move(text.reason), text.replyToken};
            }
            return Planning::UnblockPlace{kind, std::move(text.placeID), text.replyToken};
        });
}

Core::Result<Planning::PlanCommand> MakePlanCommand(CommandText text)
{
    if (text.command == SUBMIT_COMMAND)
    {
        return Planning::DecodePlan(text.plan).map([&text](Planning::Plan&& plan) -> Planning::PlanCommand {
            return Planning::SubmitPlan{std::move(plan), text.replyToken, std::move(text.transactionID)};
        });
    }
    if (text.command == CONTROL_COMMAND)
    {
        return MakeControl(std::move(text));
    }
    if (text.command == ACKNOWLEDGED_COMMAND)
    {
        return Planning::MessageAcknowledged{text.sequence.value_or(0)};
    }
    if (text.command == TSC_COMMAND)
    {
        return Planning::ControlTSC{text.bOn.value_or(false), text.replyToken};
    }
    if (text.command == RESOLVE_COMMAND)
    {
        return MakeResolution(std::move(text));
    }
    if (text.command == MAINTENANCE_COMMAND)
    {
        return Planning::SetMaintenance{std::move(text.robotID), text.bOn.value_or(false), text.replyToken};
    }
    if (text.command == CLEAR_COMMAND)
    {
        return Planning::ClearAlarms{
            std::move(text.robotID),
            std::move(text.text),
            std::move(text.alarmPlanID),
            std::move(text.jobID),
            text.replyToken};
    }
    if (text.command == CARRIERS_COMMAND)
    {
        return Planning::SetCarriers{std::move(text.robotID), std::move(text.carrierIDs), text.replyToken};
    }
    if (text.command == SKIP_COMMAND)
    {
        return Planning::SkipStep{std::move(text.planID), text.number.value_or(0), text.replyToken};
    }
    if (text.command == PRIORITY_COMMAND)
    {
        return Planning::SetPlanPriority{std::move(text.planID), text.number.value_or(0), text.replyToken};
    }
    if (text.command == BLOCK_COMMAND || text.command == UNBLOCK_COMMAND)
    {
        return MakeBlock(std::move(text));
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "command", "a command", Core::QuoteForError(text.command));
}

} // namespace

std::string EncodeOffer(const OfferInput& offer)
{
    CommandText text = MakeCommandText(offer.command);
    if (offer.receipt.has_value())
    {
        text.receipt = MakeReceiptText(*offer.receipt);
    }
    return EncodeRecord(text);
}

Core::Result<OfferInput> DecodeOffer(std::string_view text)
{
    return DecodeRecord<CommandText>(text).and_then([](CommandText&& read) {
        std::optional<Planning::CommandReceipt> receipt;
        if (read.receipt.has_value())
        {
            receipt = MakeReceipt(*read.receipt);
        }
        return MakePlanCommand(std::move(read)).map([&receipt](Planning::PlanCommand&& command) {
            return OfferInput{std::move(command), std::move(receipt)};
        });
    });
}

std::string FindPlanID(const Planning::PlanCommand& command)
{
    const auto* const submitOrNull = std::get_if<Planning::SubmitPlan>(&command);
    return submitOrNull == nullptr ? MakeCommandText(command).planID : submitOrNull->plan.planID;
}

std::string FindRobotID(const Planning::PlanCommand& command)
{
    return MakeCommandText(command).robotID;
}

} // namespace ACS::Acsd
