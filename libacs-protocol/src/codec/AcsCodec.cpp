#include "Fields.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Location.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace ACS::Protocol
{

namespace
{

constexpr std::string_view ACK_SUFFIX = "Ack";
constexpr std::string_view LEGACY_NAME = "RequestAcsStatus";

using PayloadDecoder = bool (*)(const Json::Value&, AcsPayload&, Json::DecodeContext&);

template <std::size_t INDEX>
bool TryDecodePayloadAs(const Json::Value& value, AcsPayload& out, Json::DecodeContext& context)
{
    return Json::TryDecode(value, out.emplace<INDEX>(), {}, context);
}

template <std::size_t... INDEX>
constexpr std::array<PayloadDecoder, COMMAND_COUNT> MakePayloadDecoders(std::index_sequence<INDEX...> /*all*/)
{
    return {&TryDecodePayloadAs<INDEX>...};
}

constexpr std::array<PayloadDecoder, COMMAND_COUNT> PAYLOAD_DECODERS =
    MakePayloadDecoders(std::make_index_sequence<COMMAND_COUNT>{});

/// An empty payload of the kind that the Ack of this command carries.
AckPayload MakeAckPayload(EAcsCommand command)
{
    if (command <= EAcsCommand::ResumePlan)
    {
        return PlanAck{};
    }
    if (command == EAcsCommand::RequestAcsPlans || command == EAcsCommand::RequestAcsPlanHistory)
    {
        return PlanListAck{};
    }
    if (command == EAcsCommand::RequestAcsErrorList)
    {
        return ErrorListAck{};
    }
    return EmptyAck{};
}

std::string_view GetStringOrEmpty(const Json::DeferredValue& value)
{
    const bool bString = value.valueOrNull != nullptr && value.valueOrNull->IsString();
    return bString ? std::string_view(value.valueOrNull->GetString(), value.valueOrNull->GetStringLength())
                   : std::string_view();
}

/// An identifier of a message that could not be decoded; empty if it is missing or too long.
std::string FindIdentifier(const Json::DeferredValue& payload, std::string_view name)
{
    if (payload.valueOrNull == nullptr || !payload.valueOrNull->IsObject())
    {
        return {};
    }
    const std::string_view text = GetStringOrEmpty({Json::FindFirstOrNull(*payload.valueOrNull, name)});
    return std::string(text.size() <= Detail::LONGEST_ID ? text : std::string_view());
}

/// The first value of a repeated member: the text is refused, but can be answered.
Detail::WireEnvelope FindEnvelope(const Json::Value& root)
{
    Detail::WireEnvelope envelope;
    if (root.IsObject())
    {
        envelope.command.valueOrNull = Json::FindFirstOrNull(root, "command");
        envelope.transactionID.valueOrNull = Json::FindFirstOrNull(root, "transactionId");
        envelope.timestamp.valueOrNull = Json::FindFirstOrNull(root, "timestamp");
        envelope.payload.valueOrNull = Json::FindFirstOrNull(root, "payload");
    }
    return envelope;
}

/// Takes the suffix off; false where there is none.
bool TryTakeAckSuffix(std::string_view& name)
{
    const bool bAck = name.size() >= ACK_SUFFIX.size()
        && Json::IsEqualIgnoringCase(name.substr(name.size() - ACK_SUFFIX.size()), ACK_SUFFIX);
    if (bAck)
    {
        name.remove_suffix(ACK_SUFFIX.size());
    }
    return bAck;
}

/// The kind of a text.
struct WireKind
{
    std::optional<EAcsCommand> command;
    bool bAck = false;
    bool bLegacyName = false;
};

WireKind ReadKind(std::string_view commandName, const CodecOptions& options, Json::DecodeNotes& notes)
{
    WireKind kind;
    kind.bAck = TryTakeAckSuffix(commandName);
    EAcsCommand command = EAcsCommand::ExecutionPlan;
    bool bExact = commandName == LEGACY_NAME;
    if (options.bLegacyNames && Json::IsEqualIgnoringCase(commandName, LEGACY_NAME))
    {
        kind.command = EAcsCommand::RequestAcsPlans;
        kind.bLegacyName = true;
    }
    else if (Json::TryReadWord(commandName, command, bExact))
    {
        kind.command = command;
    }
    notes.lenientWords += kind.command.has_value() && !bExact ? 1U : 0U;
    return kind;
}

/// Section 6.4: from and to have no meaning for these actions and are not checked.
bool HasPlaces(std::string_view action)
{
    constexpr std::array<std::string_view, 3> PLACELESS{"CloseSetCover", "OpenSetCover", "Start"};
    return std::ranges::none_of(PLACELESS, [action](std::string_view placeless) {
        return Json::IsEqualIgnoringCase(placeless, action);
    });
}

/// Whether the member is a location; or nothing, where that is allowed.
bool TryCheckLocation(std::string_view name, const std::string& text, bool bEmptyAllowed, Json::DecodeContext& context)
{
    if ((bEmptyAllowed && text.empty()) || Core::Location::IsLocation(text))
    {
        return true;
    }
    Core::Error error = Core::Location::Parse(text).error();
    static_cast<void>(context.IsFailedWith(error.code, std::move(error.expected), std::move(error.found)));
    return context.IsFailedAt(name);
}

bool TryCheckJobs(const std::vector<PlanJob>& jobs, Json::DecodeContext& context)
{
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
        if (!TryCheckLocation("from", jobs[i].from, true, context)
            || !TryCheckLocation("to", jobs[i].to, true, context))
        {
            static_cast<void>(context.IsFailedAt(i));
            return context.IsFailedAt("jobs");
        }
    }
    return true;
}

/// Section 3.1: a plan's locations are valid. Whether the site has them is not checked by the codec.
bool TryCheckLocations(const ExecutionPlan& plan, Json::DecodeContext& context)
{
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
    {
        const PlanStep& step = plan.steps[i];
        const bool bJobs = !HasPlaces(step.action) || TryCheckJobs(step.jobs, context);
        if (!bJobs || !TryCheckLocation("position", step.position, false, context))
        {
            static_cast<void>(context.IsFailedAt(i));
            return context.IsFailedAt("steps");
        }
    }
    return true;
}

Json::DecodeOptions MakeDecodeOptions(const CodecOptions& options)
{
    Json::DecodeOptions decodeOptions;
    decodeOptions.bUnknownMembersRefused = options.bUnknownMembersRefused;
    decodeOptions.bNumericStringsAccepted = true;
    decodeOptions.maximumString = options.maximumString;
    decodeOptions.maximumArray = options.maximumArray;
    decodeOptions.assumedOffset = options.siteOffset;
    return decodeOptions;
}

} // namespace

class AcsCodec::Impl
{
public:
    CodecOptions options;
    Json::JsonDocument document;

    explicit Impl(const CodecOptions& codecOptions)
        : options(codecOptions)
    {
    }

    [[nodiscard]] std::optional<Core::Timestamp> ReadTimestampOrNull(const Json::DeferredValue& value) const
    {
        return value.valueOrNull == nullptr ? std::nullopt
                                            : Detail::ReadTimestampOrNull(*value.valueOrNull, options.siteOffset);
    }

    /// The epoch, and counted, where there is none.
    [[nodiscard]] Core::Timestamp ReadTimestamp(const Json::DeferredValue& value, Json::DecodeContext& context) const
    {
        const std::optional<Core::Timestamp> timestampOrNull = ReadTimestampOrNull(value);
        context.GetNotes().badTimestamps += timestampOrNull.has_value() ? 0U : 1U;
        return timestampOrNull.value_or(Core::Timestamp{});
    }

    [[nodiscard]] bool TryDecodeRequest(
        const Detail::WireEnvelope& envelope,
        EAcsCommand command,
        AcsRequest& request,
        Json::DecodeContext& context) const
    {
        request.transactionID = GetStringOrEmpty(envelope.transactionID);
        if (request.transactionID.empty() || request.transactionID.size() > Detail::LONGEST_ID
            || Core::HasControlCharacter(request.transactionID))
        {
            static_cast<void>(context.IsFailedWith(
                Core::ECoreError::InvalidIdentifier,
                "an identifier",
                envelope.transactionID.valueOrNull));
            return context.IsFailedAt("transactionId");
        }
        request.timestamp = ReadTimestamp(envelope.timestamp, context);
        if (envelope.payload.valueOrNull == nullptr)
        {
            static_cast<void>(
                context.IsFailedWith(make_error_code(Core::ECoreError::MissingField), "an object", "nothing, or null"));
            return context.IsFailedAt("payload");
        }
        const PayloadDecoder decoder = PAYLOAD_DECODERS[static_cast<std::size_t>(command)];
        const bool bDecoded = decoder(*envelope.payload.valueOrNull, request.payload, context);
        const ExecutionPlan* planOrNull = std::get_if<ExecutionPlan>(&request.payload);
        const bool bChecked = planOrNull != nullptr && options.bLocationsChecked;
        return (bDecoded && (!bChecked || TryCheckLocations(*planOrNull, context))) || context.IsFailedAt("payload");
    }

    [[nodiscard]] bool TryDecodeAck(
        const Detail::WireEnvelope& envelope,
        const WireKind& kind,
        AcsAck& ack,
        Json::DecodeContext& context) const
    {
        ack.command = *kind.command;
        ack.bLegacyName = kind.bLegacyName;
        ack.transactionID = GetStringOrEmpty(envelope.transactionID);
        ack.timestamp = ReadTimestamp(envelope.timestamp, context);
        const std::string_view failureWord = Json::GetWord(EAckResult::Fail);
        const bool bSuccess = Detail::IsSuccess(GetStringOrEmpty(envelope.result), failureWord, context.GetNotes());
        ack.result = bSuccess ? EAckResult::Success : EAckResult::Fail;
        ack.message = GetStringOrEmpty(envelope.message);
        ack.payload = MakeAckPayload(ack.command);
        const bool bMeaningless = std::holds_alternative<EmptyAck>(ack.payload)
            && envelope.payload.valueOrNull != nullptr && !envelope.payload.valueOrNull->IsObject();
        if (envelope.payload.valueOrNull == nullptr || bMeaningless)
        {
            return true;
        }
        const bool bRead = std::visit(
            [&](auto& payload) { return Json::TryDecode(*envelope.payload.valueOrNull, payload, {}, context); },
            ack.payload);
        return bRead || context.IsFailedAt("payload");
    }

    /// False with the error in the context.
    [[nodiscard]] bool TryDecodeMessage(
        const Detail::WireEnvelope& envelope,
        const WireKind& kind,
        DecodeOutcome& outcome,
        Json::DecodeContext& context) const
    {
        if (envelope.command.valueOrNull == nullptr || !envelope.command.valueOrNull->IsString())
        {
            static_cast<void>(
                context.IsFailedWith(Core::ECoreError::MissingField, "a string", envelope.command.valueOrNull));
            return context.IsFailedAt("command");
        }
        if (!kind.command.has_value())
        {
            static_cast<void>(context.IsFailedWith(
                Core::ECoreError::UnknownWord,
                "a command of MCS-ACS",
                envelope.command.valueOrNull));
            return context.IsFailedAt("command");
        }
        if (kind.bAck)
        {
            return TryDecodeAck(envelope, kind, outcome.message->emplace<AcsAck>(), context);
        }
        AcsRequest& request = std::get<AcsRequest>(*outcome.message);
        return TryDecodeRequest(envelope, *kind.command, request, context);
    }
};

AcsCodec::AcsCodec(const CodecOptions& options)
    : _impl(std::make_unique<Impl>(options))
{
}

AcsCodec::~AcsCodec() = default;

void AcsCodec::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _impl->options.siteOffset = offset;
}

DecodeOutcome AcsCodec::Decode(std::string_view text)
{
    DecodeOutcome outcome;
    const Json::ParseLimits limits{_impl->options.maximumBytes, _impl->options.maximumDepth};
    Core::Result<const Json::Value*> root = _impl->document.Parse(text, limits, _impl->options.bLenientJSON);
    if (!root.has_value())
    {
        DecodeFailure failure;
        failure.error = std::move(root.error());
        outcome.message = tl::unexpected<DecodeFailure>(std::move(failure));
        return outcome;
    }
    Json::DecodeContext context(MakeDecodeOptions(_impl->options));
    Detail::WireEnvelope envelope;
    const bool bEnvelope = Json::TryDecode(**root, envelope, {}, context);
    if (!bEnvelope)
    {
        envelope = FindEnvelope(**root);
    }
    const std::string_view commandName = GetStringOrEmpty(envelope.command);
    const WireKind kind = ReadKind(commandName, _impl->options, context.GetNotes());
    outcome.bLegacyName = kind.bLegacyName;
    if (!bEnvelope || !_impl->TryDecodeMessage(envelope, kind, outcome, context))
    {
        DecodeFailure failure;
        failure.error = context.TakeError();
        const bool bNameUsable = commandName.size() <= Detail::LONGEST_ID;
        failure.commandName = bNameUsable ? std::string(commandName) : std::string();
        failure.command = kind.command;
        const std::string_view transactionID = GetStringOrEmpty(envelope.transactionID);
        failure.transactionID =
            transactionID.substr(0, transactionID.size() <= Detail::LONGEST_ID ? std::string_view::npos : 0);
        failure.timestamp = _impl->ReadTimestampOrNull(envelope.timestamp);
        failure.planID = FindIdentifier(envelope.payload, "planId");
        failure.robotID = FindIdentifier(envelope.payload, "robotId");
        failure.jobID = FindIdentifier(envelope.payload, "jobId");
        failure.bAck = kind.bAck;
        outcome.message = tl::unexpected<DecodeFailure>(std::move(failure));
    }
    const Json::DecodeNotes& notes = context.GetNotes();
    outcome.notes.unknownMembers = notes.unknownMembers;
    outcome.notes.nullOptionals = notes.nullOptionals;
    outcome.notes.lenientWords = notes.lenientWords;
    outcome.notes.lenientNumbers = notes.lenientNumbers;
    outcome.notes.badTimestamps = notes.badTimestamps;
    return outcome;
}

void AcsCodec::Encode(const AcsMessage& message, std::string& out)
{
    if (const AcsRequest* requestOrNull = std::get_if<AcsRequest>(&message))
    {
        EncodeRequest(*requestOrNull, out);
    }
    else
    {
        EncodeAck(std::get<AcsAck>(message), out);
    }
}

void AcsCodec::EncodeRequest(const AcsRequest& request, std::string& out)
{
    out.clear();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key("command");
    writer.WriteString(GetText(GetCommand(request)));
    writer.Key("transactionId");
    writer.WriteString(request.transactionID);
    writer.Key("timestamp");
    Json::Encode(request.timestamp, writer);
    writer.Key("payload");
    std::visit([&writer](const auto& payload) { Json::Encode(payload, writer); }, request.payload);
    writer.EndObject();
}

namespace
{

/// The members that every response begins with.
void BeginResponse(
    std::string_view commandName,
    std::string_view transactionID,
    const Core::Timestamp& timestamp,
    EAckResult result,
    std::string_view message,
    Json::JsonWriter& writer)
{
    writer.BeginObject();
    writer.Key("command");
    writer.WriteString(commandName, ACK_SUFFIX);
    writer.Key("transactionId");
    writer.WriteString(transactionID);
    writer.Key("timestamp");
    Json::Encode(timestamp, writer);
    writer.Key("result");
    writer.WriteString(GetText(result));
    writer.Key("message");
    writer.WriteString(message);
    writer.Key("payload");
}

} // namespace

void AcsCodec::EncodeAck(const AcsAck& ack, std::string& out)
{
    out.clear();
    Json::JsonWriter writer(out);
    const std::string_view commandName = ack.bLegacyName ? LEGACY_NAME : GetText(ack.command);
    BeginResponse(commandName, ack.transactionID, ack.timestamp, ack.result, ack.message, writer);
    std::visit([&writer](const auto& payload) { Json::Encode(payload, writer); }, ack.payload);
    writer.EndObject();
}

void AcsCodec::EncodeRefusal(
    std::string_view commandName,
    std::string_view transactionID,
    const Core::Timestamp& timestamp,
    std::string_view reason,
    std::string& out)
{
    out.clear();
    Json::JsonWriter writer(out);
    BeginResponse(commandName, transactionID, timestamp, EAckResult::Fail, reason, writer);
    Json::Encode(EmptyAck{}, writer);
    writer.EndObject();
}

} // namespace ACS::Protocol
